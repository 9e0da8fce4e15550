#pragma once
/// What an adapter is written with: the same queries for everybody, a row a peer and pair, named KIND/PAIR/PEER.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "query_sets.hpp"

namespace thinwall::bench {

using Ball = Sphere<double>;
using Box = Aabb<double>;
using TurnedBox = Obb<double>;
using Pill = Capsule<double>;

// Made once, in peers.cpp.
#define THINWALL_PEER_SETS(made)                                \
  made template const Shots<Ball, Box>& any_shots();            \
  made template const Shots<Ball, Ball>& any_shots();           \
  made template const Shots<Box, Box>& any_shots();             \
  made template const Shots<Ball, Pill>& any_shots();           \
  made template const Shots<Pill, Box>& any_shots();            \
  made template const Shots<Box, TurnedBox>& any_shots();       \
  made template const Rays<Ball>& any_rays();                   \
  made template const Rays<Box>& any_rays();                    \
  made template const Rays<TurnedBox>& any_rays();              \
  made template const Rays<Pill>& any_rays();                   \
  made template const Poses<Ball, Ball>& any_poses();           \
  made template const Poses<Box, Box>& any_poses();             \
  made template const Poses<Ball, Box>& any_poses();            \
  made template const Poses<TurnedBox, TurnedBox>& any_poses(); \
  made template const Poses<Pill, Pill>& any_poses();
THINWALL_PEER_SETS(extern)
const Shots<Ball, Box>& wall_shots();
const Shots<Ball, Box>& plane_shots();
inline constexpr std::string_view in_plane = "sphere_aabb_in_plane";

/// visit(pair, set, least operations) of each pair whose time of impact is asked for.
template <class Visit> void for_each_cast(const Visit& visit) {
  visit("sphere_thin_wall", &wall_shots, flat_hit);
  visit("sphere_aabb", &any_shots<Ball, Box>, flat_hit);
  visit(std::string(in_plane), &plane_shots, flat_hit);
  visit("sphere_sphere", &any_shots<Ball, Ball>, round_hit);
  visit("aabb_aabb", &any_shots<Box, Box>, flat_hit);
  visit("sphere_capsule", &any_shots<Ball, Pill>, round_hit);
  visit("capsule_aabb", &any_shots<Pill, Box>, flat_hit);
  visit("aabb_obb", &any_shots<Box, TurnedBox>, flat_hit);
}

/// visit(shape, set, least operations) of each shape that rays are cast at.
template <class Visit> void for_each_ray(const Visit& visit) {
  visit("sphere", &any_rays<Ball>, round_hit);
  visit("aabb", &any_rays<Box>, flat_hit);
  visit("obb", &any_rays<TurnedBox>, flat_hit);
  visit("capsule", &any_rays<Pill>, round_hit);
}

/// visit(pair, set) of each pair that is looked at at one instant.
template <class Visit> void for_each_pose(const Visit& visit) {
  visit("sphere_sphere", &any_poses<Ball, Ball>);
  visit("aabb_aabb", &any_poses<Box, Box>);
  visit("sphere_aabb", &any_poses<Ball, Box>);
  visit("obb_obb", &any_poses<TurnedBox, TurnedBox>);
  visit("capsule_capsule", &any_poses<Pill, Pill>);
}

/// A row: `prepare(query)` makes the peer's own objects, as its user would keep them, and is not timed; `ask(prepared)` is, and
/// gives the time or the depth as the set's truth is given.
template <class Query, class Prepare, class Ask>
void add_row(const std::string& name, const QuerySet<Query>& (*set)(), const Operations& least, Prepare prepare,
             Ask ask) {
  const auto count = counted_once(
      [set, prepare, ask] { return errors_of(set(), [&](const Query& query) { return ask(prepare(query)); }); });
  benchmark::RegisterBenchmark(name.c_str(), [set, least, prepare, ask, count](benchmark::State& state) {
    std::vector<decltype(prepare(std::declval<const Query&>()))> prepared;
    prepared.reserve(set().queries.size());
    for (const Query& query : set().queries) prepared.push_back(prepare(query));
    time_queries(state, prepared, ask);
    count(state);
    add_query_floor(state, set().queries, least);
  });
}

struct Peer {
  std::string_view name;    ///< as people call it
  std::string_view remedy;  ///< what brings it; empty for our own
  bool (*add)();            ///< registers its rows; false if it is not there
};

bool add_thinwall();
bool add_bullet();
bool add_ode();
bool add_fcl();
bool add_libccd();
bool add_npm(const std::string& engine);

}  // namespace thinwall::bench
