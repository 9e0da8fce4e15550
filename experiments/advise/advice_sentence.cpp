#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/advise/advice_text.hpp>
#include <thinwall/experiments/advise/words.hpp>

namespace thinwall {

namespace {

std::string seen(const AdviceRow& row) {
  const double latest = row.theory.largest_lateness().value_or(-1);
  if (latest < 0) return "how late it is seen has no formula";
  if (latest == 0) return "none is seen late";
  return fmt::format("none is seen more than {} m late", rounded_text(latest, 3));
}

/// The least, or as little as the measurement can tell.
std::string how_cheap(const Advice& advice) {
  const auto meeting = std::ranges::count_if(advice.rows, [](const AdviceRow& row) { return row.meets; });
  const double own = advice.advised()->cost.dearer().median;
  const bool tied = std::ranges::any_of(
      advice.rows, [&](const AdviceRow& row) { return row.meets && row.cost.dearer().median < own; });
  if (meeting == 1) return "no other method here meets the wish";
  return fmt::format("{} of the {} methods here that meet the wish", tied ? "as little as any" : "the least", meeting);
}

/// Seen is not saved: docs/tunneling_theory.md.
std::string pushed_through(const Advice& advice) {
  const std::optional<double>& through = advice.advised()->theory.through;
  if (!through || *through <= advice.wish.miss + no_chance) return "";
  return fmt::format(" If a ball in the wall is pushed out the shorter way, {} go through, seen or not.",
                     percent_text(*through));
}

/// What would become of the simplest method.
std::string simplest(const Advice& advice) {
  const auto end = std::ranges::find_if(advice.rows, [](const AdviceRow& row) { return row.method.poses == 1; });
  if (end == advice.rows.end() || end->meets) return "";
  if (!end->longest_step) return " Testing only the end of each step would not do at any step.";
  const double longest = *end->longest_step;
  if (longest > 0.5) {
    return fmt::format(" Testing only the end of each step would do at steps of {} s and less.",
                       rounded_down_text(longest, 4));
  }
  return fmt::format(" Testing only the end of each step would do from {} steps a second on.",
                     longest > 1e-12 ? grouped_text(std::llround(std::ceil(1 / longest))) : exact_text(1 / longest));
}

}  // namespace

std::string advice_sentence(const Advice& advice) {
  const AdviceRow* best = advice.advised();
  if (best == nullptr) return "No method here meets the wish at this step.";
  return fmt::format("Use {}: {}, {}, and a step takes {} ns, {}.{}{}", best->method.name,
                     tunnel_words(best->theory.probability.value_or(0)), seen(*best),
                     rounded_text(best->cost.dearer().median, 3), how_cheap(advice), pushed_through(advice),
                     simplest(advice));
}

}  // namespace thinwall
