/// What error does each way to find a time of impact make, and what time does it take? See docs/work_precision.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/work_precision/model.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/turning/turning_methods.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// A racer of a heat.
struct Row {
  const Heat* heat;
  const Racer* racer;
  Measured time;  ///< [ns] a query
  bool is_on_front, stands_for_method;
  std::optional<double> false_share;
  std::optional<Measured> slowdown;  ///< against the closed form, if that takes part
};
const Racer& racer_of(const Row& row) { return *row.racer; }

/// Of what moves straight, in the order of that list, then those for what turns alone.
std::vector<std::string_view> all_methods() {
  std::vector<std::string_view> names;
  const auto add = [&]<class Method>(TypeTag<Method>) {
    if (std::ranges::find(names, Method::name) == names.end()) names.push_back(Method::name);
  };
  for_each_type(Methods<double>{}, add);
  for_each_type(TurningMethods<double>{}, add);
  return names;
}

/// Every racer of every heat.
std::vector<Row> rows_of(const std::vector<Heat>& heats) {
  const auto is_in = [](const std::vector<const Racer*>& racers, const Racer& racer) {
    return std::ranges::find(racers, &racer) != racers.end();
  };
  std::vector<Row> rows;
  for (const Heat& heat : heats) {
    const std::vector<const Racer*> front = pareto_front(heat), chosen = one_a_method(heat);
    const Racer* exact = closed_form_of(heat);
    for (const Racer& r : heat.racers) {
      rows.push_back({&heat, &r, nanoseconds(r), is_in(front, r), is_in(chosen, r), false_share(heats, heat, r),
                      exact != nullptr ? std::optional(slowdown(r, *exact)) : std::nullopt});
    }
  }
  return rows;
}

// What the tables show.

/// An error: missing where nothing touches, or where so many are missed that it is infinite.
auto error(std::string name, std::string unit, std::string description, ErrorSpread Racer::*errors,
           double ErrorSpread::*part) {
  return value(std::move(name), std::move(unit), std::move(description), [=](const Row& r) -> std::optional<double> {
    const double x = r.racer->*errors.*part;
    return r.racer->touching > 0 && std::isfinite(x) ? std::optional(x) : std::nullopt;
  });
}
auto median_error() {
  return error("error_median", "step", "Median error of the time of impact.", &Racer::time, &ErrorSpread::median);
}

Columns<Row> key_columns() {
  return columns_of<Row>(
      text("set", "The pair of shapes.", [](const Row& r) { return r.heat->set->name; }),
      text("class", "Hits, misses or grazes.", [](const Row& r) { return name(r.heat->kind); }),
      text("scalar", "Floating-point type of the shapes.", [](const Row& r) { return r.heat->scalar; }),
      fields(racer_of, {"method", "option"}));
}

Table errors_table(const std::vector<Row>& rows) {
  return table(
      "errors",
      "Verdicts and errors of the time of impact against the oracle at 50 digits, and evaluations, for every method "
      "and setting. A contact that is missed counts as an infinite error; a quantile that is infinite is left out.",
      rows, key_columns(), fields(racer_of, {"queries", "touching", "missed", "false_hits", "gave_up"}), median_error(),
      error("error_p99", "step", "99th percentile of the same.", &Racer::time, &ErrorSpread::p99),
      error("error_max", "step", "Largest of the same.", &Racer::time, &ErrorSpread::max),
      error("length_median", "m", "Median error along the relative path.", &Racer::length, &ErrorSpread::median),
      error("length_p99", "m", "99th percentile of the same.", &Racer::length, &ErrorSpread::p99),
      error("length_max", "m", "Largest of the same.", &Racer::length, &ErrorSpread::max),
      fields(racer_of, {"latest", "earliest", "evaluations", "most_evaluations"}));
}

Table times_table(const std::vector<Row>& rows) {
  return timing(table(
      "timings", "Time a query on this machine: the median over interleaved rounds, with its 95 % bootstrap interval.",
      rows, key_columns(), measured("nanoseconds", "ns", "A query; median over the rounds.", &Row::time),
      value("rounds", "1", "Rounds timed.", [](const Row& r) { return r.racer->nanoseconds.size(); }),
      value("on_front", "", "Nobody is both finer and faster.", &Row::is_on_front)));
}

/// Of every race on hits one racer a method: what fine answers cost, against the closed form.
Table trailing_table(std::vector<Row> rows) {
  std::erase_if(rows, [](const Row& row) { return row.heat->kind != QueryClass::hit || !row.stands_for_method; });
  return in_report(timing(
      table("trailing",
            "Each method at its roughest setting with a 99th percentile error of at most 1e-12 of a step (1e-6 in "
            "float), or else its finest; and how many times as long as the closed form it takes. Hits alone.",
            rows, key_columns(),
            value("missed", "1", "Contacts that it does not see.", [](const Row& r) { return r.racer->missed; }),
            value("false_share", "1", "Share of the misses, asked apart, that it calls a hit.", &Row::false_share),
            median_error(),
            error("error_p99", "step", "99th percentile of the same; missing: it misses more than 1 %.", &Racer::time,
                  &ErrorSpread::p99),
            value("evaluations", "1", "A query, on average.", [](const Row& r) { return r.racer->evaluations; }),
            value("nanoseconds", "ns", "A query; median over the rounds.", [](const Row& r) { return r.time.value; }),
            measured("times_closed_form", "1", "Its time over that of the closed form, round by round; median.",
                     &Row::slowdown))));
}

// What the pictures show.

constexpr double least_error = 0x1p-60;  // drawn in place of an error that is less, down to 0

double shown(double error) { return std::max(error, least_error); }

/// Points of one method, from rough to fine.
Series points_of(const Heat& heat, std::string_view method, bool by_time) {
  Series points = {.label = std::string(method)};
  for (const Racer& r : heat.racers) {
    if (r.method != method || !std::isfinite(r.time.median)) continue;
    const Measured cost = by_time ? nanoseconds(r) : Measured{r.evaluations, {r.evaluations, r.evaluations}};
    points.add(shown(r.time.median), cost.value);
    points.x_lower.push_back(shown(r.time.median));
    points.x_upper.push_back(shown(std::isfinite(r.time.p99) ? r.time.p99 : 1));
    points.lower.push_back(cost.interval.lower);
    points.upper.push_back(cost.interval.upper);
  }
  return points;
}

/// Corners at the 99th percentile errors of those nobody beats: below and left of it there is nobody.
Series front_line(const Heat& heat) {
  Series line = {.label = "Pareto front", .mark = Mark::dashes};
  for (const Racer* r : pareto_front(heat)) {
    const double x = shown(r->time.p99);
    if (!line.x.empty()) line.add(x, line.y.back());
    line.add(x, median(r->nanoseconds));
  }
  if (!line.x.empty()) line.add(1, line.y.back());
  return line;
}

/// What a picture is of.
struct Shown {
  QueryClass kind;
  std::string_view scalar;
  bool turns = false;
  bool by_time = true;  ///< else by evaluations
};

/// One panel for each set.
std::vector<Panel> panels_of(const std::vector<Heat>& heats, const Shown& what) {
  std::vector<Panel> panels;
  for (const Heat& heat : heats) {
    if (heat.kind != what.kind || heat.scalar != what.scalar || heat.set->turns != what.turns) continue;
    Panel panel = {.x_label = "error of the time of impact [step]: median, with a bar to the 99th percentile",
                   .y_label = fmt::format("{}, {}", heat.set->name, what.by_time ? "ns a query" : "evaluations"),
                   .log_x = true,
                   .log_y = true,
                   .height = 0.9};
    for (const std::string_view method : all_methods()) panel.series.push_back(points_of(heat, method, what.by_time));
    std::erase_if(panel.series, [](const Series& points) { return points.x.empty(); });
    if (panel.series.empty()) continue;
    panel = joined(std::move(panel));
    if (what.by_time) panel.series.insert(panel.series.begin(), front_line(heat));
    panels.push_back(std::move(panel));
  }
  return panels;
}

Figure figure(const std::vector<Heat>& heats, const Shown& shown) {
  const std::string what =
      std::string(shown.turns ? "turning " : "") + (shown.kind == QueryClass::hit ? "hits" : "grazes");
  std::string name = fmt::format("{}_{}_{}", what, shown.scalar, shown.by_time ? "time" : "evaluations");
  std::ranges::replace(name, ' ', '_');
  return {
      .name = name,
      .title =
          fmt::format("Error against {}: {} in {}", shown.by_time ? "run time" : "evaluations", what, shown.scalar),
      .caption = fmt::format(
          "Each method along its option, from rough (right) to fine (left). {}A method that misses half of the contacts has no point; "
          "a bar that ends at 1 stands for one that misses more than 1 %. Errors below 1e-18 are drawn there.",
          shown.by_time
              ? "Vertical bars, mostly hidden by their points: 95 % bootstrap intervals of the median time over interleaved "
                "rounds. The front joins the 99th percentile errors of those that nobody beats in both. "
              : "Evaluations are separations, overlap tests, rays or closed forms: a cost that no machine changes. "),
      .panels = panels_of(heats, shown),
      .is_timing = shown.by_time};
}

std::vector<Figure> figures_of(const std::vector<Heat>& heats) {
  using enum QueryClass;
  std::vector<Figure> figures;
  for (const Shown& shown :
       {Shown{hit, "double"}, Shown{graze, "double"}, Shown{hit, "float"},
        Shown{.kind = hit, .scalar = "double", .by_time = false}, Shown{.kind = hit, .scalar = "double", .turns = true},
        Shown{.kind = graze, .scalar = "double", .turns = true}}) {
    figures.push_back(figure(heats, shown));
  }
  std::erase_if(figures, [](const Figure& f) { return f.panels.empty(); });
  return figures;
}

// What it says.

std::string full_name(const Racer& r) { return r.setting.empty() ? r.method : r.method + " (" + r.setting + ")"; }

std::string between(const char* format, const Interval& i) {
  return fmt::format(fmt::runtime(format), i.lower) + " to " + fmt::format(fmt::runtime(format), i.upper);
}

std::string error_text(double error) { return std::isfinite(error) ? fmt::format("{:.1e}", error) : "-"; }

/// Who is the cheapest at which error.
std::string front_text(const Heat& heat) {
  const std::vector<const Racer*> front = pareto_front(heat);
  if (front.empty()) return "Every method misses some contact. ";
  std::string text = fmt::format("{} is the finest (99th percentile error {} of a step) and ", full_name(*front[0]),
                                 error_text(front[0]->time.p99));
  text += front.size() == 1 ? std::string("the cheapest at every error that a method reaches without a miss")
                            : std::string("the cheapest");
  const Measured time = nanoseconds(*front[0]);
  text += fmt::format(", at {:.0f} ns a query ({})", time.value, between("{:.0f}", time.interval));
  for (std::size_t i = 1; i < front.size(); ++i) {
    const Measured gain = slowdown(*front[i], *front[i - 1]);
    text +=
        fmt::format("; where {} is good enough the curves cross and {} is, in {:.2f} of that ({})",
                    error_text(front[i]->time.p99), full_name(*front[i]), gain.value, between("{:.2f}", gain.interval));
  }
  return text + ". ";
}

/// Who does not see every contact, each at its finest.
std::string missing_text(const Heat& heat) {
  std::vector<std::string> miss;
  for (const Racer* r : one_a_method(heat)) {
    if (!finishes(*r)) miss.push_back(fmt::format("{} ({} of {})", full_name(*r), r->missed + r->gave_up, r->touching));
  }
  return miss.empty() ? "" : fmt::format("Contacts are missed by {}. ", fmt::join(miss, ", "));
}

/// By how much the others trail the closed form.
std::string trailing_text(const Heat& heat) {
  const Racer* exact = closed_form_of(heat);
  if (exact == nullptr) return heat.set->turns ? missing_text(heat) : "";
  const double fine = fine_error(heat.scalar);
  std::vector<std::string> reach, coarse;
  for (const Racer* r : one_a_method(heat)) {
    if (r == exact || !finishes(*r)) continue;
    const Measured ratio = slowdown(*r, *exact);
    if (r->time.p99 <= fine) {
      reach.push_back(
          fmt::format("{} {:.1f} times as long ({})", full_name(*r), ratio.value, between("{:.1f}", ratio.interval)));
    } else {
      coarse.push_back(
          fmt::format("{} ends at {}, for {:.1f} times the time", full_name(*r), error_text(r->time.p99), ratio.value));
    }
  }
  std::string text;
  if (!reach.empty()) {
    text += fmt::format("For an error of at most {:g}, against the closed form's time, it takes {}. ", fine,
                        fmt::join(reach, ", "));
  }
  if (!coarse.empty()) text += fmt::format("Of those that never get there, {}. ", fmt::join(coarse, ", "));
  text += missing_text(heat);
  const std::vector<const Racer*> faster = fine_and_faster(heat);
  for (const Racer* r : faster) text += full_name(*r) + " is as fine and faster than the closed form. ";
  if (faster.empty() && heat.racers.size() > 1)
    text += fmt::format("None that reaches {:g} is faster than the closed form. ", fine);
  return text;
}

/// Of what turns: what the front door of it reaches, at which price, and what leaving the spin out costs.
std::string turning_answer(const std::vector<Heat>& heats) {
  std::int64_t races = 0, missed = 0, touching = 0;
  std::vector<double> errors, times;
  for (const Heat& heat : heats) {
    if (heat.kind != QueryClass::hit || !heat.set->turns || heat.scalar != "double") continue;
    for (const Racer* r : one_a_method(heat)) {
      if (r->method == LinearSweep<double>::name) {
        missed += r->missed;
        touching += r->touching;
      }
      if (r->method != ConservativeAdvancement<double>::name) continue;
      ++races;
      if (!finishes(*r)) continue;
      errors.push_back(r->time.p99);
      times.push_back(nanoseconds(*r).value / 1000);
    }
  }
  std::string text;
  if (!times.empty()) {
    text += fmt::format(
        " Of shapes that turn, conservative advancement misses nothing in {} of {} races: it comes to {:.0e} of a step in "
        "{:.2g} to {:.2g} us a query.",
        times.size(), races, std::ranges::max(errors), std::ranges::min(times), std::ranges::max(times));
  }
  if (touching > 0) {
    text += fmt::format(" A sweep that leaves the turn out misses {} of the contacts.",
                        percent_text(share_of(missed, touching)));
  }
  return text;
}

/// The races on hits in double, or in float if there are no others.
std::string summary_of(const std::vector<Heat>& heats, const std::vector<Row>& all) {
  const bool any_double = std::ranges::find(heats, "double", &Heat::scalar) != heats.end();
  std::string text;
  for (const Heat& heat : heats) {
    if (heat.kind != QueryClass::hit || (heat.scalar == "double") != any_double) continue;
    std::vector<Row> rows = all;
    std::erase_if(rows, [&](const Row& row) { return row.heat != &heat; });
    Table table = trailing_table(rows);
    table.description = fmt::format("{}: hits in {}.", heat.set->name, heat.scalar);
    text += terminal(table, {"method", "option", "missed", "false_share", "error_p99", "evaluations", "nanoseconds",
                             "times_closed_form"}) +
            "\n";
  }
  return text +
         wrapped(
             "Each method at its roughest setting with a p99 error of at most 1e-12 of a step (in float 1e-6), or its "
             "finest; missing: infinite. False share: of misses, asked apart, that it calls a hit.");
}

/// What is kept of the contracts, of straight motion and of what turns, and which races break one.
std::string self_test_words(const std::vector<Heat>& heats) {
  std::string text, broken;
  for (const bool turns : {false, true}) {
    std::int64_t races = 0, kept = 0;
    for (const Heat& heat : heats) {
      if (heat.set->turns != turns) continue;
      const bool keeps = keeps_contract(heat);
      ++races;
      kept += keeps ? 1 : 0;
      if (!keeps) broken += fmt::format(" FAILED: {}, {} in {}.", heat.set->name, name(heat.kind), heat.scalar);
    }
    if (races == 0) continue;
    text += fmt::format("{}{} in {} of {}{}.", text.empty() ? "" : " ",
                        turns ? "Of what turns, those that claim it are never late and never miss"
                              : "The closed form keeps its contract",
                        kept, races, turns ? "" : " races");
  }
  return text + broken;
}

Outcome outcome_of(const std::vector<Heat>& heats) {
  const std::vector<Row> rows = rows_of(heats);
  std::string cheapest;
  for (const Heat& heat : heats) {
    if (heat.kind == QueryClass::hit) cheapest += heat_text(heat) + "\n\n";
  }
  return {.answer = work_precision_answer(heats),
          .summary = summary_of(heats, rows) + "\n" + wrapped("Self-test: " + self_test_words(heats)),
          .tables = {trailing_table(rows), errors_table(rows), times_table(rows)},
          .figures = figures_of(heats),
          .sections = {{"Who is cheapest at which error", cheapest}, {"Self-test", self_test_words(heats)}},
          .self_test_passed = std::ranges::all_of(heats, keeps_contract)};
}

/// What is chosen under a key, and whether by "all".
struct Choice {
  std::vector<std::string> names;
  bool all;
  bool has(std::string_view name) const { return std::ranges::find(names, name) != names.end(); }
};

Choice choice_of(const Settings& settings, std::string_view key, std::vector<std::string_view> allowed) {
  const std::vector<std::string> names = settings.choices_or_all(key, allowed);
  allowed.emplace_back("all");
  const std::vector<std::string> said = settings.choices(key, allowed);
  return {names, std::ranges::find(said, "all") != said.end()};
}

/// A pair that a method does not serve is left out where all are asked for, and refused where it is named.
void check_served(const Settings& settings, const QuerySet& set, const Choice& sets, const Choice& methods) {
  if (sets.all || methods.all) return;
  for (const std::string& method : methods.names) {
    if (std::find(set.methods.begin(), set.methods.end(), method) != set.methods.end()) continue;
    settings.complain("method", fmt::format("for the set \"{}\" one of {}; \"{}\" does not serve that pair of shapes",
                                            set.name, fmt::join(set.methods, ", "), method));
  }
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const Choice sets = choice_of(settings, "set", names_of(query_sets())),
               methods = choice_of(settings, "method", all_methods());
  static constexpr std::array<std::string_view, 2> all_scalars = {"float", "double"};
  const std::vector<std::string> scalars = settings.choices("scalar", all_scalars);

  RaceOptions race;
  race.methods = methods.names;
  race.tolerances = settings.numbers("tolerance", {.lower = std::numeric_limits<double>::epsilon(), .upper = 1});
  std::ranges::sort(race.tolerances, std::greater());
  race.poses = settings.integers("substeps", 1, 1 << 20);
  std::ranges::sort(race.poses);
  race.queries = settings.trials("queries", 1, 1 << 24, options.trials);
  race.rounds = settings.integer("rounds", 1, 1 << 20);
  race.seed = options.seed;
  if (std::ranges::find(scalars, "float") != scalars.end() &&
      race.tolerances.front() < double{std::numeric_limits<float>::epsilon()}) {
    settings.complain("tolerance", fmt::format("for scalar \"float\" at least one of {:g} to 1, which it can resolve",
                                               std::numeric_limits<float>::epsilon()));
  }

  std::vector<Heat> heats;
  std::vector<Task<std::vector<Racer>>> tasks;
  for (const QuerySet& set : query_sets()) {
    if (!sets.has(set.name)) continue;
    check_served(settings, set, sets, methods);
    if (std::ranges::none_of(set.methods, [&](auto method) { return methods.has(method); })) continue;
    for (const std::string& scalar : scalars) {
      for (const QueryClass kind : {QueryClass::hit, QueryClass::miss, QueryClass::graze}) {
        heats.push_back({&set, kind, scalar, {}});
        const auto run = scalar == "float" ? set.in_float : set.in_double;
        tasks.push_back({fmt::format("{} {} {}", set.name, name(kind), scalar), race.queries,
                         [run, kind, race] { return run(kind, race); }});
      }
    }
  }
  if (heats.empty()) settings.complain("method", "at least one that serves a pair of the sets");
  const auto finish = [heats](const Done<std::vector<Racer>>& done) {
    std::vector<Heat> run = heats;
    for (std::size_t i = 0; i < run.size(); ++i) run[i].racers = done.results[i];
    return outcome_of(run);
  };
  return make_run(finish, std::move(tasks));
}

}  // namespace

std::string heat_text(const Heat& heat) {
  return fmt::format("Of {}, hits in {}: ", heat.set->title, heat.scalar) + front_text(heat) + trailing_text(heat);
}

std::string work_precision_answer(const std::vector<Heat>& heats) {
  std::int64_t races = 0, races_won = 0;
  std::string faster;
  std::vector<double> ratios;
  for (const Heat& heat : heats) {
    const Racer* exact = closed_form_of(heat);
    if (heat.kind != QueryClass::hit || exact == nullptr || heat.racers.size() < 2) continue;
    ++races;
    const auto rivals = fine_and_faster(heat);
    races_won += rivals.empty() ? 1 : 0;
    for (const Racer* r : rivals)
      faster += fmt::format(" {} is faster on {} in {}.", full_name(*r), heat.set->name, heat.scalar);
    for (const Racer* r : one_a_method(heat)) {
      if (r == exact || !finishes(*r) || r->time.p99 > fine_error(heat.scalar)) continue;
      ratios.push_back(slowdown(*r, *exact).value);
    }
  }
  const std::string turning = turning_answer(heats);
  if (races == 0 && !turning.empty()) return turning.substr(1);
  if (races == 0) return "Nobody was held against the closed form: see the tables.";
  std::string text = fmt::format(
      "In {} of {} races on hits no method is as fine as 1e-12 of a step (1e-6 in float) and faster than the closed form.{}",
      races_won, races, faster);
  if (!ratios.empty()) {
    text += fmt::format(" The other methods that get there take {:.1f} to {:.0f} times its time at equal error.",
                        std::ranges::min(ratios), std::ranges::max(ratios));
  }
  return text + turning;
}

Experiment work_precision_experiment() {
  return {"work_precision", "What error does each way to find a time of impact make, and what time does it take?",
          embedded_toml("work_precision"), configure};
}

}  // namespace thinwall
