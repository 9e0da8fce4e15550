#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/broad_phase/finder.hpp>
#include <thinwall/experiments/broad_phase/report.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

/// The quickest of those that are exact, or null.
const Finding* best_of(const Survey& survey) {
  const Finding* best = nullptr;
  for (const Finding& f : survey.findings) {
    if (f.is_exact && (best == nullptr || median(f.milliseconds) < median(best->milliseconds))) best = &f;
  }
  return best;
}

/// The quicker of Bullet's two, or null.
const Finding* bullet_of(const Survey& survey) {
  const Finding* build = finding_of(survey, std::string(bullet_build_name));
  const Finding* step = finding_of(survey, std::string(bullet_step_name));
  if (build == nullptr || step == nullptr) return build == nullptr ? step : build;
  return median(build->milliseconds) < median(step->milliseconds) ? build : step;
}

std::string milliseconds_text(double ms) { return rounded_text(ms, 3); }

std::string table_of(const std::vector<SurveyLine>& lines, const CrowdFactors& f) {
  std::vector<const SurveyLine*> some;
  std::vector<std::string> finders;
  for (const SurveyLine& line : lines) {
    if (line.factors.clustered != f.clustered || line.factors.speed != f.speed) continue;
    some.push_back(&line);
    for (const Finding& found : line.survey.findings) {
      if (std::find(finders.begin(), finders.end(), found.finder) == finders.end()) finders.push_back(found.finder);
    }
  }
  constexpr std::size_t most = 6;  // columns: the largest worlds
  std::sort(some.begin(), some.end(),
            [](const SurveyLine* a, const SurveyLine* b) { return a->factors.count < b->factors.count; });
  if (some.size() > most) some.erase(some.begin(), some.end() - most);
  std::string text = fmt::format("{}, {:g} m a step [ms]\n{:<18}", placement_name(f), f.speed, "balls");
  for (const SurveyLine* line : some) text += fmt::format("{:>11}", grouped_text(line->factors.count));
  text += fmt::format("{:>14}\n{:<18}", "exponent", "pairs");
  for (const SurveyLine* line : some) text += fmt::format("{:>11}", grouped_text(line->survey.pairs));
  text += "\n";
  const std::vector<Course> all = courses(lines);
  for (const std::string& finder : finders) {
    text += fmt::format("{:<18}", finder);
    for (const SurveyLine* line : some) {
      const Finding* found = finding_of(line->survey, finder);
      text += fmt::format("{:>11}", found == nullptr ? "-" : milliseconds_text(median(found->milliseconds)));
    }
    const auto course = std::find_if(all.begin(), all.end(), [&](const Course& c) {
      return c.finder == finder && c.factors.clustered == f.clustered && c.factors.speed == f.speed;
    });
    if (course != all.end() && course->growth) {
      text += fmt::format("{:>14}", fmt::format("{:.2f} +- {:.2f}", course->growth->exponent,
                                                course->growth->interval.upper - course->growth->exponent));
    }
    text += "\n";
  }
  return text;
}

/// The worlds of one kind, by their first line.
std::vector<CrowdFactors> kinds_of(const std::vector<SurveyLine>& lines) {
  std::vector<CrowdFactors> kinds;
  for (const SurveyLine& line : lines) {
    const auto same = [&](const CrowdFactors& f) {
      return f.clustered == line.factors.clustered && f.speed == line.factors.speed;
    };
    if (std::none_of(kinds.begin(), kinds.end(), same)) kinds.push_back(line.factors);
  }
  return kinds;
}

std::string self_test_text_of(const std::vector<SurveyLine>& lines) {
  std::int64_t worlds = 0, wrong = 0;
  std::string which;
  for (const SurveyLine& line : lines) {
    for (const Finding& f : line.survey.findings) {
      ++worlds;
      if (f.is_right()) continue;
      ++wrong;
      which += fmt::format(" {} misses {} and adds {} of {} pairs of {} {} balls.", f.finder, f.missing, f.extra,
                           line.survey.pairs, grouped_text(line.factors.count), placement_name(line.factors));
    }
  }
  return fmt::format("Self-test: every pair found, and no other by those that are exact, in {} of {} cases.{}",
                     worlds - wrong, worlds, which);
}

}  // namespace

std::string broad_phase_answer(const std::vector<SurveyLine>& lines) {
  const SurveyLine* largest = nullptr;  // the first of the largest worlds
  for (const SurveyLine& line : lines) {
    if (largest == nullptr || line.factors.count > largest->factors.count) largest = &line;
  }
  const Finding* best = largest == nullptr ? nullptr : best_of(largest->survey);
  if (best == nullptr) return "No exact broad phase took part.";
  std::string text =
      fmt::format("Of {} {} balls at {:g} m a step, {} finds all {} pairs in {} ms",
                  grouped_text(largest->factors.count), placement_name(largest->factors), largest->factors.speed,
                  best->finder, grouped_text(largest->survey.pairs), milliseconds_text(median(best->milliseconds)));
  if (const Finding* tree = finding_of(largest->survey, "r_tree"); tree != nullptr && tree != best)
    text += fmt::format(", the R-tree in {} ms", milliseconds_text(median(tree->milliseconds)));
  if (const Finding* bullet = bullet_of(largest->survey))
    text +=
        fmt::format(", Bullet's tree ({}) in {} ms", bullet->finder, milliseconds_text(median(bullet->milliseconds)));
  text += ".";
  if (const std::int64_t most = loop_is_best_up_to(lines); most > 0)
    text += fmt::format(" The half loop is the quickest up to {} balls.", grouped_text(most));
  return text;
}

std::string broad_phase_summary(const std::vector<SurveyLine>& lines) {
  std::string text;
  for (const CrowdFactors& kind : kinds_of(lines)) text += table_of(lines, kind) + "\n";
  return text +
         fmt::format("Exponents: of time against count, from {} balls on.\n",
                     grouped_text(static_cast<std::int64_t>(growth_from))) +
         self_test_text_of(lines) + "\n";
}

std::vector<Section> broad_phase_sections(const std::vector<SurveyLine>& lines) {
  std::string against;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const SurveyLine& line : lines) {
    const Finding *best = best_of(line.survey), *bullet = bullet_of(line.survey);
    if (best == nullptr || bullet == nullptr || static_cast<double>(line.factors.count) < growth_from) continue;
    const double ratio = median(bullet->milliseconds) / median(best->milliseconds);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  if (most > 0)
    against = fmt::format(
        "\n\nBullet's btDbvtBroadphase, set to look for pairs once all boxes have moved, is timed with its tree built anew and moved on by a "
        "step, its boxes in float and rounded outward. It keeps pairs in a cache, unsorted, and boxes with a margin: what it finds "
        "beyond the pairs is counted as extra and held against nobody. From {} balls on, the quicker of the two takes {:.1f} to {:.1f} "
        "times as long as the best of ours.",
        grouped_text(static_cast<std::int64_t>(growth_from)), least, most);
  return {
      {"What is asked",
       "Balls of 1 m diameter fly straight during a step, each in a direction of its own. Every broad phase is given the boxes that "
       "hold them during the step and finds all pairs of boxes that touch, sorted; a pair is false if the balls do not touch. The "
       "density is the same at every count, so that pairs grow as the count does." +
           against},
      {"How it is timed",
       "In rounds that take every broad phase in turn, on the boxes of one step and of the next, one world at a time. Time is the "
       "processor's for this thread, from boxes to sorted pairs; the program's own keep their memory from round to round as a "
       "simulation does, and nothing else."},
      {"Self-test",
       self_test_text_of(lines) +
           " What is right is what the first exact one of the world finds: the half loop where it takes part."},
      {"Limits",
       "One machine, one thread. Balls of one size: a mix of sizes costs the grid a look at every size for each ball. Bodies come in no "
       "order of place; a world that keeps neighbors together in memory is quicker for all."},
  };
}

}  // namespace thinwall
