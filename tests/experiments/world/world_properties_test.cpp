// What holds in every world: nothing that is left out changes an outcome, nor does the way the work is done, nor what else is there.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/discrete/dispatch.hpp>
#include <thinwall/experiments/world/pairs.hpp>

#include "experiments/world/random_world.hpp"
#include "support/property.hpp"

namespace thinwall::testing {
namespace {

/// As the drawn worlds without, but their boxes are oriented, and all turn.
DrawnWorld spinning_world(std::uint64_t seed) {
  DrawnWorld drawn = drawn_world(seed);
  WorldDraw draw(seed + 77);
  for (Body& body : drawn.bodies) {
    if (const auto* const box = std::get_if<Aabb<double>>(&body.shape); box && draw.pick(2) == 0)
      body.shape = to_obb(*box);
    if (std::holds_alternative<std::monostate>(body.shape) || std::holds_alternative<Aabb<double>>(body.shape))
      continue;
    body.turns = draw.pick(5) != 0;
    const Vec3<double> rate = draw.vector(draw.pick(3) == 0 ? 200 : 20, false);
    if (body.turns && !body.is_static && draw.pick(4) != 0) body.angular_velocity = rate;
  }
  return drawn;
}

struct Outcome {
  std::vector<std::uint64_t> hashes;
  std::vector<double> hits;
  std::vector<std::vector<CollisionEvent>> events;
};

Outcome outcome_of(const DrawnWorld& drawn, const std::vector<Body>& bodies, const WorldOptions& options) {
  World world(bodies, options);
  Outcome outcome;
  for (int k = 0; k < drawn.steps; ++k) {
    world.step(drawn.dt);
    outcome.hashes.push_back(world.state_hash());
    outcome.events.push_back(world.events().events());
    for (const Hit& hit : world.hits())
      outcome.hits.insert(outcome.hits.end(), {hit.time, hit.normal.sum(), hit.point.sum()});
  }
  return outcome;
}

std::string difference(const Outcome& a, const Outcome& b) {
  if (a.hashes != b.hashes) return "states differ";
  if (a.events != b.events) return "events differ";
  return a.hits == b.hits ? "" : "hits differ";
}

/// Empty, or what changes an outcome of this world that must not.
std::string changed_outcome(const DrawnWorld& drawn, std::uint64_t seed) {
  const Outcome planned = outcome_of(drawn, drawn.bodies, drawn.options);
  std::string wrong;
  const auto against = [&](const std::string& what, const std::vector<Body>& bodies, const auto& change) {
    WorldOptions options = drawn.options;
    change(options);
    const std::string differs = difference(planned, outcome_of(drawn, bodies, options));
    if (!differs.empty()) wrong += what + ": " + differs + "; ";
  };
  const bool is_asked = drawn.options.response || drawn.options.events;  // else the full plan finds hits for nobody
  if (is_asked) against("full plan", drawn.bodies, [](WorldOptions& o) { o.full_plan = true; });
  against("spin kept", drawn.bodies, [](WorldOptions& o) { o.keep = {"spin", "spin short of the gap"}; });
  const std::string kept(omission_names[seed % omission_names.size()]);
  if (is_asked) against(kept + " kept", drawn.bodies, [&](WorldOptions& o) { o.keep = {kept}; });
  against("another order", shuffled(drawn.bodies, seed), [](WorldOptions&) {});
  const auto names = pair_finder_names();
  const std::string name(names[seed % names.size()]);
  against(name, drawn.bodies, [&](WorldOptions& o) { o.broad_phase = name; });
  if (seed % 8 == 0) {  // threads take long to start
    against("2 threads", drawn.bodies, [](WorldOptions& o) { o.threads = 2; });
    against("3 threads", drawn.bodies, [](WorldOptions& o) { o.threads = 3; });
  }
  return wrong;
}

/// Empty, or how a body of those that begin apart, and are swept, sinks into another by more than `depth` [m].
std::string sinking(DrawnWorld drawn, std::uint64_t seed, double depth) {
  drawn.options.policy = seed % 2 == 0 ? TimePolicy::clamp : TimePolicy::event_driven;
  drawn.options.response = true;
  drawn.options.gate = 0;
  std::vector<Body> apart;
  for (Body body : drawn.bodies) {
    if (std::holds_alternative<std::monostate>(body.shape)) continue;
    if (body.mass > 1e9) body.mass = 1;  // what nothing stops may overrun a body that waits
    body.mask = ~0U;
    body.group = 1;
    const bool overlaps_one = std::any_of(apart.begin(), apart.end(), [&](const Body& other) {
      return separation(body.shape, other.shape)->distance <= 1e-6;
    });
    if (!overlaps_one) apart.push_back(body);
  }
  World world(apart, drawn.options);
  for (int k = 0; k < 5; ++k) {
    world.step(drawn.dt);
    if (!is_finite(world.energy())) return "the energy is not finite";
    const auto& bodies = world.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        if (bodies[i].is_static && bodies[j].is_static) continue;
        const double distance = separation(bodies[i].shape, bodies[j].shape)->distance;
        if (distance < -depth) {
          return called(bodies[i]) + " is " + std::to_string(-distance) + " deep in " + called(bodies[j]) +
                 " after step " + std::to_string(k);
        }
      }
    }
  }
  return "";
}

/// Checks `runs` worlds, of each its seed; complaint() is empty, or says what is wrong.
template <class Complaint> void check_worlds(int runs, const Complaint& complaint) {
  check_property(runs, [&] {
    const auto seed = static_cast<std::uint64_t>(draw_integer(0, 1 << 30));
    const std::string wrong = complaint(seed);
    if (!wrong.empty()) RC_FAIL("seed " + std::to_string(seed) + ": " + wrong);
  });
}

TEST(WorldProperties, no_plan_thread_order_or_broad_phase_changes_an_outcome) {
  check_worlds(10000, [](std::uint64_t seed) { return changed_outcome(drawn_world(seed), seed); });
}
TEST(SpinProperties, no_plan_thread_order_or_broad_phase_changes_an_outcome) {
  check_worlds(1500, [](std::uint64_t seed) { return changed_outcome(spinning_world(seed), seed); });
}

TEST(WorldProperties, swept_bodies_never_sink_into_each_other) {
  check_worlds(2000, [](std::uint64_t seed) { return sinking(drawn_world(seed), seed, 1e-11); });  // by rounding
}
/// A contact that rolls may sink between two looks.
TEST(SpinProperties, swept_bodies_hardly_sink_into_each_other) {
  check_worlds(500, [](std::uint64_t seed) { return sinking(spinning_world(seed), seed, 2e-3); });
}

TEST(WorldProperties, begins_and_ends_pair_up_and_nothing_is_ever_nan) {
  check_worlds(2000, [](std::uint64_t seed) {
    const DrawnWorld drawn = drawn_world(seed);
    WorldOptions options = drawn.options;
    options.events = true;
    World world(drawn.bodies, options);
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> open;
    std::string wrong;
    world.events().listen([&](const CollisionEvent& event) {
      bool& is_open = open[{event.first, event.second}];
      if (is_open == (event.kind == CollisionEventKind::begin)) wrong = "an event out of turn";
      is_open = event.kind != CollisionEventKind::end;
    });
    for (int k = 0; k < 6; ++k) {
      const StepReport& report = world.step(drawn.dt);
      const std::int64_t count = std::ssize(world.bodies());
      if (report.impulses > count * options.max_events + count * count * (options.contact_rounds + 1) * 3)
        wrong = "too many impulses";
      for (const Body& body : world.bodies()) {
        if (!is_finite(body.velocity) || !is_finite(position(body))) wrong = called(body) + " is not finite";
      }
      if (!is_finite(world.energy())) wrong = "the energy is not finite";
      if (k == 3 && !world.bodies().empty()) world.remove(world.bodies()[world.bodies().size() / 2].id);
    }
    while (!world.bodies().empty()) world.remove(world.bodies().front().id);
    world.step(drawn.dt);
    for (const auto& [pair, is_open] : open) {
      if (is_open) wrong = "a contact that never ends";
    }
    return wrong;
  });
}

// ---- Whom a body may meet, kept up to date.

/// However often bodies turn in a step: what is kept of them is bounded by how many there are.
TEST(Neighbors, keep_one_box_a_body_and_one_link_a_pair) {
  constexpr std::uint32_t count = 8;
  std::vector<Proxy> proxies(count);
  const auto box_at = [](double x) {
    Proxy box;
    box.low = {x, 0, 0};
    box.high = {x + 1, 1, 1};
    return box;
  };
  for (std::uint32_t i = 0; i < count; ++i) proxies[i] = box_at(i);
  const std::vector<bool> has_links(count, true);
  Neighbors neighbors;
  neighbors.begin(proxies, {}, has_links, false);
  const auto wander = [&](int rounds) {
    for (int round = 0; round < rounds; ++round) {
      for (std::uint32_t i = 0; i < count; ++i)
        neighbors.change(i, box_at((i + static_cast<std::uint32_t>(round)) % count));
    }
    return neighbors.bytes();
  };
  wander(count);
  const std::size_t once_around = wander(count);
  EXPECT_EQ(wander(100 * count), once_around);
}

// ---- The shots of thin_wall in a world: balls at a thin wall, at random speed, angle and phase. Among ten thousand other bodies
// each ends where it ends alone, to the bit, and as many go through unseen as theory says.

constexpr std::uint32_t shot_count = 400, crowd_count = 10'000;
constexpr double lane_width = 50, thickness = 0.01, radius = 0.05, dt = 0.01;  // [m], [s]
constexpr int steps = 8;

struct Lane {
  std::vector<Body> bodies;  ///< the wall, then the ball
  double chance = 0;         ///< [1] that a look at the end of each step misses the wall
};

/// The ball begins somewhere on the way of one step, a few steps before the wall at x = 0.
Lane drawn_lane(std::uint32_t k) {
  WorldDraw draw(1000 + k);
  const double speed = draw.in(5, 100), angle = draw.in(0, 1), phase = draw.in(0, 1), y = lane_width * k;
  const double across = speed * std::cos(angle) * dt;
  const Aabb<double> wall{{0, y, 0}, {thickness / 2, lane_width / 2 - 1, 10}};
  const Sphere<double> ball{{-(2 + phase) * across - radius - thickness / 2, y, 0}, radius};
  const Vec3<double> velocity = {speed * std::cos(angle), speed * std::sin(angle), 0};
  return {.bodies = {{.id = 2 * k, .name = {}, .shape = wall, .is_static = true},
                     {.id = 2 * k + 1, .name = {}, .shape = ball, .velocity = velocity}},
          .chance = std::max(0.0, 1 - (thickness + 2 * radius) / across)};
}

/// Bodies of every shape that meet each other, and no lane.
std::vector<Body> drawn_crowd() {
  WorldDraw draw(7);
  std::vector<Body> crowd(crowd_count);
  for (std::uint32_t i = 0; i < crowd_count; ++i) {
    const Vec3<double> place = draw.vector(15, false) + Vec3<double>(0, 0, 1000);
    crowd[i].id = 2 * shot_count + i;
    crowd[i].shape = drawn_shape(draw, 5, place, false);
    crowd[i].velocity = draw.vector(5, false);
  }
  return crowd;
}

World stepped(std::vector<Body> bodies, TimePolicy policy, std::vector<bool>& seen) {
  World world(std::move(bodies), {.policy = policy, .substeps = 3, .response = false});
  for (int step = 0; step < steps; ++step) {
    world.step(dt);
    for (const Hit& hit : world.hits()) {
      if (hit.second < 2 * shot_count) seen[hit.second / 2] = true;
    }
  }
  return world;
}

class ShotsInACrowd : public ::testing::TestWithParam<TimePolicy> {};

TEST_P(ShotsInACrowd, go_through_exactly_as_alone) {
  std::vector<Body> together = drawn_crowd();
  std::vector<bool> seen_alone(shot_count), seen_together(shot_count);
  std::vector<Vec3<double>> ends;
  double expected = 0, variance = 0;
  for (std::uint32_t k = 0; k < shot_count; ++k) {
    const Lane lane = drawn_lane(k);
    together.insert(together.end(), lane.bodies.begin(), lane.bodies.end());
    expected += lane.chance;
    variance += lane.chance * (1 - lane.chance);
    ends.push_back(position(*stepped(lane.bodies, GetParam(), seen_alone).find(2 * k + 1)));
  }
  const World crowd = stepped(together, GetParam(), seen_together);
  EXPECT_GT(crowd.report().hits, 1000);  // others do meet
  int missed = 0;
  for (std::uint32_t k = 0; k < shot_count; ++k) {
    EXPECT_EQ(seen_together[k], seen_alone[k]) << k;
    EXPECT_EQ(position(*crowd.find(2 * k + 1)), ends[k]) << k;
    EXPECT_GT(ends[k].x(), radius + thickness) << k;  // all have crossed
    missed += seen_alone[k] ? 0 : 1;
  }
  if (GetParam() == TimePolicy::discrete) {
    EXPECT_NEAR(missed, expected, 4 * std::sqrt(variance));
    EXPECT_GT(expected, shot_count / 4.0);
  } else if (GetParam() != TimePolicy::substeps) {
    EXPECT_EQ(missed, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(TimePolicies, ShotsInACrowd, ::testing::ValuesIn(all_policies),
                         [](const auto& policy) { return std::string(name_of(policy.param)); });

}  // namespace
}  // namespace thinwall::testing
