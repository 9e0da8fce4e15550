/// What does it cost to find the pairs of moving balls that may touch, against their number? See docs/broad_phase.md.
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/broad_phase/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

std::pair<std::string, double> kind_of(const SurveyRow& row) { return {row.crowd.placement, row.crowd.speed}; }

// What the tables show.

Table crowds_table(const std::vector<SurveyRow>& rows) {
  const auto columns =
      columns_of<SurveyRow>(crowd_factors.columns(&SurveyRow::crowd), fields(&SurveyRow::survey),
                            value("false_share", "1", "Share of the candidates that do not; missing without any.",
                                  [](const SurveyRow& row) {
                                    const auto true_share = share_of(row.survey.meetings, row.survey.pairs);
                                    return true_share ? std::optional(1 - *true_share) : std::nullopt;
                                  }))
          .without({"density"});
  return in_report(table("crowds",
                         "The pairs of each world, on which every exact broad phase agrees, and how many of them meet.",
                         columns, rows));
}

double count_of(const FindingRow& row) { return static_cast<double>(row.crowd.count); }

std::optional<double> bytes_of(const FindingRow& row) {
  return row.finding.bytes ? std::optional(static_cast<double>(*row.finding.bytes)) : std::nullopt;
}

Table timings_table(const std::vector<SurveyRow>& rows) {
  const auto columns =
      columns_of<FindingRow>(
          crowd_factors.columns(&FindingRow::crowd), fields(&FindingRow::finding, {"broad_phase"}),
          measured("milliseconds", "ms", "From boxes to all pairs; median over the rounds.",
                   [](const FindingRow& row) { return median_of_rounds(row.finding.milliseconds); }),
          value("rounds", "1", "Rounds timed.", [](const FindingRow& row) { return row.finding.milliseconds.size(); }),
          value("nanoseconds_a_ball", "ns", "The median over the count.",
                [](const FindingRow& row) { return 1e6 * median(row.finding.milliseconds) / count_of(row); }),
          value("bytes_a_ball", "byte", "Working memory and pairs; missing where not known.",
                [](const FindingRow& row) -> std::optional<double> {
                  const std::optional<double> bytes = bytes_of(row);
                  return bytes ? std::optional(*bytes / count_of(row)) : std::nullopt;
                }),
          fields(&FindingRow::finding, {"found", "missing", "extra"}))
          .without({"density"});
  return timing(table("timings",
                      "Time to find all pairs of a world, median over interleaved rounds with its 95 % bootstrap "
                      "interval, and memory.",
                      columns, findings_of(rows)));
}

Table growth_table(const std::vector<SurveyRow>& rows) {
  std::vector<Course> fitted = courses(rows);
  std::erase_if(fitted, [](const Course& course) { return !course.growth; });
  const auto columns = columns_of<Course>(crowd_factors.columns(&Course::crowd),
                                          text("broad_phase", "Who finds the pairs.", &Course::finder),
                                          value("counts", "1", "Counts of 10000 and more.", &Course::counts),
                                          measured("exponent", "1", "p.", &Course::growth))
                           .without({"count", "density"});
  Table growth = timing(table("growth",
                              "The exponent p of time = c * count^p over counts of 10000 and more, by least squares "
                              "on logarithms, with its 95 % interval.",
                              columns, fitted));
  growth.in_report = !fitted.empty();  // fewer than three such counts say nothing
  return growth;
}

/// For the terminal: the times of one kind of world, by broad phase and count, of the largest worlds.
Table times_by_count(const Group<SurveyRow>& kind, const std::vector<Course>& all) {
  constexpr std::size_t most = 6;  // columns
  Group<SurveyRow> worlds = kind;
  std::ranges::sort(worlds, {}, [](const SurveyRow* row) { return row->crowd.count; });
  if (worlds.size() > most) worlds.erase(worlds.begin(), worlds.end() - most);
  const CrowdFactors& crowd = kind[0]->crowd;
  const auto is_of_kind = [&](const Course& course) {
    return course.crowd.placement == crowd.placement && course.crowd.speed == crowd.speed &&
           std::ranges::any_of(worlds, [&](const SurveyRow* row) { return finding_of(row->survey, course.finder); });
  };
  std::vector<Course> shown;
  std::ranges::copy_if(all, std::back_inserter(shown), is_of_kind);
  auto columns = columns_of<Course>(text("broad_phase", "", &Course::finder));
  for (const SurveyRow* row : worlds) {
    const auto time = [row](const Course& course) -> std::optional<double> {
      const Finding* found = finding_of(row->survey, course.finder);
      return found == nullptr ? std::nullopt : std::optional(median(found->milliseconds));
    };
    value(grouped_text(row->crowd.count), "", "", time).add_to(columns);
  }
  measured("exponent", "", "", &Course::growth).add_to(columns);
  return table("times",
               fmt::format("Milliseconds by the number of balls, {}, {:g} m a step.", crowd.placement, crowd.speed),
               columns, shown);
}

// What the pictures show: a panel for each kind of world, a series for each broad phase.

std::vector<Panel> panels_by_kind(const std::vector<SurveyRow>& rows, const std::string& quantity,
                                  const std::function<std::optional<Measured>(const FindingRow&)>& get) {
  std::vector<Panel> panels;
  for (const Group<SurveyRow>& kind : group_by(rows, kind_of)) {
    std::vector<SurveyRow> rising;
    for (const SurveyRow* row : kind) rising.push_back(*row);
    std::ranges::stable_sort(rising, {}, [](const SurveyRow& row) { return row.crowd.count; });
    const auto [placement, speed] = kind_of(*kind[0]);
    panels.push_back(joined(plot(findings_of(rising), crowd_factors.columns(&FindingRow::crowd),
                                 fields(&FindingRow::finding, {"broad_phase"}), measured("y", "", "", get))
                                .x("count", Axis::log, "balls")
                                .y("y", Axis::log, fmt::format("{}; {}, {:g} m a step", quantity, placement, speed))
                                .by("broad_phase")));
  }
  std::erase_if(panels, [](const Panel& panel) { return panel.series.empty(); });
  return panels;
}

std::vector<Figure> figures_of(const std::vector<SurveyRow>& rows) {
  const auto time_a_ball = [](const FindingRow& row) {
    return median_of_rounds(row.finding.milliseconds).times(1e6 / count_of(row));
  };
  const auto megabytes = [](const FindingRow& row) -> std::optional<Measured> {
    const double bytes = bytes_of(row).value_or(0);
    return bytes > 0 ? std::optional(Measured{1e-6 * bytes, {1e-6 * bytes, 1e-6 * bytes}}) : std::nullopt;
  };
  std::vector<Figure> figures = {
      {.name = "times",
       .title = "Time to find all pairs",
       .caption =
           "Nanoseconds a ball against the number of balls at constant density: level is linear growth. Medians over "
           "interleaved rounds, with their 95 % bootstrap intervals, which many marks hide.",
       .panels = panels_by_kind(rows, "ns a ball", time_a_ball),
       .is_timing = true},
      {.name = "memory",
       .title = "Memory of finding all pairs",
       .caption = "Working memory and pairs, beside the boxes themselves. Both loops keep nothing but the pairs: their "
                  "lines are one. Bullet's cannot be told.",
       .panels = panels_by_kind(rows, "MB", megabytes),
       .is_timing = true}};
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

// What it says.

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
  const Finding *build = finding_of(survey, bullet_build_name), *step = finding_of(survey, bullet_step_name);
  if (build == nullptr || step == nullptr) return build == nullptr ? step : build;
  return median(build->milliseconds) < median(step->milliseconds) ? build : step;
}

/// Bullet's times over those of the best of ours, from `growth_from` balls on.
std::string bullet_text(const std::vector<SurveyRow>& rows) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const SurveyRow& row : rows) {
    const Finding *best = best_of(row.survey), *bullet = bullet_of(row.survey);
    if (best == nullptr || bullet == nullptr || row.crowd.count < growth_from) continue;
    const double ratio = median(bullet->milliseconds) / median(best->milliseconds);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  if (most == 0) return "";
  return fmt::format(
      " From {} balls on, the quicker of Bullet's two takes {:.1f} to {:.1f} times as long as the best of ours.",
      grouped_text(growth_from), least, most);
}

std::string answer_of(const std::vector<SurveyRow>& rows) {
  const SurveyRow& largest = *std::ranges::max_element(rows, {}, [](const SurveyRow& row) { return row.crowd.count; });
  const Finding* best = best_of(largest.survey);
  if (best == nullptr) return "No exact broad phase took part.";
  const auto time = [](const Finding& f) { return rounded_text(median(f.milliseconds), 3); };
  std::string text = fmt::format("Of {} {} balls at {:g} m a step, {} finds all {} pairs in {} ms",
                                 grouped_text(largest.crowd.count), largest.crowd.placement, largest.crowd.speed,
                                 best->finder, grouped_text(largest.survey.pairs), time(*best));
  if (const Finding* tree = finding_of(largest.survey, "r_tree"); tree != nullptr && tree != best)
    text += fmt::format(", the R-tree in {} ms", time(*tree));
  if (const Finding* bullet = bullet_of(largest.survey))
    text += fmt::format(", Bullet's tree ({}) in {} ms", bullet->finder, time(*bullet));
  text += ".";
  if (const std::int64_t most = loop_is_best_up_to(rows); most > 0)
    text += fmt::format(" The half loop is the quickest up to {} balls.", grouped_text(most));
  return text + bullet_text(rows);
}

std::string self_test_words(const std::vector<SurveyRow>& rows) {
  std::int64_t cases = 0, wrong = 0;
  std::string which;
  for (const SurveyRow& row : rows) {
    for (const Finding& f : row.survey.findings) {
      ++cases;
      if (f.is_right()) continue;
      ++wrong;
      which += fmt::format(" {} misses {} and adds {} of {} pairs of {} {} balls.", f.finder, f.missing, f.extra,
                           row.survey.pairs, grouped_text(row.crowd.count), row.crowd.placement);
    }
  }
  return fmt::format("Every pair found, and no other by those that are exact, in {} of {} cases.{}\n", cases - wrong,
                     cases, which);
}

std::string summary_of(const std::vector<SurveyRow>& rows) {
  const std::vector<Course> all = courses(rows);
  std::string text;
  for (const Group<SurveyRow>& kind : group_by(rows, kind_of)) text += terminal(times_by_count(kind, all)) + "\n";
  return text + fmt::format("Exponents: of time against count, from {} balls on.\n", grouped_text(growth_from)) +
         wrapped("Self-test: " + self_test_words(rows));
}

Outcome outcome_of(const std::vector<SurveyRow>& rows) {
  return {.answer = answer_of(rows),
          .summary = summary_of(rows),
          .tables = {growth_table(rows), crowds_table(rows), timings_table(rows)},
          .figures = figures_of(rows),
          .sections = {{"Self-test", self_test_words(rows)}},
          .self_test_passed = all_right(rows)};
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const SurveyOptions how = {.finders = settings.choices_or_all("broad_phase", finder_names()),
                             .loops_up_to = settings.integer("loops_up_to", 0, 10'000'000),
                             .sweep_up_to = settings.integer("sweep_up_to", 0, 10'000'000),
                             .rounds = settings.trials("rounds", 1, 1 << 20, options.trials),
                             .seconds = settings.number("seconds", {.lower = 0, .upper = 1000, .unit = "s"}),
                             .seed = options.seed};
  std::vector<SurveyRow> rows;
  std::vector<Task<Survey>> tasks;
  for (const CrowdFactors& crowd : crowd_factors.cells(settings)) {
    if (finders_for(crowd.count, how).empty())
      settings.complain("broad_phase", fmt::format("at least one that is not left out of {} balls", crowd.count));
    rows.push_back({crowd, {}});
    tasks.push_back({crowd_factors.key(crowd), crowd.count, [crowd, how] { return survey(crowd, how); }});
  }
  const auto finish = [rows](const Done<Survey>& done) {
    std::vector<SurveyRow> all = rows;
    for (std::size_t i = 0; i < all.size(); ++i) all[i].survey = done.results[i];
    return outcome_of(all);
  };
  const std::vector<std::string> notes = {fmt::format(
      "trials are balls; each broad phase is timed in up to {} (--trials)", plural_text(how.rounds, "round"))};
  return make_run(finish, notes, std::move(tasks));
}

}  // namespace

Experiment broad_phase_experiment() {
  return {"broad_phase", "What does it cost to find the pairs of moving balls that may touch, against their number?",
          embedded_toml("broad_phase"), configure};
}

}  // namespace thinwall
