#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/speed/report.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

/// Lines of at most 100 letters, broken between words.
std::string wrapped(const std::string& text) {
  std::string out;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
    if (line > 0 && line + 1 + (end - begin) > 100) {
      out += '\n';
      line = 0;
    }
    if (line > 0) out += ' ';
    out.append(text, begin, end - begin);
    line += end - begin + (line > 0 ? 1 : 0);
    if (end < text.size() && text[end] == '\n') {
      out += '\n';
      line = 0;
    }
    begin = end + 1;
  }
  return out;
}

/// Programs and libraries that did not take part, a sentence each.
std::string left_out_text(const SpeedResult& result) {
  std::string text;
  const Table programs = speed_programs_table(result);
  for (const auto& row : programs.rows) {
    if (const auto* why = std::get_if<std::string>(&row[2]))
      text += fmt::format("{}Left out: {}: {}.", text.empty() ? "" : "\n", std::get<std::string>(row[0]), *why);
  }
  return text;
}

double wrong_verdicts(const TimedWay& c) {
  return error_of(c, "missed").value_or(0) + error_of(c, "false").value_or(0);
}

/// Our own, on queries where a wrong verdict has no excuse: not the ones made to be hard.
bool must_be_right(const TimedWay& c) {
  return c.kind == "time_of_impact" && name_of(c) == "thinwall, front door" && error_of(c, "missed").has_value();
}

std::string self_test_words(const SpeedResult& result) {
  std::size_t judged = 0;
  std::string broken;
  for (const TimedWay& c : result.ways) {
    if (!error_of(c, "missed")) continue;
    ++judged;
    const std::string name = fmt::format("{} {} {}", c.kind, c.subject, c.way);
    if (!c.errors_agree) broken += fmt::format(" FAILED: {}: its errors differ from round to round.", name);
    if (must_be_right(c) && wrong_verdicts(c) > 0)
      broken += fmt::format(" FAILED: {}: {:.0f} wrong verdicts.", name, wrong_verdicts(c));
  }
  return fmt::format(
      "Self-test: in {} rows with an oracle the errors are the same in every round, and our front door has no wrong verdict.{}",
      judged, broken.empty() ? " It holds." : broken);
}

struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  bool any() const { return most > 0; }
};

}  // namespace

bool speed_self_test(const SpeedResult& result) {
  return std::all_of(result.ways.begin(), result.ways.end(),
                     [](const TimedWay& c) { return c.errors_agree && (!must_be_right(c) || wrong_verdicts(c) == 0); });
}

std::string speed_answer(const SpeedResult& result) {
  Extremes ours, floor, slower;
  double worst_of_ours = 0, best_of_peers = std::numeric_limits<double>::infinity(), wrong = 0;
  for (const TimedWay* c : drawn_ways(result.ways)) {
    const double length = error_of(*c, "p99_length").value_or(0);
    if (must_be_right(*c)) {
      ours.add(time_of(*c).median);
      worst_of_ours = std::max(worst_of_ours, length);
      if (!c->to_floor.empty()) floor.add(median(c->to_floor));
    } else if (const TimedWay* front = front_door_for(result.ways, *c); is_peer(*c) && front != nullptr) {
      slower.add(median(c->nanoseconds) / median(front->nanoseconds));
      best_of_peers = std::min(best_of_peers, length);
      wrong += wrong_verdicts(*c);
    }
  }
  if (!ours.any()) {
    return fmt::format(
               "{} rows were timed; none asks our front door for a time of impact, so that there is no race to tell of.",
               result.ways.size()) +
           batch_text(result.ways);
  }
  std::string text = fmt::format(
      "A time of impact through the front door takes {:.0f} to {:.0f} ns, by pair, at a 99th percentile error of at most {:.0e} m",
      ours.least, ours.most, worst_of_ours);
  if (floor.any()) text += fmt::format("; that is {:.0f} to {:.0f} times the measured floor", floor.least, floor.most);
  text += ".";
  if (slower.any()) {
    text += fmt::format(
        " The other libraries' casts take {:.1f} to {:.0f} times as long, at errors from {:.0e} m on, and give {} wrong verdicts over all pairs.",
        slower.least, slower.most, best_of_peers, grouped_text(static_cast<std::int64_t>(wrong)));
  } else {
    text += " No other library took part.";
  }
  return text + batch_text(result.ways);
}

std::string speed_summary(const SpeedResult& result) {
  constexpr const char* format = "{:<17}{:<32}{:>9}{:>9}{:>9}{:>8}{:>9}\n";
  const std::vector<const TimedWay*> drawn = drawn_ways(result.ways);
  std::string text;
  if (!drawn.empty())
    text = fmt::format(format, "time of impact", "who", "ns", "x floor", "missed", "false", "p99 [m]");
  for (const TimedWay* c : drawn) {
    text += fmt::format(format, c->subject, name_of(*c), fmt::format("{:.1f}", median(c->nanoseconds)),
                        c->to_floor.empty() ? "-" : fmt::format("{:.1f}", median(c->to_floor)),
                        fmt::format("{:.0f}", error_of(*c, "missed").value_or(0)),
                        fmt::format("{:.0f}", error_of(*c, "false").value_or(0)),
                        fmt::format("{:.0e}", error_of(*c, "p99_length").value_or(0)));
  }
  const std::string left_out = left_out_text(result);
  return text + (drawn.empty() ? "" : "\n") + (left_out.empty() ? "" : wrapped(left_out) + "\n") +
         wrapped(self_test_words(result)) + "\n";
}

std::vector<Section> speed_sections(const SpeedResult& result) {
  const std::string left_out = left_out_text(result);
  return {
      {"What is asked",
       "The benchmark programs of the suite, as they lie in the build tree. Time of impact: 100 000 queries a pair in random order, "
       "half of them hits, apart by 0.02 m or more at the start, both bodies moving. The front door checks its input and gives the whole answer; "
       "a kernel gives verdict and time; the plain form is the one everybody writes first. Other libraries are asked the same queries, "
       "their shapes and transforms made beforehand; a library's distance is in the units of the query, taken as meters."},
      {"How it is timed",
       "Every round starts each program anew, one after another and never two at once, so that a process's luck with its memory is "
       "in the spread. Time is the processor's for the thread, as Google Benchmark takes it; the median over rounds."},
      {"Floor",
       "What the same work takes at least: to read the bytes of a query from wherever so many of them stay, or the divisions and "
       "square roots that a hit cannot do without, whichever is more; measured in the same process. No more than a bound: comparisons, "
       "mispredicted jumps and the rest of the arithmetic are not in it."},
      {"Oracle", "The closed form in long double; for contacts the separation of the two shapes in long double."},
      {"Left out", left_out.empty() ? "Nothing: every program of the suite and every library took part." : left_out},
      {"Self-test", self_test_words(result)},
      {"Limits",
       "One machine, with whatever else it does; ratios within a run carry further than nanoseconds. Intervals are over a few rounds, and "
       "tell the noise of this machine in this quarter of an hour, no more. A library may be quicker when its user keeps more between "
       "queries than shapes and transforms, and Bullet here calculates in float."},
  };
}

}  // namespace thinwall
