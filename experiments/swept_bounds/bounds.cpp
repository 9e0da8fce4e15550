#include <thinwall/experiments/swept_bounds/bounds.hpp>

#include <algorithm>
#include <type_traits>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/type_list.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/swept/swept_volume.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

using Ball = Sphere<double>;
using MovingBall = Moving<Ball>;
using MovingBox = Moving<Aabb<double>>;

MovingBall ball_around(const MovingBox& m) { return {{m.shape.center, m.shape.half_extents.norm()}, m.displacement}; }

template <Shape A> bool meet_in_the_step(const Moving<A>& moving, const Ball& ball) {
  const ToiStatus status = time_of_impact(moving, at_rest(ball)).status;
  return status == ToiStatus::hit || status == ToiStatus::overlapping;
}

/// What every bound but the last two does: make a volume, and ask whether it overlaps the ball.
template <FittedBody body_of(const Sweep&)> struct OverlapBound {
  static constexpr bool makes_volume = true;
  static FittedBody body(const Sweep& s) { return body_of(s); }
  static FittedBody drawn_around(const Sweep& s) { return body_of(s); }
  template <Shape Volume> static bool reports(const Volume& volume, const Ball& ball) { return overlaps(volume, ball); }
};

struct EnclosingSphere : OverlapBound<enclosing_sphere_body> {
  static constexpr std::string_view name = "enclosing_sphere";
  static Ball around(const MovingBall& m) { return enclosing_sphere(m); }
  static Ball around(const MovingBox& m) { return enclosing_sphere(ball_around(m)); }
};

struct EnclosingAabb : OverlapBound<enclosing_aabb_body> {
  static constexpr std::string_view name = "enclosing_aabb";
  static Aabb<double> around(const MovingBall& m) { return swept_bounds(m); }
  static Aabb<double> around(const MovingBox& m) { return enclosing_aabb(m); }
};

struct SweptCapsule : OverlapBound<capsule_body> {
  static constexpr std::string_view name = "capsule";
  static Capsule<double> around(const MovingBall& m) { return swept_volume(m); }
  static Capsule<double> around(const MovingBox& m) { return swept_volume(ball_around(m)); }
};

struct OrientedBox : OverlapBound<oriented_box_body> {
  static constexpr std::string_view name = "oriented_box";
  static Obb<double> around(const MovingBox& m) { return swept_volume(m); }
  /// Of two rectangles that mirror each other rounding picks one: balls are drawn around the one that was picked.
  static FittedBody drawn_around(const Sweep& s) { return box_around(exact_body(s), swept_volume(moving_box(s)).axes); }
};

struct ExactBound {
  static constexpr bool makes_volume = false;
  static FittedBody body(const Sweep& s) { return exact_body(s); }
  static FittedBody drawn_around(const Sweep& s) { return exact_body(s); }
};

/// Seen from the box the ball moves, and sweeps a capsule: exact, but without a time.
struct RelativeCapsule : ExactBound {
  static constexpr std::string_view name = "relative_capsule";
  static MovingBox around(const MovingBox& m) { return m; }
  static bool reports(const MovingBox& m, const Ball& ball) {
    return overlaps(swept_volume(MovingBall{ball, -m.displacement}), m.shape);
  }
};

struct ExactMotion : ExactBound {
  static constexpr std::string_view name = "closed_form";
  template <Shape A> static Moving<A> around(const Moving<A>& m) { return m; }
  template <Shape A> static bool reports(const Moving<A>& m, const Ball& ball) { return meet_in_the_step(m, ball); }
};

/// How many of the balls `answers` is true of, over all passes.
template <class Answers> std::int64_t go_through(std::span<const Ball> balls, int passes, const Answers& answers) {
  std::int64_t count = 0;
  for (int pass = 0; pass < passes; ++pass) {
    for (const Ball& ball : balls) count += answers(ball) ? 1 : 0;
    keep(balls);
  }
  return count;
}

template <class Bound, class Motion>
std::int64_t repeat_work(TimedWork work, const Motion& motion, std::span<const Ball> balls, int passes) {
  const auto bound = Bound::around(motion);
  keep(motion);
  keep(bound);
  const auto build = [&](const Ball&) {
    keep(Bound::around(motion));
    return true;
  };
  const auto test = [&](const Ball& ball) { return Bound::reports(bound, ball); };
  const auto exact = [&](const Ball& ball) { return meet_in_the_step(motion, ball); };
  const auto pipeline = [&](const Ball& ball) { return test(ball) && exact(ball); };
  if (work == TimedWork::build) return go_through(balls, passes, build);
  if (work == TimedWork::exact) return go_through(balls, passes, exact);
  if (work == TimedWork::test || std::is_same_v<Bound, ExactMotion>) return go_through(balls, passes, test);
  return go_through(balls, passes, pipeline);
}

using Bounds = TypeList<EnclosingSphere, EnclosingAabb, SweptCapsule, OrientedBox, RelativeCapsule, ExactMotion>;

/// Every bound serves boxes.
template <class Bound> constexpr bool serves_balls = requires(const MovingBall& m) { Bound::around(m); };

/// Calls `ask` with the moving shape, which the bound serves, as the type it is.
template <class Bound> auto ask_shape(const Sweep& s, const auto& ask) {
  if constexpr (serves_balls<Bound>) {
    if (s.form == SweptForm::sphere) return ask(moving_ball(s));
  }
  return ask(moving_box(s));
}

template <class Bound> SweptBound erased() {
  return {
      .name = std::string(Bound::name),
      .makes_volume = Bound::makes_volume,
      .serves = [](SweptForm form) { return serves_balls<Bound> || form != SweptForm::sphere; },
      .body = Bound::body,
      .drawn_around = Bound::drawn_around,
      .reports =
          [](const Sweep& s) {
            return ask_shape<Bound>(s, [](const auto& motion) -> BallTest {
              return [bound = Bound::around(motion)](const Ball& ball) { return Bound::reports(bound, ball); };
            });
          },
      .repeat =
          [](TimedWork work, const Sweep& s, std::span<const Ball> balls, int passes) {
            return ask_shape<Bound>(
                s, [&](const auto& motion) { return repeat_work<Bound>(work, motion, balls, passes); });
          },
  };
}

constexpr int balls_in_question = 2048, tests_a_round = 1 << 13;

}  // namespace

std::vector<SweptBound> all_swept_bounds() {
  std::vector<SweptBound> all;
  for_each_type(Bounds{}, [&]<class Bound>(TypeTag<Bound>) { all.push_back(erased<Bound>()); });
  return all;
}

std::vector<SweepPair> serving_pairs(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds) {
  std::vector<SweepPair> pairs;
  for (const Sweep& sweep : sweeps) {
    for (const SweptBound& bound : bounds) {
      if (bound.serves(sweep.form)) pairs.push_back({sweep, &bound});
    }
  }
  return pairs;
}

SweepTally count_balls(const SweepPair& pair, std::uint64_t seed, std::int64_t shots) {
  const Sweep& s = pair.sweep;
  const BallRegion region = region_around(pair.bound->drawn_around(s), s);
  const RandomStream stream = random_stream(s, seed);
  const BallTest reports = pair.bound->reports(s);
  SweepTally t;
  t.shots = t.grazing = shots;
  for (std::int64_t i = 0; i < shots; ++i) {
    const auto trial = static_cast<std::uint64_t>(i);
    const Ball ball = ball_in(region, s, stream, trial);
    const bool touched = touches(s, ball.center), reported = reports(ball);
    t.touching += touched ? 1 : 0;
    t.reported += reported ? 1 : 0;
    t.false_hits += reported && !touched ? 1 : 0;
    t.missed += touched && !reported ? 1 : 0;
    t.missed += reports(grazing_ball(s, region.axes, stream, trial)) ? 0 : 1;
  }
  return t;
}

std::vector<CellCount> counts_of(const std::vector<SweepRow>& rows) {
  std::vector<CellCount> counts;
  for (const SweepRow& r : rows) {
    const SweepTally& t = r.tally;
    counts.push_back({r.bound->name, "touching", t.shots, t.touching, r.theory.touching});
    counts.push_back({r.bound->name, "reported", t.shots, t.reported, r.theory.reported()});
    counts.push_back({r.bound->name, "false", t.shots, t.false_hits, r.theory.false_hits});
    counts.push_back({r.bound->name, "missed", t.shots + t.grazing, t.missed, 0});
  }
  return counts;
}

std::vector<TimedSubject> timed_subjects(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds,
                                         std::uint64_t seed) {
  const auto part_of_all = [](std::size_t part) { return static_cast<double>(part) / balls_in_question; };
  std::vector<TimedSubject> subjects;
  for (const SweepPair& pair : serving_pairs(sweeps, bounds)) {
    const Sweep& s = pair.sweep;
    const BallRegion region = region_around(enclosing_aabb_body(s), s, 1);
    const RandomStream stream = random_stream(s, seed);
    const BallTest reports = pair.bound->reports(s);
    std::vector<Ball> all, wrong;
    std::size_t reported = 0;
    for (std::uint64_t i = 0; i < balls_in_question; ++i) {
      all.push_back(ball_in(region, s, stream, i));
      if (!reports(all.back())) continue;
      ++reported;
      if (!touches(s, all.back().center)) wrong.push_back(all.back());
    }
    for (const TimedWork work : {TimedWork::build, TimedWork::test, TimedWork::exact, TimedWork::pipeline}) {
      const std::vector<Ball>& balls = work == TimedWork::exact ? wrong : all;
      if (balls.empty()) continue;
      const int passes = std::max(1, tests_a_round / static_cast<int>(balls.size()));
      subjects.push_back({pair, work, balls, passes, part_of_all(reported), part_of_all(wrong.size())});
    }
  }
  return subjects;
}

std::optional<double> SweepCost::quantile_ns(TimedWork work, double share) const {
  const std::vector<double>& rounds = nanoseconds[static_cast<std::size_t>(work)];
  if (rounds.empty()) return std::nullopt;
  return share == 0.5 ? median(rounds) : quantile(rounds, share);
}

std::vector<SweepCost> sweep_costs(const std::vector<TimedSubject>& subjects, std::span<const double> seconds) {
  std::vector<SweepCost> costs;
  if (seconds.empty()) return costs;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const TimedSubject& t = subjects[i];
    if (costs.empty() || costs.back().sweep != t.pair.sweep || costs.back().bound != t.pair.bound) {
      costs.push_back({t.pair, t.reported, t.false_hits});
    }
    std::vector<double>& rounds = costs.back().nanoseconds[static_cast<std::size_t>(t.work)];
    for (std::size_t k = i; k < seconds.size(); k += subjects.size())
      rounds.push_back(1e9 * seconds[k] / static_cast<double>(t.tests()));
  }
  return costs;
}

}  // namespace thinwall
