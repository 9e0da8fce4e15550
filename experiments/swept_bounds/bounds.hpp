#pragma once
/// The bounds that the balls are put to, what the library makes of a moving shape and its exact answer; what is counted; and what
/// the bounds cost. The runner's clock takes the time of units that do nothing but one kind of work; each is repeated, in turn with
/// all others, and the median counts.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/swept_bounds/model.hpp>

namespace thinwall {

/// What is counted over the balls of one cell and bound.
struct SweepTally {
  std::int64_t shots = 0, touching = 0, reported = 0, false_hits = 0, grazing = 0, missed = 0;

  static constexpr auto fields() {
    using T = SweepTally;
    return record(sum("shots", &T::shots, "1", "Balls around the bound."),
                  sum("touching", &T::touching, "1", "Of those, truly touched during the step."),
                  sum("reported", &T::reported, "1", "Of the balls, reported by the bound."),
                  sum("false_hits", &T::false_hits, "1", "Reported, but not touched."),
                  sum("grazing", &T::grazing, "1", "More balls, which just touch."),
                  sum("missed", &T::missed, "1", "Touched, of either kind, and not reported."));
  }
  std::int64_t touched() const { return touching + grazing; }
  bool operator==(const SweepTally&) const = default;
};

/// What a run of a clock is about.
enum class TimedWork {
  build,    ///< make the bound, once a moving shape and step
  test,     ///< put every ball to the bound
  exact,    ///< put every ball to the closed form: the price of a hit, false or true
  pipeline  ///< put every ball to the bound, and to the closed form if it is reported
};
inline constexpr std::array<std::string_view, 4> timed_work_names = {"build", "test", "exact", "pipeline"};
constexpr std::string_view name(TimedWork work) { return timed_work_names[static_cast<std::size_t>(work)]; }

using BallTest = std::function<bool(const Sphere<double>&)>;

struct SweptBound {
  std::string name;
  bool makes_volume;  ///< and asks what overlaps it; else it asks the moving shape itself, and has no false hits
  std::function<bool(SweptForm)> serves;
  std::function<FittedBody(const Sweep&)> body;
  std::function<FittedBody(const Sweep&)>
      drawn_around;                               ///< what balls are drawn around: the same, or as the library turns it
  std::function<BallTest(const Sweep&)> reports;  ///< makes the bound, once for all balls
  /// Goes `passes` times through the balls; returns how many were reported. Nothing else is done in that time.
  std::function<std::int64_t(TimedWork, const Sweep&, std::span<const Sphere<double>>, int passes)> repeat;
};

std::vector<SweptBound> all_swept_bounds();

/// A bound that serves a cell's shape.
struct SweepPair {
  Sweep sweep;
  const SweptBound* bound;
};
std::vector<SweepPair> serving_pairs(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds);

SweepTally count_balls(const SweepPair& pair, std::uint64_t seed, std::int64_t shots);

/// What was counted and what theory expects.
struct SweepRow : SweepPair {
  SweepTally tally;
  SweepTheory theory = sweep_theory(bound->body(sweep), sweep);
};

/// Reported, truly touched, false and missed against theory, as the self-test wants it: `method` is the bound, `scalar`
/// the event.
std::vector<CellCount> counts_of(const std::vector<SweepRow>& rows);

/// One kind of work at one cell and bound, and the balls it is done to.
struct TimedSubject {
  SweepPair pair;
  TimedWork work;
  std::vector<Sphere<double>> balls;  ///< not empty
  int passes;                         ///< through all of them
  double reported;                    ///< [1] share of the pairs in question that the bound reports
  double false_hits;                  ///< [1] share of them that it reports and the shape does not touch

  std::int64_t tests() const { return static_cast<std::int64_t>(balls.size()) * passes; }
};

/// The pairs in question are those that a broad phase of boxes hands over: balls whose bounding box overlaps the shape's
/// swept one, the centers uniform. False hits alone are put to the closed form; a bound without any has no such subject.
std::vector<TimedSubject> timed_subjects(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds,
                                         std::uint64_t seed);

/// What a bound costs at a cell.
struct SweepCost : SweepPair {
  double reported, false_hits;                          ///< [1] shares of the pairs in question
  std::array<std::vector<double>, 4> nanoseconds = {};  ///< of each TimedWork, one a round; none of what there is not

  /// What this share of the rounds took at most: the median.
  std::optional<double> quantile_ns(TimedWork work, double share = 0.5) const;
  /// Time spent on false hits, a pair in question.
  double wasted_ns() const { return false_hits * quantile_ns(TimedWork::exact).value_or(0); }
};

/// `seconds` of every subject in turn, round by round; none if there were no rounds.
std::vector<SweepCost> sweep_costs(const std::vector<TimedSubject>& subjects, std::span<const double> seconds);

}  // namespace thinwall
