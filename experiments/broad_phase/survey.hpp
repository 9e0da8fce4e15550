#pragma once
/// One world, and what every broad phase makes of it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/broad_phase/crowd.hpp>

namespace thinwall {

/// One broad phase on one world.
struct Finding {
  std::string finder;
  bool is_exact = true;
  std::int64_t pairs = 0;              ///< found
  std::int64_t missing = 0;            ///< boxes that touch and were not found
  std::int64_t extra = 0;              ///< found, and the boxes do not touch
  std::optional<std::int64_t> bytes;   ///< [bytes] of working memory and pairs
  std::vector<double> milliseconds{};  ///< one of each round

  /// Nothing is missing, and what claims to be exact finds nothing else.
  bool is_right() const { return missing == 0 && (!is_exact || extra == 0); }
};

struct Survey {
  std::int64_t pairs = 0;     ///< whose boxes touch during the step
  std::int64_t meetings = 0;  ///< of those, balls that meet
  std::vector<Finding> findings;
};

struct SurveyOptions {
  std::vector<std::string> finders;
  std::int64_t loops_up_to = 0, sweep_up_to = 0;  ///< [1] bodies
  std::int64_t rounds = 3;                        ///< >= 1
  double seconds = 1;  ///< [s] for each finder; no round begins later, but for the first three
  std::uint64_t seed = 0;
};

/// Those of the options that are not too slow for so many bodies.
std::vector<std::string> finders_for(std::int64_t count, const SurveyOptions& options);

/// Times by the processor time of the thread, one survey at a time. Each round gives every finder the boxes of a step,
/// one step and the next in turn, so that trees that are moved on have something to move.
/// What is right is what the finders that are exact agree on: `missing` and `extra` are against the first of them.
Survey survey(const CrowdFactors& factors, const SurveyOptions& options);

/// As the line that a run's journal keeps, and back. Throws std::runtime_error if it is not one.
std::string to_line(const Survey& survey);
Survey survey_from_line(const std::string& line);

}  // namespace thinwall
