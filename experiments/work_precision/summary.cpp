#include <thinwall/experiments/work_precision/summary.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace thinwall {

namespace {

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
  const Estimate time = nanoseconds(*front[0]);
  text += fmt::format(", at {:.0f} ns a query ({})", time.median, between("{:.0f}", time.interval));
  for (std::size_t i = 1; i < front.size(); ++i) {
    const Estimate gain = slowdown(*front[i], *front[i - 1]);
    text += fmt::format("; where {} is good enough the curves cross and {} is, in {:.2f} of that ({})",
                        error_text(front[i]->time.p99), full_name(*front[i]), gain.median,
                        between("{:.2f}", gain.interval));
  }
  return text + ". ";
}

/// By how much the others trail the closed form.
std::string trailing_text(const Heat& heat) {
  const Racer* exact = closed_form_of(heat);
  if (exact == nullptr) return "";
  const double fine = fine_error(heat.scalar);
  std::string reach, coarse, miss;
  for (const Racer* r : one_a_method(heat)) {
    if (r == exact) continue;
    const Estimate ratio = slowdown(*r, *exact);
    const std::string name = full_name(*r);
    if (!finishes(*r)) {
      miss += fmt::format("{}{} ({} of {})", miss.empty() ? "" : ", ", name, r->missed + r->gave_up, r->touching);
    } else if (r->time.p99 <= fine) {
      reach += fmt::format("{}{} {:.1f} times as long ({})", reach.empty() ? "" : ", ", name, ratio.median,
                           between("{:.1f}", ratio.interval));
    } else {
      coarse += fmt::format("{}{} ends at {}, for {:.1f} times the time", coarse.empty() ? "" : ", ", name,
                            error_text(r->time.p99), ratio.median);
    }
  }
  std::string text;
  if (!reach.empty())
    text += fmt::format("For an error of at most {:g}, against the closed form's time, it takes {}. ", fine, reach);
  if (!coarse.empty()) text += "Of those that never get there, " + coarse + ". ";
  if (!miss.empty()) text += "Contacts are missed by " + miss + ". ";
  const std::vector<const Racer*> faster = fine_and_faster(heat);
  for (const Racer* r : faster) text += full_name(*r) + " is as fine and faster than the closed form. ";
  if (faster.empty() && heat.racers.size() > 1)
    text += fmt::format("None that reaches {:g} is faster than the closed form. ", fine);
  return text;
}

constexpr const char* row_format = "{:<25}{:<16}{:>6} {:>7} {:>8} {:>8} {:>7} {:>8} {:>8}\n";

std::string table_of(const Heat& heat, const std::vector<Heat>& heats) {
  std::string text = fmt::format("{}: hits in {}\n", heat.set->name, heat.scalar);
  text += fmt::format(fmt::runtime(row_format), "method", "setting", "missed", "false", "median", "p99", "evals", "ns",
                      "x closed");
  const Racer* exact = closed_form_of(heat);
  for (const Racer* r : one_a_method(heat)) {
    const std::optional<double> wrong = false_share(heats, heat, *r);
    text += fmt::format(fmt::runtime(row_format), r->method, r->setting, r->missed + r->gave_up,
                        wrong ? fmt::format("{:.1f} %", 100 * *wrong) : "-", error_text(r->time.median),
                        error_text(r->time.p99), fmt::format("{:.1f}", r->evaluations),
                        fmt::format("{:.0f}", nanoseconds(*r).median),
                        exact == nullptr ? "-" : fmt::format("{:.2f}", slowdown(*r, *exact).median));
  }
  return text;
}

}  // namespace

bool keeps_contract(const Heat& heat) {
  const Racer* exact = closed_form_of(heat);
  return exact == nullptr || (exact->is_sound() && exact->forward <= 4);
}

std::string heat_text(const Heat& heat) {
  if (heat.kind != QueryClass::hit) return "";
  return fmt::format("Of {}, hits in {}: ", heat.set->title, heat.scalar) + front_text(heat) + trailing_text(heat);
}

std::string work_precision_answer(const std::vector<Heat>& heats) {
  std::int64_t races = 0, races_won = 0;
  std::string faster;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Heat& heat : heats) {
    const Racer* exact = closed_form_of(heat);
    if (heat.kind != QueryClass::hit || exact == nullptr) continue;
    ++races;
    const auto rivals = fine_and_faster(heat);
    races_won += rivals.empty() ? 1 : 0;
    for (const Racer* r : rivals)
      faster += fmt::format(" {} is faster on {} in {}.", full_name(*r), heat.set->name, heat.scalar);
    for (const Racer* r : one_a_method(heat)) {
      if (r == exact || !finishes(*r) || r->time.p99 > fine_error(heat.scalar)) continue;
      least = std::min(least, slowdown(*r, *exact).median);
      most = std::max(most, slowdown(*r, *exact).median);
    }
  }
  if (races == 0) return "The closed form, which the others are held against, did not take part: see the tables.";
  std::string text = fmt::format(
      "In {} of {} races on hits no method is as fine as 1e-12 of a step (1e-6 in float) and faster than the closed form.{}",
      races_won, races, faster);
  if (most > 0) {
    text += fmt::format(" The other methods that get there take {:.1f} to {:.0f} times its time at equal error.", least,
                        most);
  }
  return text;
}

std::string work_precision_summary(const std::vector<Heat>& heats) {
  const bool any_double = std::any_of(heats.begin(), heats.end(), [](const Heat& h) { return h.scalar == "double"; });
  std::string text;
  for (const Heat& heat : heats) {
    if (heat.kind == QueryClass::hit && (heat.scalar == "double") == any_double) text += table_of(heat, heats) + "\n";
  }
  text +=
      "Each method at its roughest setting with a p99 error of at most 1e-12 (in float 1e-6), or its finest.\n"
      "Errors in steps; -: infinite, it misses too many. Missed: contacts. False: of misses, asked apart, that\n"
      "it calls a hit. Evals: a query. x closed: times the closed form's time.\n";
  const auto broken = std::count_if(heats.begin(), heats.end(), [](const Heat& h) { return !keeps_contract(h); });
  return text + fmt::format("\nSelf-test: the closed form keeps its contract in {} of {} races.\n",
                            static_cast<std::ptrdiff_t>(heats.size()) - broken, heats.size());
}

std::vector<Section> work_precision_sections(const std::vector<Heat>& heats) {
  std::string words, broken;
  for (const Heat& heat : heats) {
    const std::string text = heat_text(heat);
    if (!text.empty()) words += text + "\n\n";
    if (keeps_contract(heat)) continue;
    broken += fmt::format("FAILED: {}, {} in {}. ", heat.set->name, name(heat.kind), heat.scalar);
  }
  return {
      {"Who is cheapest at which error", words},
      {"What is asked",
       "Every method, at every setting of its option, is asked the same queries: straight passes of two moving bodies with "
       "sizes, directions, paths and places drawn at random. Hits touch, at a time uniform over the step; misses pass beside; "
       "grazes pass next to the threshold between the two, on either side. The error is that of the time, in steps; a contact "
       "that is missed counts as infinite.\n\nEach is timed in rounds: every round takes all methods and settings in another "
       "order, a slice of the queries each. A slice is all queries, or for a slow method as many as take about 4 ms."},
      {"Oracle",
       "The time of first contact at 50 digits, from support functions alone; it shares no code with any method."},
      {"Self-test",
       "The closed form gives no wrong verdict on any query, and no time that is off by more than 4 u kappa t, the "
       "bound of its contract. " +
           (broken.empty() ? fmt::format("It holds in all {} races.", heats.size()) : broken)},
      {"Limits",
       "One process, one machine, with every core at work. A set of a thousand queries that is asked again and again lies in the cache, "
       "and branch predictors learn part of it: times are lower than for queries that stream from memory, for all methods "
       "alike. Bars are of the median over rounds, not over queries."},
  };
}

}  // namespace thinwall
