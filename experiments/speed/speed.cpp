/// What does an answer cost on this machine, and how wrong is it: ours, the plain form, other libraries? See docs/speed.md.
#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/speed/model.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

constexpr double rows_of_a_program = 700;  // about, on average: for the estimate of a dry run, which starts none

constexpr std::string_view peers_program = "peers";
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> peer_names = {{{"bullet", "Bullet"},
                                                                                       {"ode", "ODE"},
                                                                                       {"fcl", "FCL"},
                                                                                       {"libccd", "libccd"},
                                                                                       {"rapier", "Rapier"},
                                                                                       {"jolt", "Jolt"},
                                                                                       {"physx", "PhysX"},
                                                                                       {"havok", "Havok"},
                                                                                       {"box2d3", "Box2D 3"},
                                                                                       {"thinwall", "thinwall"}}};

std::string in_words(std::string text) {
  text = spaced(std::move(text));
  std::ranges::replace(text, '/', ' ');
  for (const auto& [low, high] : {std::pair{"gjk", "GJK"}, {"mpr", "MPR"}}) {
    if (const std::size_t at = text.find(low); at != std::string::npos) text.replace(at, 3, high);
  }
  return text;
}

// What the programs said, row by row.

/// All rounds of one row, and what follows from them.
struct TimedWay {
  std::string program, kind, subject, way;
  std::vector<double> nanoseconds = {};              ///< [ns] an answer, one of each round
  std::vector<double> floor_ns = {}, to_floor = {};  ///< of each round, where the program says them
  std::vector<double> call_ns = {};  ///< [ns] what calling another language takes, not in the time; so, too
  std::vector<Counter> errors = {};  ///< its other counters, in the first round
  bool errors_agree = true;          ///< the same in every round

  Measured time() const { return median_of_rounds(nanoseconds); }
  double wrong_verdicts() const { return error("missed").value_or(0) + error("false").value_or(0); }

  /// Where the row has it.
  std::optional<double> error(std::string_view counter) const {
    const auto found = std::ranges::find(errors, counter, &Counter::name);
    return found == errors.end() ? std::nullopt : std::optional(found->value);
  }
  /// The program's own answer through it.
  bool is_front_door() const { return way == "front_door" || (program == peers_program && way == "thinwall"); }
  /// Another library answers.
  bool is_peer() const { return program == peers_program && !is_front_door(); }
  /// Our own, on queries where a wrong verdict has no excuse: not the ones made to be hard.
  bool must_be_right() const { return kind == "time_of_impact" && is_front_door() && error("missed"); }
  /// What a picture calls it: "thinwall, careful", "Bullet, subsimplex cast".
  std::string name() const {
    if (is_front_door()) return "thinwall, front door";
    if (way == "plain") return "plain form";
    if (program != peers_program) return "thinwall, " + in_words(way);
    for (const auto& [prefix, name] : peer_names) {
      if (!way.starts_with(prefix)) continue;
      const std::string rest = way.substr(prefix.size());
      return rest.empty() ? std::string(name) : std::string(name) + "," + in_words(rest);
    }
    return way;
  }
};

void add_round(TimedWay& timed, const BenchRow& row) {
  std::vector<Counter> errors;
  for (const Counter& counter : row.counters) {
    if (counter.name == "floor_ns") {
      timed.floor_ns.push_back(counter.value);
    } else if (counter.name == "to_floor") {
      timed.to_floor.push_back(counter.value);
    } else if (counter.name == "call_ns") {
      timed.call_ns.push_back(counter.value);
    } else {
      errors.push_back(counter);
    }
  }
  if (timed.nanoseconds.empty()) timed.errors = errors;
  timed.errors_agree = timed.errors_agree && timed.errors == errors;
  timed.nanoseconds.push_back(row.nanoseconds);
}

/// By program in the order of the suite, then as the program lists its rows.
std::vector<TimedWay> ways(const std::vector<BenchOutput>& rounds) {
  std::vector<TimedWay> all;
  for (const std::string_view program : bench_program_names) {
    for (const BenchOutput& output : rounds) {
      if (output.program != program) continue;
      for (const BenchRow& row : output.rows) {
        auto found = std::ranges::find_if(all, [&](const TimedWay& c) {
          return c.program == program && c.kind == row.kind && c.subject == row.subject && c.way == row.way;
        });
        if (found == all.end()) {
          found = all.insert(
              all.end(), {.program = std::string(program), .kind = row.kind, .subject = row.subject, .way = row.way});
        }
        add_round(*found, row);
      }
    }
  }
  return all;
}

/// Asked for a time of impact, and its errors counted: what the picture shows, pair by pair. Of those of one name and pair, the
/// first.
std::vector<TimedWay> drawn_ways(const std::vector<TimedWay>& all) {
  std::vector<TimedWay> drawn;
  for (const TimedWay& c : all) {
    if (c.kind != "time_of_impact" || !c.error("p99_length") || c.program == "methods") continue;
    const auto beyond = [&](const TimedWay& other) { return other.subject == c.subject; };
    const auto same = [&](const TimedWay& other) { return beyond(other) && other.name() == c.name(); };
    if (std::ranges::any_of(drawn, same)) continue;
    const auto last = std::find_if(drawn.rbegin(), drawn.rend(), beyond);  // pairs stay together
    drawn.insert(last == drawn.rend() ? drawn.end() : last.base(), c);
  }
  return drawn;
}

/// The program's own answer through the front door, for the subject of `timed`; null if it is not there.
const TimedWay* front_door_for(const std::vector<TimedWay>& all, const TimedWay& timed) {
  const TimedWay* found = nullptr;
  for (const TimedWay& c : all) {
    if (c.kind != timed.kind || c.subject != timed.subject || !c.is_front_door()) continue;
    if (c.program == timed.program) return &c;  // the same run
    if (found == nullptr) found = &c;
  }
  return found;
}

/// A row of a batch: sphere_sphere, f64/cache/AVX2.
struct BatchRow {
  std::string what, where, how;  ///< "sphere_sphere f64", "cache", "AVX2"
  const TimedWay* timed;
};

std::vector<BatchRow> batch_rows(const std::vector<TimedWay>& all) {
  std::vector<BatchRow> rows;
  for (const TimedWay& c : all) {
    const std::size_t first = c.way.find('/'), second = c.way.find('/', first + 1);
    if (c.kind != "batch" || first == std::string::npos || second == std::string::npos) continue;
    rows.push_back({c.subject + " " + c.way.substr(0, first), c.way.substr(first + 1, second - first - 1),
                    c.way.substr(second + 1), &c});
  }
  return rows;
}

std::string way_label(const std::string& how) {
  if (how == "scalar") return "row after row, front door";
  if (how == "SCALAR") return "batch, without vectors";
  if (how == "row_by_row") return "batch, pair by pair";
  if (how == "two_threads") return "batch, two threads";
  if (how.starts_with("AVX3")) return "batch, AVX-512";
  return "batch, " + how;
}

/// The least and the most of numbers > 0.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = 0;

  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  bool any() const { return most > 0; }
};

// What the tables show.

Columns<TimedWay> key_columns() {
  using T = TimedWay;
  return columns_of<T>(text("kind", "What is asked: a time of impact, a ray, a contact, a step of a world.", &T::kind),
                       text("subject", "Of what: a pair of shapes, a world.", &T::subject),
                       text("way", "Who answers, and how.", &T::way),
                       text("program", "Benchmark program that asked.", &T::program));
}

auto number_column(std::string name, std::string unit, std::string description, std::string_view counter) {
  return value(std::move(name), std::move(unit), std::move(description),
               [counter](const TimedWay& c) { return c.error(counter); });
}

auto count_column(std::string name, std::string description, std::string_view counter) {
  return value(std::move(name), "1", std::move(description),
               [counter](const TimedWay& c) -> std::optional<std::int64_t> {
                 const std::optional<double> count = c.error(counter);
                 return count ? std::optional(static_cast<std::int64_t>(*count)) : std::nullopt;
               });
}

/// Verdicts, and errors as a length.
auto missed_column() { return count_column("missed", "Hits of the set that are called misses.", "missed"); }
auto false_column() { return count_column("false_hits", "Misses of the set that are called hits.", "false"); }
auto p99_column() {
  return number_column("length_p99", "m", "99th percentile error of the hits that are found, as a length.",
                       "p99_length");
}
auto max_column() { return number_column("length_max", "m", "Largest of the same.", "max_length"); }

auto time_columns() {
  return measured("nanoseconds", "ns", "Processor time of an answer; median over rounds.", &TimedWay::time);
}

auto median_column(std::string name, std::string unit, std::string description, std::vector<double> TimedWay::*rounds) {
  return value(std::move(name), std::move(unit), std::move(description),
               [rounds](const TimedWay& c) -> std::optional<double> {
                 return (c.*rounds).empty() ? std::nullopt : std::optional(median(c.*rounds));
               });
}
auto to_floor_column() {
  return median_column("to_floor", "1", "Time over the floor measured beside it; median over rounds.",
                       &TimedWay::to_floor);
}

Table errors_table(std::vector<TimedWay> all) {
  std::erase_if(all, [](const TimedWay& c) { return !c.error("missed"); });
  return table("errors",
               "Verdicts and errors against the benchmark's oracle, of every row that has one. An error is that of a "
               "hit that was found: of a time in steps and as a length along the relative path, of a contact's depth "
               "as a length.",
               all, key_columns(), missed_column(), false_column(),
               number_column("error_p99", "1", "99th percentile error, in steps; of a depth, a length.", "p99_error"),
               number_column("error_max", "1", "Largest of the same.", "max_error"), p99_column(), max_column());
}

Table race_table(const std::vector<TimedWay>& drawn) {
  return in_report(
      timing(table("race",
                   "Time of impact: what an answer costs and what is wrong with it, of 100 000 queries a pair. Length: "
                   "the error of the time times the relative motion.",
                   drawn, text("subject", "The pair of shapes.", &TimedWay::subject),
                   text("who", "Who answers, and how.", &TimedWay::name), time_columns(), to_floor_column(),
                   missed_column(), false_column(), p99_column(), max_column())));
}

Table timings_table(const std::vector<TimedWay>& all) {
  return timing(
      table("timings",
            "Every row of every benchmark program: processor time of an answer, median over rounds, each a "
            "process of its own.",
            all, key_columns(), time_columns(),
            value("rounds", "1", "Rounds timed.", [](const TimedWay& c) { return c.nanoseconds.size(); }),
            median_column("floor_ns", "ns", "The least that the same work could take; median over rounds.",
                          &TimedWay::floor_ns),
            to_floor_column(),
            median_column(
                "call_ns", "ns",
                "What calling another language takes beside it, asked of nothing; not in the time; median over rounds.",
                &TimedWay::call_ns)));
}

Table floors_table(const std::vector<BenchOutput>& outputs) {
  std::map<std::string, std::vector<double>> floors;
  for (const BenchOutput& output : outputs) {
    for (const Counter& floor : output.floors) floors[floor.name].push_back(floor.value);
  }
  using Row = std::pair<std::string, std::vector<double>>;
  return in_report(timing(table(
      "floors", "What the machine can do at best, measured by each start of a program; medians and extremes over all.",
      std::vector<Row>(floors.begin(), floors.end()), text("floor", "What was measured.", &Row::first),
      value("median", "1", "In the unit that its name ends with.", [](const Row& row) { return median(row.second); }),
      value("least", "1", "Least of all starts.", [](const Row& row) { return std::ranges::min(row.second); }),
      value("most", "1", "Most of all starts.", [](const Row& row) { return std::ranges::max(row.second); }))));
}

/// What did not take part, and why.
std::optional<std::string> left_out(const BenchOutput& output) {
  std::string text = output.missing;
  const auto is_npm = [](const std::string& peer) { return std::ranges::find(npm_peers, peer) != npm_peers.end(); };
  for (const bool npm : {false, true}) {
    const auto some = only(output.peers_left_out, [&](const std::string& peer) { return is_npm(peer) == npm; });
    if (some.empty()) continue;
    text += fmt::format("{}without {}: {}", text.empty() ? "" : "; ", listed(some),
                        npm ? "install nodejs and run `npm ci` in experiments/adapters/npm"
                            : "install their development packages, configure with -DTHINWALL_PEERS=ON and build again");
  }
  return text.empty() ? std::nullopt : std::optional(text);
}

/// A start of each program: every round has the same rows.
std::vector<BenchOutput> first_starts(const std::vector<BenchOutput>& outputs) {
  std::vector<BenchOutput> starts;
  for (const std::string_view name : bench_program_names) {
    const auto first = std::ranges::find(outputs, name, &BenchOutput::program);
    if (first != outputs.end()) starts.push_back(*first);
  }
  return starts;
}

Table programs_table(const std::vector<BenchOutput>& outputs) {
  return in_report(
      table("programs", "Which benchmark programs and libraries took part.", first_starts(outputs),
            text("program", "Benchmark program.", &BenchOutput::program),
            value("rows", "1", "Rows that it has.", [](const BenchOutput& output) { return output.rows.size(); }),
            text("left_out", "What did not take part, and why; missing if all did.", left_out)));
}

// What the pictures show.

constexpr double least_length = 1e-17;  // [m] drawn in place of an error that is less, down to 0

std::vector<std::string> subjects_of(const std::vector<TimedWay>& drawn) { return distinct(drawn, &TimedWay::subject); }

/// [m] The error of the hits that are found: 99th percentile, to the largest.
Measured drawn_length(const TimedWay& c) {
  const double p99 = std::max(least_length, c.error("p99_length").value_or(0));
  return {p99, {p99, std::max(p99, c.error("max_length").value_or(0))}};
}

/// Of one pair, or of all of them.
Panel race_panel(const std::vector<TimedWay>& drawn, const std::string& subject) {
  Plot points = plot(drawn, text("subject", "", &TimedWay::subject), text("who", "", &TimedWay::name),
                     measured("length", "", "", drawn_length, "length_"), time_columns());
  if (!subject.empty()) points.where("subject", subject);
  return points
      .x("length", Axis::log,
         "error of the time of impact, as a length [m]: 99th percentile, with a bar to the largest")
      .y("nanoseconds", Axis::log, subject.empty() ? "ns a query" : subject + ", ns")
      .by("who")
      .height(subject.empty() ? 1.6 : 0.8);
}

/// Who gives a wrong verdict, in words.
std::string wrong_text(const std::vector<TimedWay>& drawn) {
  std::string text;
  for (const Group<TimedWay>& group : group_by(drawn, &TimedWay::name)) {
    double missed = 0, false_hits = 0;
    for (const TimedWay* c : group) {
      missed += c->error("missed").value_or(0);
      false_hits += c->error("false").value_or(0);
    }
    if (missed + false_hits == 0) continue;
    text += fmt::format("{}{} misses {} and invents {}", text.empty() ? "" : "; ", group[0]->name(),
                        grouped_text(static_cast<std::int64_t>(missed)),
                        grouped_text(static_cast<std::int64_t>(false_hits)));
  }
  return text.empty() ? "No verdict is wrong." : "Wrong verdicts, over all pairs: " + text + ".";
}

Figure race_figure(std::string name, std::string title, const std::vector<TimedWay>& drawn, std::vector<Panel> panels) {
  return {.name = std::move(name),
          .title = std::move(title),
          .caption = "Left is finer, lower is faster. The error of hits that are found; what is missed has none. " +
                     wrong_text(drawn) +
                     " Vertical bars, mostly hidden by their points: 95 % bootstrap intervals of the median time. "
                     "Errors below 1e-17 are drawn there.",
          .panels = std::move(panels),
          .is_timing = true};
}

/// A panel for each pair that another library answers; for each of all, if none answers any.
std::vector<Panel> panels_by_pair(const std::vector<TimedWay>& drawn) {
  const bool any_peer = std::ranges::any_of(drawn, &TimedWay::is_peer);
  std::vector<Panel> panels;
  for (const std::string& subject : subjects_of(drawn)) {
    const auto rival = [&](const TimedWay& c) { return c.subject == subject && c.is_peer(); };
    if (!any_peer || std::ranges::any_of(drawn, rival)) panels.push_back(race_panel(drawn, subject));
  }
  return panels;
}

/// Where a name is along an axis that has the first at its far end: the last is at 1.
double place_from_top(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<double>(names.end() - std::ranges::find(names, name));
}
std::vector<Tic> tics_from_top(const std::vector<std::string>& names) {
  std::vector<Tic> tics;
  for (const std::string& name : names) tics.push_back({place_from_top(names, name), name});
  std::ranges::reverse(tics);
  return tics;
}

/// Wrong verdicts of each, by pair; who has none is not there.
Figure verdict_figure(const std::vector<TimedWay>& drawn) {
  const std::vector<std::string> subjects = subjects_of(drawn);
  const auto place = [&](const TimedWay& c) { return place_from_top(subjects, c.subject); };
  Figure figure = {.name = "wrong_verdicts",
                   .title = "Wrong verdicts",
                   .caption = "Who is not there has none. " + wrong_text(drawn)};
  for (const auto& [counter, label] : {std::pair{"missed", "hits missed"}, {"false", "hits invented"}}) {
    const auto columns = columns_of<TimedWay>(text("who", "", &TimedWay::name), number_column("wrong", "", "", counter),
                                              value("place", "", "", place));  // the first on top
    Panel panel = plot(drawn, columns)
                      .where("wrong", [](double wrong) { return wrong > 0; })
                      .x("wrong", Axis::log, "of 100 000 queries, half of them hits")
                      .y("place", Axis::linear, label)
                      .by("who");
    panel.y_tics = tics_from_top(subjects);
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// What a row of a batch takes, by pair, scalar and width of vector; without panels where no batch was timed.
Figure batch_figure(const std::vector<TimedWay>& all) {
  const std::vector<BatchRow> rows = batch_rows(all);
  const std::vector<std::string> subjects = distinct(rows, &BatchRow::what);
  const auto place = [&](const BatchRow& row) { return place_from_top(subjects, row.what); };
  const auto columns = columns_of<BatchRow>(
      text("where", "", &BatchRow::where), text("who", "", [](const BatchRow& row) { return way_label(row.how); }),
      measured("time", "", "", [](const BatchRow& row) { return row.timed->time(); }), value("place", "", "", place));
  Figure figure = {
      .name = "batches",
      .title = "What a row of a batch takes",
      .caption =
          "Bars: 95 % bootstrap intervals of the median over rounds, by the clock on the wall. In the cache the floor is that of the divisions and "
          "square roots of scalar code, which vectors may go below; from memory it is to stream a row's bytes, one obstacle against many.",
      .is_timing = true};
  for (const std::string& where : distinct(rows, &BatchRow::where)) {
    Panel panel = plot(rows, columns)
                      .where("where", where)
                      .x("time", Axis::log, "ns a row")
                      .y("place", Axis::linear,
                         where == "cache"    ? "in the first cache"
                         : where == "memory" ? "streamed from memory"
                                             : where)
                      .by("who");
    Series floor{.label = "floor", .color = "#000000"};
    for (const BatchRow& row : rows) {
      if (row.where != where || row.timed->floor_ns.empty() || row.how == "row_by_row") continue;
      if (std::ranges::find(floor.y, place(row)) == floor.y.end()) floor.add(median(row.timed->floor_ns), place(row));
    }
    if (!floor.x.empty()) panel.series.push_back(std::move(floor));
    panel.y_tics = tics_from_top(subjects);
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

std::vector<Figure> figures_of(const std::vector<TimedWay>& all) {
  const std::vector<TimedWay> drawn = drawn_ways(all);
  std::vector<Figure> figures;
  if (!drawn.empty()) {
    figures = {
        race_figure("error_against_time", "Error against run time: a point a pair", drawn, {race_panel(drawn, "")}),
        verdict_figure(drawn),
        race_figure("error_against_time_by_pair", "Error against run time, pair by pair", drawn,
                    panels_by_pair(drawn))};
    for (Figure& figure : figures) figure.roster = distinct(drawn, &TimedWay::name);
  }
  figures.push_back(batch_figure(all));
  std::erase_if(figures, [](const Figure& f) { return f.panels.empty(); });
  return figures;
}

// What it says.

/// Programs and libraries that did not take part, a sentence each.
std::string left_out_text(const std::vector<BenchOutput>& outputs) {
  std::string text;
  for (const BenchOutput& output : first_starts(outputs)) {
    if (const auto why = left_out(output)) text += fmt::format("Left out: {}: {}.\n", output.program, *why);
  }
  return text;
}

/// The same errors in every round, and none of our own verdicts wrong.
bool is_right(const TimedWay& c) { return c.errors_agree && !(c.must_be_right() && c.wrong_verdicts() > 0); }

std::string self_test_words(const std::vector<TimedWay>& all) {
  std::size_t judged = 0;
  std::string broken;
  for (const TimedWay& c : all) {
    if (!c.error("missed")) continue;
    ++judged;
    const std::string name = fmt::format("{} {} {}", c.kind, c.subject, c.way);
    if (!c.errors_agree) broken += fmt::format(" FAILED: {}: its errors differ from round to round.", name);
    if (c.must_be_right() && c.wrong_verdicts() > 0)
      broken += fmt::format(" FAILED: {}: {:.0f} wrong verdicts.", name, c.wrong_verdicts());
  }
  return fmt::format(
      "Self-test: in {} rows with an oracle the errors are the same in every round, and our front door has no wrong "
      "verdict.{}",
      judged, broken.empty() ? " It holds." : broken);
}

/// A sentence on batches, after a space; empty where none was timed.
std::string batch_text(const std::vector<TimedWay>& all) {
  const std::vector<BatchRow> rows = batch_rows(all);
  Extremes times, gains;
  for (const BatchRow& scalar : rows) {
    if (scalar.how != "scalar") continue;
    Extremes others;
    for (const BatchRow& row : rows) {
      if (row.what != scalar.what || row.where != scalar.where || row.how == "scalar" || row.how == "two_threads")
        continue;
      others.add(median(row.timed->nanoseconds));
    }
    if (!others.any()) continue;  // nothing but the scalar code
    times.add(others.least);
    gains.add(median(scalar.timed->nanoseconds) / others.least);
  }
  if (!times.any()) return "";
  return fmt::format(
      " A batch on one thread takes {} to {} ns a row at its quickest, {} to {} times as fast as the same rows one after another.",
      rounded_text(times.least, 2), rounded_text(times.most, 2), rounded_text(gains.least, 2),
      rounded_text(gains.most, 2));
}

std::string answer_of(const std::vector<TimedWay>& all) {
  Extremes ours, floor, slower;
  double worst_of_ours = 0, best_of_peers = std::numeric_limits<double>::infinity(), wrong = 0;
  for (const TimedWay& c : drawn_ways(all)) {
    const double length = c.error("p99_length").value_or(0);
    if (c.must_be_right()) {
      ours.add(c.time().value);
      worst_of_ours = std::max(worst_of_ours, length);
      if (!c.to_floor.empty()) floor.add(median(c.to_floor));
    } else if (const TimedWay* front = front_door_for(all, c); c.is_peer() && front != nullptr) {
      // a cast of 0 ns took less than the call that was subtracted: how long is not known
      if (const double time = median(c.nanoseconds); time > 0) slower.add(time / median(front->nanoseconds));
      best_of_peers = std::min(best_of_peers, length);
      wrong += c.wrong_verdicts();
    }
  }
  if (!ours.any()) {
    return fmt::format(
        "{} rows were timed; none asks our front door for a time of impact, so that there is no race to tell of.{}",
        all.size(), batch_text(all));
  }
  std::string text = fmt::format(
      "A time of impact through the front door takes {:.0f} to {:.0f} ns, by pair, at a 99th percentile error of at "
      "most {:.0e} m",
      ours.least, ours.most, worst_of_ours);
  if (floor.any()) text += fmt::format("; that is {:.0f} to {:.0f} times the measured floor", floor.least, floor.most);
  text += ".";
  if (slower.any()) {
    text += fmt::format(
        " The other libraries' casts take {:.1f} to {:.0f} times as long as the front door does in their own program, at "
        "errors from {:.0e} m on, and give {} wrong verdicts over all pairs.",
        slower.least, slower.most, best_of_peers, grouped_text(static_cast<std::int64_t>(wrong)));
  } else {
    text += " No other library took part.";
  }
  return text + batch_text(all);
}

Outcome outcome_of(const std::vector<BenchOutput>& outputs) {
  const std::vector<TimedWay> all = ways(outputs);
  const Table race = race_table(drawn_ways(all));
  std::string shown;
  if (!race.rows.empty()) {
    shown = terminal(race, {"subject", "who", "nanoseconds", "to_floor", "missed", "false_hits", "length_p99"}) + "\n";
  }
  Outcome outcome = {
      .answer = answer_of(all),
      .summary = shown + wrapped(left_out_text(outputs)) + wrapped(self_test_words(all)),
      .tables = {race, programs_table(outputs), floors_table(outputs), errors_table(all), timings_table(all)},
      .figures = figures_of(all),
      .sections = {{"Self-test", self_test_words(all)}},
      .self_test_passed = std::ranges::all_of(all, is_right)};
  std::erase_if(outcome.tables, [](const Table& table) { return table.rows.empty(); });
  return outcome;
}

std::unique_ptr<Run> configure_speed(const Settings& settings, const RunOptions& options) {
  const std::vector<std::string> programs = settings.choices_or_all("programs", bench_program_names);
  const std::string named = settings.text("benchmarks");
  const std::filesystem::path folder = named.empty() ? built_benchmarks() : std::filesystem::path(named);
  const BenchOptions bench{settings.number("seconds", {.lower = 0.001, .upper = 100, .unit = "s"}),
                           settings.text("filter")};
  const std::int64_t rounds = settings.trials("rounds", 1, 1000, options.trials);
  try {
    const std::regex checked(bench.filter);
  } catch (const std::regex_error&) {
    settings.complain("filter", "a regular expression, or \"\" for every row");
  }
  if (std::ranges::none_of(programs, [&](const std::string& program) { return is_program(folder / program); })) {
    const std::string allowed = fmt::format(
        "a folder that holds at least one of the benchmark programs asked for; {} has none. "
        "Build them: cmake --preset bench && cmake --build --preset bench",
        one_line(folder.string()));
    if (named.empty()) settings.complain("benchmarks", allowed);
    // No file may name a folder: the command line did.
    throw UsageError(fmt::format("--benchmarks: '{}' is not allowed; {}", one_line(named), allowed));
  }
  std::vector<Task<BenchOutput>> tasks;
  for (std::int64_t round = 1; round <= rounds; ++round) {
    for (const std::string& program : programs) {
      tasks.push_back({fmt::format("{} {}", program, round), 1,
                       [folder, program, bench] { return run_bench_program(folder, program, bench); },
                       rows_of_a_program * bench.seconds});
    }
  }
  return make_run([](const Done<BenchOutput>& done) { return outcome_of(done.results); }, std::move(tasks));
}

}  // namespace

Experiment speed_experiment() {
  return {"speed",
          "What does an answer cost on this machine, and how wrong is it: ours, the plain form, other libraries?",
          embedded_toml("speed"), configure_speed};
}

}  // namespace thinwall
