#pragma once
/// The precision ladder: the axes along which one thing at a time is made extreme, the pairs of shapes and the precisions that are
/// asked there, what comes of it, and where a method breaks. The kernels are instantiated in kernels/ask.cpp alone.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

class Settings;

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

/// An axis from its usual value outward, to one side: along these a method survives, and then breaks.
struct Arm {
  ExtremeAxis axis;
  int side;  ///< +1 to greater values, -1 to lesser
  std::string_view name;
};
std::span<const Arm> all_arms();

/// The values of an arm among the places, from the usual outward.
std::vector<double> values_along(const Arm& arm, const std::vector<Place>& places);

/// A precision, its name in the settings and its round-off.
struct Precision {
  std::string_view name;
  double unit;           ///< [1] u
  bool is_wide = false;  ///< in software
};
inline constexpr std::size_t precision_count = 4;
const std::array<Precision, precision_count>& all_precisions();

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
        kept("method", &T::method), sum("queries", &T::queries, "1", "That the precision can hold."),
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

struct ExtremePair {
  std::string_view name;
  bool rounded;                                 ///< at least one shape has a radius
  bool has_box;                                 ///< that can be thin
  std::array<AskExtreme, precision_count> ask;  ///< null: not in that precision

  bool every_method() const { return ask.back() != nullptr; }  ///< or the closed form and the foil, in float and double
};
std::span<const ExtremePair> extreme_pairs();

/// Every method that is asked anywhere, the foil first.
std::vector<std::string_view> extreme_method_names();

/// A method at a place, on a pair, in a precision.
struct ExtremeRow {
  const ExtremePair* pair;
  std::size_t precision;  ///< index into all_precisions()
  Place place;
  ExtremeTally tally;
};

/// Some of the pairs. Boxes have no radius to give them a normal where they touch.
enum class PairSet {
  rounded,  ///< of the four that every method is asked, those with a ball
  boxes,    ///< of the same, the two boxes
  four,     ///< both
  all,      ///< those of the closed form and the foil alone, too
};

bool is_in(const ExtremePair& pair, PairSet pairs);

/// A method in a precision, on some of the pairs.
struct ExtremeContender {
  std::string_view method;
  std::size_t precision;  ///< index into all_precisions()
  PairSet pairs = PairSet::four;

  bool has(const ExtremeRow& row) const;  ///< and it was asked
};

std::vector<std::size_t> precisions_of(const std::vector<ExtremeRow>& rows);  ///< that occur
std::vector<Place> places_of(const std::vector<ExtremeRow>& rows);            ///< axis by axis, ascending

/// What was asked of two balls along the distance: there the textbook loses by theory.
std::vector<ExtremeRow> two_balls(const std::vector<ExtremeRow>& rows, std::string_view method, std::size_t precision);

/// Why a method is broken, the worst first.
enum class Flaw {
  verdict,  ///< a wrong verdict whose input would have to change by more than 4 u to make it right
  error,    ///< a time off by more than 100 u kappa t
  nan,      ///< no number, or a valid input called invalid
  gave_up,  ///< out of evaluations
};
std::string_view name(Flaw flaw);
inline constexpr double break_verdict = 4;  ///< [u]
inline constexpr double break_error = 100;  ///< [u kappa t] two decimals lost

std::optional<Flaw> flaw_of(const ExtremeTally& tally);

/// How far a method gets along an arm, on its pairs together.
struct Survival : ExtremeContender {
  const Arm* arm;
  std::optional<double>
      survived{};                  ///< the last value at which nothing was wrong, before the first where something was
  std::optional<double> broken{};  ///< that first value
  Flaw flaw = Flaw::verdict;       ///< the worst there
  std::string_view pair{};         ///< whose

  bool is_asked() const { return survived || broken; }
};
/// `arm` is one of `all_arms`.
Survival survival(const std::vector<ExtremeRow>& rows, const Arm& arm, const ExtremeContender& whose);

}  // namespace thinwall
