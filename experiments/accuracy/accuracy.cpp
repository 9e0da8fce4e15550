/// How far is the closed form off, and is its verdict ever wrong? See docs/accuracy.md.
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/accuracy/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Tally = AccuracyTally;

/// A pair, and how its queries were put.
struct Row {
  std::string_view pair;
  int place;  ///< of the pair in the table, from 1
  Inquiry inquiry;
  Tally tally{};
};

/// Verdicts that are asked alone have errors only where they were too close for the first oracle.
bool is_timed(const Row& row) { return row.inquiry != Inquiry::verdicts; }

/// The goal is the front door's; the float kernel is shown beside it.
bool is_within_goal(const Row& row) { return row.inquiry == Inquiry::float_kernel || is_within_goal(row.tally); }

std::string full_name(const Row& row) { return fmt::format("{} {}", row.pair, name(row.inquiry)); }

Table pairs_table(const std::vector<Row>& rows) {
  const auto columns = columns_of<Row>(
      text("pair", "The two shapes.", &Row::pair),
      text(
          "scalar",
          "float and double through the front door; the kernel in float; verdicts alone, paths along edges, and upright scenes, in double.",
          [](const Row& r) { return name(r.inquiry); }),
      fields(&Row::tally, {"queries", "hits", "overlapping"}),
      where(is_timed,
            columns_of<Row>(value("max_forward", "u kappa t", "Largest error of the time of a hit.",
                                  [](const Row& r) { return r.tally.forward.largest(); }),
                            value("p99_forward", "u kappa t", "99th percentile of the same.",
                                  [](const Row& r) { return r.tally.forward.quantile(0.99); }),
                            value("max_backward", "u", "Largest separation at the answered time, over its scale.",
                                  [](const Row& r) { return r.tally.backward.largest(); }),
                            fields(&Row::tally, {"worst_normal", "worst_point"}))),
      fields(&Row::tally, {"wrong_verdicts", "worst_wrong", "gave_up"}));
  return in_report(table("pairs", "Errors of the closed form against the oracle, by pair and scalar.", columns, rows));
}

/// Pair by pair in the table's order, under the goal.
template <class Error> Panel error_panel(const std::vector<Row>& rows, std::string label, double goal, Error error) {
  const auto drawn = [&](const Row& r) {
    const double y = error(r);
    return y > 1e-3 ? std::optional(y) : std::nullopt;  // less is an exact touch
  };
  const auto columns =
      columns_of<Row>(text("scalar", "", [](const Row& r) { return name(r.inquiry); }),
                      value("place", "", "", [](const Row& r) { return r.place; }), value("error", "", "", drawn));
  Panel panel =
      plot(rows, columns).x("place", Axis::linear, "pair").y("error", Axis::log, std::move(label)).by("scalar");
  for (const auto& group : group_by(rows, &Row::place))
    panel.x_tics.push_back({static_cast<double>(group[0]->place), std::string(group[0]->pair)});
  panel.series.push_back({"goal", Mark::dashes, {0.5, rows.back().place + 0.5}, {goal, goal}, {}, {}});
  return panel;
}

Figure errors_figure(const std::vector<Row>& rows) {
  const auto timed = [](const ErrorHistogram Tally::*errors) {
    return [errors](const Row& r) { return is_timed(r) ? (r.tally.*errors).largest() : 0; };
  };
  return {.name = "errors",
          .title = "The largest errors of the closed form",
          .caption =
              "Each point is the largest over all queries of a pair. The goal is the front door's; the kernel in "
              "float is what it would be without the promotion to double. A verdict without a point was never wrong.",
          .panels = {error_panel(rows, "forward [u kappa t]", accuracy_goal, timed(&Tally::forward)),
                     error_panel(rows, "backward [u]", accuracy_goal, timed(&Tally::backward)),
                     error_panel(rows, "wrong verdict [u]", accuracy_goal_wrong,
                                 [](const Row& r) { return r.tally.largest_wrong; })}};
}

std::string answer_of(const std::vector<Row>& rows) {
  Tally all;
  std::int64_t over = 0;
  for (const Row& row : rows) {
    if (row.inquiry == Inquiry::float_kernel) continue;
    all += row.tally;
    over += is_within_goal(row) ? 0 : 1;
  }
  return fmt::format(
      "Over {} queries through the front door the closed form's time is off by at most {:.2f} u kappa t, its backward error "
      "at most {:.2f} u; {} verdicts at the threshold fall on its other side, where their input would have to change by at "
      "most {:.2g} u; its normals part what touches, and its points lie on it, to {:.2g} and {:.2g} u of all sizes. {}",
      grouped_text(all.queries), all.forward.largest(), all.backward.largest(), grouped_text(all.wrong_verdicts),
      all.largest_wrong, all.worst_normal, all.worst_point,
      over == 0 ? "Every pair meets the goal." : fmt::format("{} rows of the table are over the goal.", over));
}

Outcome outcome_of(const std::vector<Row>& rows) {
  std::vector<std::string> over;
  for (const Row& row : rows) {
    if (!is_within_goal(row)) over.push_back(full_name(row));
  }
  const std::string verdict = fmt::format(
      "Goal: forward, backward, normal and point {}, worst wrong verdict {}. {}{}.", accuracy_goal, accuracy_goal_wrong,
      over.empty() ? "Every row through the front door meets it" : "Over it: ", fmt::join(over, ", "));
  const Table pairs = pairs_table(rows);
  return {.answer = answer_of(rows),
          .summary = terminal(pairs, {"pair", "scalar", "queries", "max_forward", "p99_forward", "max_backward",
                                      "worst_normal", "worst_point", "wrong_verdicts", "worst_wrong"}) +
                     wrapped(verdict),
          .tables = {pairs},
          .figures = {errors_figure(rows)},
          .sections = {{"Self-test", verdict}},
          .self_test_passed = over.empty()};
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::vector<AccuracyPair> pairs = chosen(settings, "pair", accuracy_pairs);
  const std::int64_t queries = settings.trials("queries", 1, 1'000'000'000, options.trials);
  const std::int64_t verdicts = settings.trials("verdict_queries", 0, 1'000'000'000, options.trials);
  std::vector<Row> rows;
  std::vector<Task<Tally>> tasks;
  std::vector<std::size_t> row_of_task;
  int place = 0;
  for (const AccuracyPair& pair : pairs) {
    ++place;
    for (const Inquiry inquiry : all_inquiries) {
      const std::int64_t all = inquiry == Inquiry::verdicts ? verdicts : queries;
      const std::int64_t block = std::max<std::int64_t>(1000, (all + 999) / 1000);  // at most a thousand units a row
      rows.push_back({pair.name, place, inquiry});
      for (std::int64_t first = 0; first < all; first += block) {
        const std::int64_t count = std::min(block, all - first);
        row_of_task.push_back(rows.size() - 1);
        tasks.push_back({fmt::format("{} {}", full_name(rows.back()), first), count,
                         [=, ask = pair.ask, seed = options.seed] { return ask(inquiry, seed, first, count); }});
      }
    }
  }
  const auto finish = [rows, row_of_task](const Done<Tally>& done) {
    std::vector<Row> all = rows;
    for (std::size_t i = 0; i < done.results.size(); ++i) all[row_of_task[i]].tally += done.results[i];
    return outcome_of(all);
  };
  return make_run(finish, std::move(tasks));
}

}  // namespace

Experiment accuracy_experiment() {
  return {"accuracy", "How far is the closed form off, and is its verdict ever wrong?", embedded_toml("accuracy"),
          configure};
}

}  // namespace thinwall
