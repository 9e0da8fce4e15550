#include <array>
#include <cstdio>

#include <thinwall/discrete/manifold.hpp>

#include "peers/peer.hpp"

namespace thinwall::bench {

THINWALL_PEER_SETS()

const Shots<Ball, Box>& wall_shots() { return thin_wall_shots<Box>(); }
const Shots<Ball, Box>& plane_shots() {
  static const auto set = shots<Ball, Box>(&any_shape<Ball>, &any_shape<Box>, {1, 1, 0});
  return set;
}

// ---- Our own front door, in the same run.

bool add_thinwall() {
  const auto as_it_is = [](const auto& query) { return query; };
  for_each_cast([&](const std::string& pair, auto set, const Operations& least) {
    add_row("time_of_impact/" + pair + "/thinwall", set, least, as_it_is,
            [](const auto& q) { return time_of(time_of_impact(q.a, q.b)); });
  });
  for_each_ray([&](const std::string& shape, auto set, const Operations& least) {
    add_row("raycast/" + shape + "/thinwall", set, least, as_it_is,
            [](const auto& q) { return time_of(raycast(q.ray, q.shape)); });
  });
  for_each_pose([&](const std::string& pair, auto set) {
    add_row("contact/" + pair + "/thinwall", set, {}, as_it_is,
            [](const auto& q) { return depth_of(contact(q.a, q.b)); });
    add_row("overlaps/" + pair + "/thinwall", set, {}, as_it_is,
            [](const auto& q) { return depth_of(overlaps(q.a, q.b)); });
  });
  return true;
}

}  // namespace thinwall::bench

// ---- What do others take for the same queries, and what do they get wrong?
// Casts, rays, contacts and overlap tests of the libraries that the build found, on the queries of pairs.cpp, beside our own
// front door; their objects are made beforehand. Counters as there: what is missed, what is hit in error, how far off.
// A new peer is a file that defines add_NAME() and a line below; a package of npm, a script (experiments/adapters/npm/serve.mjs) and its
// lines here and in npm.cpp.

namespace {

using thinwall::bench::Peer;

constexpr std::string_view by_npm = "`npm ci` in experiments/adapters/npm";

constexpr auto peers = std::to_array<Peer>({
    {"thinwall", "", &thinwall::bench::add_thinwall},
    {"Bullet", "libbullet-dev", &thinwall::bench::add_bullet},
    {"ODE", "libode-dev", &thinwall::bench::add_ode},
    {"FCL", "libfcl-dev", &thinwall::bench::add_fcl},
    {"libccd", "libccd-dev", &thinwall::bench::add_libccd},
    {"Rapier", by_npm, [] { return thinwall::bench::add_npm("rapier"); }},
    {"Jolt", by_npm, [] { return thinwall::bench::add_npm("jolt"); }},
    {"PhysX", by_npm, [] { return thinwall::bench::add_npm("physx"); }},
    {"Havok", by_npm, [] { return thinwall::bench::add_npm("havok"); }},
    {"Box2D 3", by_npm, [] { return thinwall::bench::add_npm("box2d3"); }},
});

}  // namespace

int main(int argc, char** argv) {
  for (const Peer& peer : peers) {
    const bool there = peer.add();
    benchmark::AddCustomContext("peer_" + std::string(peer.name), there ? "built in" : "missing");
    if (there) continue;
    std::fprintf(
        stderr,
        "peers: %s was not found, and is left out: %s brings it; a package of Debian or Ubuntu is looked for when this is "
        "configured with -DTHINWALL_PEERS=ON\n",
        peer.name.data(), peer.remedy.data());
  }
  return thinwall::bench::run_benchmarks(argc, argv);
}
