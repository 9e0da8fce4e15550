#pragma once
/// The precision ladder: the axes along which one thing at a time is made extreme, the pairs of shapes and the precisions that are
/// asked there, what comes of it, where a method breaks, and what theory says. The kernels are instantiated in kernels/ask.cpp alone.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/settings.hpp>

namespace thinwall {

// ---- What is asked.

enum class ExtremeAxis { scale, distance, speed, thickness, offset, grazing, ratio };

/// What a query is made from. R is the size of the pair: the sum of the radii of the balls around its two shapes.
struct Extreme {
  double scale = 1;      ///< [1] all lengths are multiplied by it
  double distance = 3;   ///< [R] the path until first contact
  double speed = 0;      ///< [R] the path in the step; 0: as long as it takes to make contact at 0.3 to 0.9 of the step
  double thickness = 1;  ///< [1] the least half width of the box is multiplied by it, and so is the radius of the other
  double offset = 0;     ///< [R] of the pair from the origin
  double grazing = 0;    ///< [1] 1 - b / R, or on the other side b / R - 1; 0: not next to grazing
  double ratio = 1;      ///< [1] the first shape's size is multiplied by it
};

/// An axis: its name as a key of the settings, and what it is. 1 is the value that is no extreme.
struct AxisInfo {
  std::string_view name, title;  ///< "distance", "distance / R"
  double Extreme::*factor;
  Range allowed;
};
const AxisInfo& info(ExtremeAxis axis);

/// One value of one axis.
struct Place {
  ExtremeAxis axis = ExtremeAxis::scale;
  double value = 1;
  auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr): false alarm
};
Extreme extreme_at(const Place& place);

/// Every value of every axis that the settings choose, axis by axis, from the least to the greatest. Throws UsageError.
std::vector<Place> make_places(const Settings& settings);

enum class Precision { in_float, in_double, in_long_double, at_50_digits };
inline constexpr std::array all_precisions = {Precision::in_float, Precision::in_double, Precision::in_long_double,
                                              Precision::at_50_digits};
constexpr std::string_view name(Precision precision) {  // in the settings
  constexpr std::array<std::string_view, 4> names{"float", "double", "long_double", "50_digits"};
  return names[static_cast<std::size_t>(precision)];
}
double unit_of(Precision precision);  ///< [1] u, its round-off

/// What came of one method on the queries of one place, pair and precision.
struct ExtremeTally {
  std::string method{};
  std::int64_t queries = 0, touching = 0, changed = 0, wrong = 0, far_wrong = 0, gave_up = 0, invalid = 0, timed = 0;
  double worst_wrong = 0;
  double forward_median = 0, forward_max = 0, backward_median = 0, backward_max = 0;
  double loss_rms = 0, loss_max = 0;
  double nanoseconds = 0;

  static constexpr auto fields() {
    using T = ExtremeTally;
    return record(
        kept("method", &T::method, "", "Way to find the time of impact; textbook is a foil."),
        sum("queries", &T::queries, "1", "That the precision can hold."),
        sum("touching", &T::touching, "1", "Of those, that touch, by the oracle."),
        sum("changed", &T::changed, "1", "Whose verdict rounding the input has changed, whatever the method."),
        sum("wrong", &T::wrong, "1", "Verdicts that are wrong, by however little."),
        sum("far_wrong", &T::far_wrong, "1", "Verdicts that are wrong by more than 4 u."),
        most("worst_wrong", &T::worst_wrong, "u",
             "The worst wrong verdict: the change of its input that makes it right."),
        sum("gave_up", &T::gave_up, "1", "Out of evaluations."),
        sum("invalid", &T::invalid, "1", "No number, or called invalid."),
        sum("timed", &T::timed, "1", "Hits whose time is judged."),
        kept("forward_median", &T::forward_median, "u kappa t", "Median error of the time."),
        most("forward_max", &T::forward_max, "u kappa t", "Largest error of the time."),
        kept("backward_median", &T::backward_median, "u", "Median backward error."),
        most("backward_max", &T::backward_max, "u", "Largest backward error."),
        kept("loss_rms", &T::loss_rms, "1", "Root mean square of the error along the normal over u d^2 / (2 R)."),
        most("loss_max", &T::loss_max, "1", "Largest of the same; missing where no radius is."),
        kept("nanoseconds", &T::nanoseconds, "ns", "A query."));
  }
};

struct ExtremeInquiry {
  Place place{};
  std::int64_t queries = 0;
  std::uint64_t seed = 0;
  std::vector<std::string> methods{};  ///< that are asked for
  double tolerance = 1;                ///< [epsilon]
};
using AskExtreme = std::vector<ExtremeTally> (*)(const ExtremeInquiry& inquiry);

/// Who is asked about a pair. Boxes have no radius to give them a normal where they touch.
enum class PairSet {
  rounded,            ///< every method, in every precision: with a ball
  boxes,              ///< the same: two boxes
  closed_form_alone,  ///< and the foil, in float and double
};
constexpr std::string_view name(PairSet pairs) {
  constexpr std::array<std::string_view, 3> names{"with a ball", "two boxes", "closed form alone"};
  return names[static_cast<std::size_t>(pairs)];
}

struct ExtremePair {
  std::string_view name;
  PairSet set;
  bool has_box;                                        ///< that can be thin
  std::array<AskExtreme, all_precisions.size()> asks;  ///< null: not in that precision
};
std::span<const ExtremePair> extreme_pairs();

/// Every method that is asked anywhere, the foil first.
std::vector<std::string_view> extreme_method_names();

/// A method at a place, on a pair, in a precision; of the queries that this can hold there is at least one.
struct ExtremeRow {
  const ExtremePair* pair;
  Precision precision;
  Place place;
  ExtremeTally tally;
};

/// What was asked of two balls along the distance: there the textbook loses by theory.
std::vector<ExtremeRow> two_balls(const std::vector<ExtremeRow>& rows, std::string_view method, Precision precision);

// ---- Where a method breaks.

/// An axis from its usual value outward, to one side: along these a method survives, and then breaks.
struct Arm {
  ExtremeAxis axis;
  int side;  ///< +1 to greater values, -1 to lesser
  std::string_view name;

  std::string_view side_name() const { return side > 0 ? "greater" : "lesser"; }
};
inline constexpr std::array all_arms = {Arm{ExtremeAxis::scale, -1, "small"},  Arm{ExtremeAxis::scale, 1, "large"},
                                        Arm{ExtremeAxis::distance, 1, "far"},  Arm{ExtremeAxis::speed, -1, "slow"},
                                        Arm{ExtremeAxis::speed, 1, "fast"},    Arm{ExtremeAxis::thickness, -1, "thin"},
                                        Arm{ExtremeAxis::offset, 1, "offset"}, Arm{ExtremeAxis::grazing, -1, "graze"},
                                        Arm{ExtremeAxis::ratio, -1, "unequal"}};

/// Why a method is broken, the worst first.
enum class Flaw {
  verdict,  ///< a wrong verdict whose input would have to change by more than 4 u to make it right
  error,    ///< a time off by more than 100 u kappa t
  nan,      ///< no number, or a valid input called invalid
  gave_up,  ///< out of evaluations
};
constexpr std::string_view name(Flaw flaw) {
  constexpr std::array<std::string_view, 4> names{"verdict", "error", "nan", "gave_up"};
  return names[static_cast<std::size_t>(flaw)];
}
inline constexpr double break_verdict = 4;  ///< [u]
inline constexpr double break_error = 100;  ///< [u kappa t] two decimals lost

std::optional<Flaw> flaw_of(const ExtremeTally& tally);

/// A method in a precision, on some of the pairs.
struct ExtremeContender {
  std::string method;
  Precision precision;
  PairSet pairs;
};

/// How far a contender gets along an arm, on its pairs together.
struct Survival : ExtremeContender {
  const Arm* arm;
  std::optional<double> survived{};  ///< the last value before the first at which something was wrong
  std::optional<double> broken{};    ///< that first value
  std::optional<Flaw> flaw{};        ///< the worst there
  std::string_view pair{};           ///< whose

  bool is_asked() const { return survived || broken; }
};
/// `rows` are the contender's, at all places; `arm` is one of `all_arms`.
Survival survival(const std::vector<ExtremeRow>& rows, const Arm& arm, const ExtremeContender& whose = {});

// ---- The self-test: the textbook's loss against its theory, and the closed form against its contract.

/// One thing that theory says, held against the cells of one precision.
struct LadderTest {
  std::string what;
  Precision precision;
  std::int64_t cells = 0;
  double measured = 0;  ///< the worst of the cells, in the unit of `allowed`
  double least = 0;     ///< what is allowed, from
  double most = 0;      ///< ... to
  std::string where{};  ///< the worst cell
  bool passed() const { return least <= measured && measured <= most; }
};

/// What the textbook's form for two balls should lose: `u k (d / R)^exponent / 2` of the radius, with k <= `most` whatever d / R.
struct LossTheory {
  double exponent = 2;
  double most = 16;   ///< [1] derived in docs/extremes.md
  double spread = 4;  ///< [1] the largest root mean square of k over the least, from decade to decade
};

std::vector<LadderTest> ladder_tests(const std::vector<ExtremeRow>& rows, const LossTheory& theory = {});

}  // namespace thinwall
