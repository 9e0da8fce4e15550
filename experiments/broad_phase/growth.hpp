#pragma once
/// What the surveys say: how times grow with the count, where the half loop is overtaken, and whether all are right.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/broad_phase/model.hpp>
#include <thinwall/experiments/lab/race.hpp>

namespace thinwall {

struct GrowthPoint {
  double count;  ///< > 0
  double cost;   ///< > 0
};

/// The exponent p of cost = c * count^p, its interval from how far the points lie off the line; a bend widens it: the straight
/// line of least squares through the logarithms; nothing for fewer than three different counts.
/// Source: ordinary least squares, the interval from Student's t with two degrees of freedom less than points.
std::optional<Measured> fit_growth(std::span<const GrowthPoint> points);

/// A world and its survey.
struct SurveyRow {
  CrowdFactors crowd;
  Survey survey;
};

/// One broad phase on one world.
struct FindingRow {
  CrowdFactors crowd;
  Finding finding;
};
std::vector<FindingRow> findings_of(const std::vector<SurveyRow>& rows);

/// The finding of that name, or null.
const Finding* finding_of(const Survey& survey, std::string_view finder);

/// One broad phase over the counts of one kind of world.
struct Course {
  CrowdFactors crowd;  ///< `count` is not meant
  std::string finder;
  std::int64_t counts = 0;         ///< of `growth_from` and more
  std::optional<Measured> growth;  ///< exponent over those
};

inline constexpr std::int64_t growth_from = 10000;  ///< [bodies] below, fixed costs and caches rule

/// In the order of the rows.
std::vector<Course> courses(const std::vector<SurveyRow>& rows);

/// The largest count up to which the half loop is the quickest in all worlds; 0 if never or not run.
std::int64_t loop_is_best_up_to(const std::vector<SurveyRow>& rows);

/// No finder misses a pair, and none that claims to be exact finds another.
bool all_right(const std::vector<SurveyRow>& rows);

}  // namespace thinwall
