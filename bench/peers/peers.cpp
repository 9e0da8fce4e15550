/// What do others take for the same queries, and what do they get wrong?
/// Casts, rays, contacts and overlap tests of the libraries that the build found, on the queries of pairs.cpp, beside our own
/// front door; their objects are made beforehand. Counters as there: what is missed, what is hit in error, how far off.
/// A new peer is a file that defines add_NAME() and a line below.

#include <array>
#include <cstdio>

#include "peers/peer.hpp"

namespace {

using thinwall::bench::Peer;

constexpr std::array<Peer, 5> peers = {{
    {"thinwall", "", &thinwall::bench::add_thinwall},
    {"Bullet", "libbullet-dev", &thinwall::bench::add_bullet},
    {"ODE", "libode-dev", &thinwall::bench::add_ode},
    {"FCL", "libfcl-dev", &thinwall::bench::add_fcl},
    {"libccd", "libccd-dev", &thinwall::bench::add_libccd},
}};

}  // namespace

int main(int argc, char** argv) {
  for (const Peer& peer : peers) {
    const bool there = peer.add();
    benchmark::AddCustomContext("peer_" + std::string(peer.name), there ? "built in" : "missing");
    if (there) continue;
    std::fprintf(
        stderr,
        "peers: %s was not found when this was configured, and is left out; on Debian or Ubuntu, install %s and configure "
        "again with -DTHINWALL_PEERS=ON\n",
        peer.name.data(), peer.package.data());
  }
  thinwall::bench::FloorReporter reporter;
  return thinwall::bench::run_benchmarks(argc, argv, reporter);
}
