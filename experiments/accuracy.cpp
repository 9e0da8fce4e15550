#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/accuracy/pairs.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/numbers.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// Queries a unit: so many that a row has at most a thousand.
std::int64_t block_size(std::int64_t queries) { return std::max<std::int64_t>(1000, (queries + 999) / 1000); }

/// One row of the result: a pair, and how its queries were put.
struct Row {
  const AccuracyPair* pair;
  Inquiry inquiry;
  AccuracyTally tally{};
};

class AccuracyRun final : public Run {
 public:
  AccuracyRun(const std::vector<const AccuracyPair*>& pairs, std::int64_t queries, std::int64_t verdicts,
              std::uint64_t seed)
      : seed_(seed) {
    for (const AccuracyPair* pair : pairs) {
      for (const Inquiry inquiry : all_inquiries) {
        rows_.push_back({pair, inquiry});
        counts_.push_back(inquiry == Inquiry::verdicts ? verdicts : queries);
      }
    }
  }

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::int64_t first = 0; first < counts_[i]; first += block_size(counts_[i])) {
        const std::int64_t count = std::min(block_size(counts_[i]), counts_[i] - first);
        units.push_back(
            {fmt::format("{} {} {}", rows_[i].pair->name, name(rows_[i].inquiry), first), count,
             [this, i, first, count] { return rows_[i].pair->ask(rows_[i].inquiry, seed_, first, count).to_line(); }});
      }
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    std::vector<Row> rows = rows_;
    std::size_t next = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::int64_t first = 0; first < counts_[i]; first += block_size(counts_[i])) {
        rows[i].tally.add(AccuracyTally::from_line(results[next++]));
      }
    }
    Outcome outcome;
    outcome.self_test_passed = std::all_of(rows.begin(), rows.end(), within_goal);
    outcome.summary = summary(rows);
    outcome.answer = answer(rows);
    outcome.tables = {pairs_table(rows)};
    outcome.figures = {errors_figure(rows)};
    outcome.sections = {
        {"Method",
         "Every pair of shapes is asked for its time of impact over decades of distance, size ratio, aspect, speed, offset from "
         "the origin and angle down to grazing. The oracle finds the nearest point of the Minkowski difference from its support "
         "function alone (Wolfe's method) and the first contact by Newton's method from before it, at 50 digits; it shares no "
         "code with the closed forms.\n\nForward error is in units of u kappa t, backward error in u, where u is the unit "
         "round-off of the scalar. A wrong verdict counts by the change of its input, in u, that would make it right."},
        {"Goal",
         "Forward and backward at most 4, no wrong verdict by more than 1 u; float and double through the front door. The "
         "kernel in float is shown beside them: the front door computes a float query in double."},
        {"Limits",
         "Queries are drawn at random: the largest error that was seen bounds the largest there is from below only. Lengths "
         "whose squares overflow or underflow are not drawn; tests of the shapes look at those."}};
    return outcome;
  }

 private:
  /// The goal is the front door's; the float kernel is shown beside it.
  static bool within_goal(const Row& row) {
    if (row.inquiry == Inquiry::float_kernel) return true;
    return row.tally.forward.largest() <= 4 && row.tally.backward.largest() <= 4 && row.tally.largest_wrong <= 1 &&
           row.tally.gave_up == 0;
  }

  static std::string summary(const std::vector<Row>& rows) {
    std::string text = fmt::format("{:<18} {:<13} {:>9} {:>9} {:>8} {:>8} {:>9} {:>6} {:>9}\n", "pair", "scalar",
                                   "queries", "hits", "forward", "p99", "backward", "wrong", "worst [u]");
    for (const Row& row : rows) {
      const AccuracyTally& t = row.tally;
      const bool timed = row.inquiry != Inquiry::verdicts;
      text +=
          fmt::format("{:<18} {:<13} {:>9} {:>9} {:>8} {:>8} {:>9} {:>6} {:>9.2g}{}\n", row.pair->name,
                      name(row.inquiry), t.queries, t.hits, timed ? fmt::format("{:.2f}", t.forward.largest()) : "-",
                      timed ? fmt::format("{:.2f}", t.forward.quantile(0.99)) : "-",
                      timed ? fmt::format("{:.2f}", t.backward.largest()) : "-", t.wrong_verdicts, t.largest_wrong,
                      within_goal(row) ? "" : "  over the goal");
    }
    return text + "Forward in u kappa t, backward and worst wrong verdict in u. Goal: 4, 4 and 1.\n";
  }

  static std::string answer(const std::vector<Row>& rows) {
    AccuracyTally all;
    std::int64_t over = 0;
    for (const Row& row : rows) {
      if (row.inquiry == Inquiry::float_kernel) continue;
      all.add(row.tally);
      over += within_goal(row) ? 0 : 1;
    }
    return fmt::format(
        "Over {} queries through the front door the closed form's time is off by at most {:.2f} u kappa t, its backward error "
        "at most {:.2f} u; {} verdicts at the threshold fall on its other side, where their input would have to change by at "
        "most {:.2g} u. {}",
        grouped_text(all.queries), all.forward.largest(), all.backward.largest(), grouped_text(all.wrong_verdicts),
        all.largest_wrong,
        over == 0 ? "Every pair meets the goal." : fmt::format("{} rows of the table are over the goal.", over));
  }

  /// Largest errors, pair by pair in the table's order, under the goal.
  static Figure errors_figure(const std::vector<Row>& rows) {
    const auto panel = [&](std::string label, double goal, auto error) {
      Panel result{"pair, in the order of the table", std::move(label), false, true, 1, {}};
      double pairs = 0;
      for (const Inquiry inquiry : all_inquiries) {
        Series series{std::string(name(inquiry)), Mark::points, {}, {}, {}, {}};
        double x = 0;
        for (const Row& row : rows) {
          if (row.inquiry != inquiry) continue;
          const double y = inquiry == Inquiry::verdicts && goal > 1 ? 0 : error(row.tally);
          series.x.push_back(++x);
          series.y.push_back(y > 1e-3 ? y : std::numeric_limits<double>::quiet_NaN());  // less is an exact touch
        }
        pairs = x;
        result.series.push_back(series);
      }
      result.series.push_back({"goal", Mark::dashes, {0.5, pairs + 0.5}, {goal, goal}, {}, {}});
      return result;
    };
    return {
        "errors",
        "The largest errors of the closed form",
        "Each point is the largest over all queries of a pair. The goal is the front door's; the kernel in float is "
        "what it would be without the promotion to double. A verdict without a point was never wrong.",
        {panel("forward [u kappa t]", 4, [](const AccuracyTally& t) { return t.forward.largest(); }),
         panel("backward [u]", 4, [](const AccuracyTally& t) { return t.backward.largest(); }),
         panel("wrong verdict [u]", 1, [](const AccuracyTally& t) { return t.largest_wrong; })}};
  }

  static Table pairs_table(const std::vector<Row>& rows) {
    Table table{
        "pairs",
        "Errors of the closed form against the oracle, by pair and scalar.",
        {{"pair", ColumnType::text, "", "The two shapes"},
         {"scalar", ColumnType::text, "",
          "float and double through the front door; the kernel in float; verdicts alone, in double"},
         {"queries", ColumnType::integer, "1", "How many"},
         {"hits", ColumnType::integer, "1", "How many touch during the step, by the oracle"},
         {"overlapping", ColumnType::integer, "1", "How many touch at the start, by the oracle"},
         {"max_forward", ColumnType::number, "u kappa t", "Largest error of the time of a hit"},
         {"p99_forward", ColumnType::number, "u kappa t", "99th percentile of the same"},
         {"max_backward", ColumnType::number, "u", "Largest separation at the answered time, over its scale"},
         {"wrong_verdicts", ColumnType::integer, "1", "Verdicts that differ from the oracle's"},
         {"worst_wrong", ColumnType::number, "u", "The largest change of the input that a wrong verdict would need"},
         {"gave_up", ColumnType::integer, "1", "Queries that ran out of rounds"}},
        {}};
    table.in_report = true;
    for (const Row& row : rows) {
      const AccuracyTally& t = row.tally;
      const auto timed = [&](double x) { return row.inquiry == Inquiry::verdicts ? Value{} : Value{x}; };
      table.rows.push_back({std::string(row.pair->name), std::string(name(row.inquiry)), t.queries, t.hits,
                            t.overlapping, timed(t.forward.largest()), timed(t.forward.quantile(0.99)),
                            timed(t.backward.largest()), t.wrong_verdicts, t.largest_wrong, t.gave_up});
    }
    return table;
  }

  std::vector<Row> rows_{};
  std::vector<std::int64_t> counts_{};
  std::uint64_t seed_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  std::vector<std::string_view> allowed;
  for (const AccuracyPair& pair : accuracy_pairs()) allowed.push_back(pair.name);
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices("pair", allowed);
  const bool all = std::find(chosen.begin(), chosen.end(), "all") != chosen.end();
  std::vector<const AccuracyPair*> pairs;
  for (const AccuracyPair& pair : accuracy_pairs()) {
    if (all || std::find(chosen.begin(), chosen.end(), pair.name) != chosen.end()) pairs.push_back(&pair);
  }
  const std::int64_t queries = settings.trials("queries", 1, 1'000'000'000, options.trials);
  const std::int64_t verdicts = settings.trials("verdict_queries", 0, 1'000'000'000, options.trials);
  return std::make_unique<AccuracyRun>(pairs, queries, verdicts, options.seed);
}

}  // namespace

Experiment accuracy_experiment() {
  return {"accuracy", "How far is the closed form off, and is its verdict ever wrong?", embedded_toml("accuracy"),
          &configure};
}

}  // namespace thinwall
