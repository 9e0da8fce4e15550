#pragma once
/// What the surveys say: medians, growth, and where one broad phase overtakes another.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/broad_phase/exponent.hpp>
#include <thinwall/experiments/broad_phase/survey.hpp>

namespace thinwall {

/// A world and its survey.
struct SurveyLine {
  CrowdFactors factors;
  Survey survey;
};

struct TimeEstimate {
  double median;      ///< [ms]
  Interval interval;  ///< 95 %, by bootstrap over the rounds
};
TimeEstimate time_of(const Finding& finding);

/// The finding of that name, or null.
const Finding* finding_of(const Survey& survey, const std::string& finder);

/// One broad phase over the counts of one kind of world.
struct Course {
  CrowdFactors factors;  ///< `count` is not meant
  std::string finder;
  std::vector<GrowthPoint> milliseconds;  ///< at every count, rising
  std::optional<Growth> growth;           ///< over counts of 10000 and more
};

inline constexpr double growth_from = 10000;  ///< [bodies] below, fixed costs and caches rule

/// In the order of the lines.
std::vector<Course> courses(const std::vector<SurveyLine>& lines);

/// The largest count up to which the half loop is the quickest in all worlds; 0 if never or not run.
std::int64_t loop_is_best_up_to(const std::vector<SurveyLine>& lines);

/// No finder misses a pair, and none that claims to be exact finds another.
bool all_right(const std::vector<SurveyLine>& lines);

}  // namespace thinwall
