#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/speed/model.hpp>

namespace thinwall {

namespace {

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

void add_row(Series& series, const BatchRow& row, double at) {
  const Measured time = row.timed->time();
  series.add(time.value, at);
  series.x_lower.push_back(time.interval.lower);
  series.x_upper.push_back(time.interval.upper);
  series.lower.push_back(at);
  series.upper.push_back(at);
}

}  // namespace

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

Figure batch_figure(const std::vector<TimedWay>& all) {
  const std::vector<BatchRow> rows = batch_rows(all);
  const std::vector<std::string> subjects = distinct(rows, &BatchRow::what);
  Figure figure;
  figure.name = "batches";
  figure.title = "What a row of a batch takes";
  figure.caption =
      "Bars: 95 % bootstrap intervals of the median over rounds, by the clock on the wall. In the cache the floor is that of the divisions and "
      "square roots of scalar code, which vectors may go below; from memory it is to stream a row's bytes, one obstacle against many.";
  figure.is_timing = true;
  for (const std::string& where : distinct(rows, &BatchRow::where)) {
    Panel panel;
    panel.x_label = "ns a row";
    panel.y_label = where == "cache" ? "in the first cache" : where == "memory" ? "streamed from memory" : where;
    panel.log_x = true;
    Series floor{.label = "floor", .color = "#000000"};
    for (const std::string& how : distinct(rows, &BatchRow::how)) {
      Series series{.label = way_label(how)};
      for (const BatchRow& row : rows) {
        if (row.where != where || row.how != how) continue;
        const auto at = static_cast<double>(subjects.end() - std::ranges::find(subjects, row.what));
        add_row(series, row, at);
        if (row.timed->floor_ns.empty() || how == "row_by_row") continue;
        if (std::ranges::find(floor.y, at) != floor.y.end()) continue;
        floor.add(median(row.timed->floor_ns), at);
      }
      if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    if (!floor.x.empty()) panel.series.push_back(std::move(floor));
    panel.y_tics = tics_from_top(subjects);
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace thinwall
