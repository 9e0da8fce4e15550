#pragma once
/// One line of the results: a method at a place, on a pair, in a precision; and what is read off many of them.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/extremes/pairs.hpp>

namespace thinwall {

struct ExtremeLine {
  const ExtremePair* pair;
  std::size_t precision;  ///< index into all_precisions()
  Place place;
  ExtremeTally tally;
};

/// The share of the path until contact for which the contact lasts, at least: below some u of the precision no time can say
/// that there is one.
double contact_share(const Place& place);

/// How far the path is from the last that touches, over R: below some u rounding decides, and time is not linear in it.
double grazing_share(const Place& place);

/// Some of the pairs. Boxes have no radius to give them a normal where they touch.
enum class PairSet {
  rounded,  ///< of the four that every method is asked, those with a ball
  boxes,    ///< of the same, the two boxes
  four,     ///< both
  all,      ///< the closed form's, too
};

/// Whom and where: an empty name or a missing place is any.
struct LineFilter {
  std::string_view method{};
  std::size_t precision = 0;
  const Place* place = nullptr;
  PairSet pairs = PairSet::four;
};
bool matches(const ExtremeLine& line, const LineFilter& filter);

/// All lines of a method, precision and place as one: counts added, the largest errors.
struct CellSum {
  std::int64_t queries = 0, touching = 0, changed = 0, far_wrong = 0, gave_up = 0, invalid = 0, timed = 0;
  double forward_max = 0, backward_max = 0, worst_wrong = 0;
};
CellSum sum_of(const std::vector<ExtremeLine>& lines, const LineFilter& filter);

/// The precisions and methods that occur, in the order of their lists.
std::vector<std::size_t> precisions_of(const std::vector<ExtremeLine>& lines);
std::vector<std::string_view> methods_of(const std::vector<ExtremeLine>& lines, std::size_t precision,
                                         PairSet pairs = PairSet::four);
std::vector<Place> places_of(const std::vector<ExtremeLine>& lines);  ///< axis by axis, ascending

/// [ns] a query: the median over pairs and places. 0: not asked.
double nanoseconds_of(const std::vector<ExtremeLine>& lines, std::string_view method, std::size_t precision,
                      PairSet pairs);

}  // namespace thinwall
