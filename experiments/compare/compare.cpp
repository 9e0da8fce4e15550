#include <thinwall/experiments/compare/compare.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

constexpr double most_exact_steps = 1e7;  // of one run

Comparison read_comparison(const Settings& settings, const RunOptions& options) {
  Comparison out;
  out.scene = read_scene(settings, options);
  out.scene.options.threads = 1;  // contenders run side by side, and each is timed
  const CompareKeys keys = read_compare_keys(settings);
  for (const std::string& policy : keys.policies) {
    for (const double dt : keys.steps) out.contenders.push_back({policy_named(policy), out.scene.options.substeps, dt});
  }
  out.repeats = keys.repeats;
  out.exact = {TimePolicy::event_driven, 1, keys.steps.front() / keys.finer};
  if (keys.steps.back() > out.scene.duration())
    settings.complain("compare.dt", fmt::format("at most the scene's {} s", out.scene.duration()));
  if (out.scene.duration() / out.exact.dt > most_exact_steps)
    settings.complain("compare.dt", fmt::format("at most {:.0f} steps of the exact run", most_exact_steps));
  return out;
}

Scene scene_for(const Comparison& comparison, const Contender& contender) {
  Scene scene = comparison.scene;
  scene.options.policy = contender.policy;
  scene.options.substeps = contender.substeps;
  scene.dt = contender.dt;
  const double duration = comparison.scene.duration(), steps = duration / contender.dt, whole = std::round(steps);
  // At most five roundings, of 0.5 epsilon each, part a step that divides the duration from a whole number of steps.
  const bool divides = std::abs(steps - whole) <= 2.5 * std::numeric_limits<double>::epsilon() * whole;
  scene.steps = static_cast<std::int64_t>(divides ? whole : std::ceil(steps));
  if (!divides) scene.last_dt = duration - static_cast<double>(scene.steps - 1) * contender.dt;
  return scene;
}

std::optional<double> Trial::met(std::uint32_t first, std::uint32_t second) const {
  const auto ids = [](const Meeting& m) { return std::pair(m.first, m.second); };
  const auto found = std::ranges::lower_bound(meetings, std::pair(first, second), {}, ids);
  return found != meetings.end() && ids(*found) == std::pair(first, second) ? std::optional(found->time) : std::nullopt;
}

bool Trial::same_outcome(const Trial& other) const {
  return meetings == other.meetings && went_through() == other.went_through() && counts.hits == other.counts.hits &&
         hash == other.hash;
}

Trial run_trial(const Scene& scene) {
  Trial trial;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> meetings;
  const Playback playback = play(scene, [&meetings](const World& world) {
    for (const CollisionEvent& event : world.events().events()) {
      if (event.kind == CollisionEventKind::begin) meetings.try_emplace({event.first, event.second}, event.time);
    }
  });
  for (const auto& [ids, time] : meetings) trial.meetings.push_back({ids.first, ids.second, time});
  trial.tunneled = playback.all_missed;
  trial.counts = playback.sums().counts;
  trial.energy = playback.energy;
  trial.energy_end = playback.rows.back().energy;
  trial.hash = playback.hash;
  trial.seconds = playback.phases.back().total;
  return trial;
}

Contest contest(const Contender& contender, const std::vector<Trial>& repeats, const Trial& exact, double last_step) {
  Contest out;
  out.contender = contender;
  out.trial = repeats.front();
  for (const Trial& repeat : repeats) {
    out.seconds.push_back(repeat.seconds);
    out.repeated_alike &= repeat.same_outcome(out.trial);
  }
  for (const auto& [first, second, time] : exact.meetings) {
    if (const auto here = out.trial.met(first, second)) {
      ++out.met;
      out.errors.push_back(std::abs(*here - time));
    } else if (time <= last_step) {
      ++out.unmet;
    }
  }
  out.extra = static_cast<std::int64_t>(out.trial.meetings.size()) - out.met;
  std::sort(out.errors.begin(), out.errors.end());
  return out;
}

namespace {

std::optional<double> median_error(const Contest& c) {
  return c.errors.empty() ? std::nullopt : std::optional(median(c.errors));
}
std::optional<double> largest_error(const Contest& c) {
  return c.errors.empty() ? std::nullopt : std::optional(c.errors.back());
}

/// [s] of stepping one second of the scene.
double cost(const Contest& c, double duration) { return median(c.seconds) / duration; }

/// The fastest that let nothing through, and if `all_met`, met every pair.
const Contest* cheapest_clean(const std::vector<Contest>& contests, bool all_met) {
  const Contest* best = nullptr;
  for (const Contest& c : contests) {
    if (c.trial.went_through() > 0 || (all_met && c.unmet > 0)) continue;
    if (!best || median(c.seconds) < median(best->seconds)) best = &c;
  }
  return best;
}

std::string answer_text(const Comparison& comparison, const Trial& exact, const std::vector<Contest>& contests) {
  std::string text = fmt::format("In {} s the exact run of '{}' has {} of bodies that meet. ",
                                 rounded_text(comparison.scene.duration(), 4), comparison.scene.name,
                                 plural_text(std::ssize(exact.meetings), "pair"));
  for (const Contest& c : contests) {
    if (c.contender.policy != TimePolicy::discrete || c.contender.dt != contests.back().contender.dt) continue;
    text += fmt::format(
        "Looking only at the end of steps of {} ms leaves {} unseen and pushes {} through; {} of the exact run's "
        "pairs never meet. ",
        rounded_text(1e3 * c.contender.dt, 4), plural_text(c.trial.tunneled, "contact"),
        grouped_text(c.trial.counts.pushed_through), grouped_text(c.unmet));
  }
  const Contest* const all_met = cheapest_clean(contests, true);
  const Contest* const best = all_met ? all_met : cheapest_clean(contests, false);
  if (!best) return text + "None of the ways compared lets nothing through.";
  text += fmt::format("The fastest that lets nothing through{} is {} at {} ms: {} ms of run time a second of the scene",
                      all_met && best->met > 0 ? " and meets every pair" : "", best->contender.label(),
                      rounded_text(1e3 * best->contender.dt, 4),
                      rounded_text(1e3 * cost(*best, comparison.scene.duration()), 3));
  if (!all_met)
    return text + ". No way meets every pair that the exact run does: after enough bounces any two runs part.";
  if (best->met == 0) return text + ".";
  return text + fmt::format(", first meetings off by {} ms at most.", rounded_text(1e3 * best->errors.back(), 3));
}

Columns<Contest> key_columns() {
  return columns_of<Contest>(text("policy", "Time policy; substeps_N tests N poses a step.",
                                  [](const Contest& c) { return c.contender.label(); }),
                             value("dt", "s", "Step.", [](const Contest& c) { return c.contender.dt; }));
}

auto run_time_column(double duration) {
  return value("seconds", "1", "Run time over time of the scene: median of the repeats.",
               [duration](const Contest& c) { return cost(c, duration); });
}

Columns<Contest> compare_columns() {
  return columns_of<Contest>(
      key_columns(), fields(&Contest::trial, {"tunneled", "pushed_through"}),
      value("met", "1", "Pairs of bodies that met here and in the exact run.", &Contest::met),
      value("unmet", "1", "Pairs that met in the exact run alone, in time for this one to see it.", &Contest::unmet),
      value("extra", "1", "Pairs that met here alone.", &Contest::extra),
      value("error_median", "s", "Between the first meetings of a pair here and there: median over pairs.",
            median_error),
      value("error_largest", "s", "The same: the largest.", largest_error), fields(&Contest::trial, {"hits", "sweeps"}),
      value("energy_change", "J", "Energy at the end less energy at the start.",
            [](const Contest& c) { return c.trial.energy_end - c.trial.energy; }),
      value("repeated_alike", "", "Every repeat gave the same bits.", &Contest::repeated_alike));
}

Table compare_timings_table(const Comparison& comparison, const std::vector<Contest>& contests) {
  const double duration = comparison.scene.duration();
  return in_report(
      timing(table("timings", "Run time of stepping one second of the scene, each contender on one thread.", contests,
                   key_columns(), run_time_column(duration),
                   value("seconds_least", "1", "The shortest of the repeats.",
                         [duration](const Contest& c) { return std::ranges::min(c.seconds) / duration; }),
                   value("seconds_most", "1", "The longest.",
                         [duration](const Contest& c) { return std::ranges::max(c.seconds) / duration; }))));
}

/// What the pictures show of each.
Table drawn_table(const Comparison& comparison, const std::vector<Contest>& contests) {
  const double duration = comparison.scene.duration();
  const double least = duration * std::numeric_limits<double>::epsilon();  // [s] a rounding; a logarithm has no zero
  const auto error = [least](const Contest& c) {
    const auto middle = median_error(c);
    return middle ? std::optional(std::max(*middle, least)) : std::nullopt;
  };
  const auto run_time = [duration](const Contest& c) {
    const auto [shortest, longest] = std::ranges::minmax(c.seconds);
    return Measured{cost(c, duration), {shortest / duration, longest / duration}};
  };
  return table("drawn", "", contests, key_columns(),
               value("step", "", "", [](const Contest& c) { return 1e3 * c.contender.dt; }),
               value("went_through", "", "", [](const Contest& c) { return c.trial.went_through(); }),
               value("error", "", "", error), measured("seconds", "", "", run_time));
}

/// Contacts that went unseen or through and time error against the step, one series a policy.
Figure compare_figure(const Comparison& comparison, const std::vector<Contest>& contests) {
  Plot by_step = plot(drawn_table(comparison, contests)).x("step", Axis::log, "step [ms]").by("policy");
  const Panel through = by_step.y("went_through", Axis::linear, "contacts unseen or pushed through [1]");
  return {
      .name = "compare",
      .title = "Discrete or swept, on this scene",
      .caption =
          "Above: contacts that went unseen, or ended in a push the way they were going; "
          "policies without any take turns on the zero line. Below: the median "
          "over pairs of how far their first meeting is from the exact run's; errors below a rounding of the duration "
          "are drawn at that.",
      .panels = {taking_turns(through), by_step.y("error", Axis::log, "error of first meetings [s]")}};
}

/// Time error against run time.
Figure error_against_time_figure(const Comparison& comparison, const std::vector<Contest>& contests) {
  return {.name = "error_against_time",
          .title = "What an error of the first meetings costs",
          .caption =
              "Median run time of the repeats against the median error, a point for each step; bars from the "
              "shortest to the longest repeat. A policy that misses a pair altogether has no error for it: see the "
              "table.",
          .panels = {plot(drawn_table(comparison, contests))
                         .x("error", Axis::log, "median error of first meetings [s]")
                         .y("seconds", Axis::log, "run time a second of the scene [s]")
                         .by("policy")},
          .is_timing = true};
}

Outcome outcome_of(const Comparison& comparison, const std::vector<Trial>& trials) {
  const std::size_t count = comparison.contenders.size();
  const Trial& exact = trials.back();
  const double duration = comparison.scene.duration();
  std::vector<Contest> contests;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Trial> repeats;
    for (std::size_t at = i; at + 1 < trials.size(); at += count) repeats.push_back(trials[at]);
    const Scene stepped = scene_for(comparison, comparison.contenders[i]);
    const double last_step = duration - stepped.length_of(stepped.steps);
    contests.push_back(contest(comparison.contenders[i], repeats, exact, last_step));
  }
  Outcome out;
  out.answer = answer_text(comparison, exact, contests);
  const auto bodies = std::ssize(comparison.scene.bodies);
  const Table shown = table(
      "compare",
      fmt::format(
          "{}: {} bod{}, {} s. Exact run: by events, steps of {} ms; {} pairs meet. The last column is seconds of "
          "run time a second of the scene.",
          comparison.scene.name, grouped_text(bodies), bodies == 1 ? "y" : "ies", rounded_text(duration, 4),
          rounded_text(1e3 * comparison.exact.dt, 4), grouped_text(std::ssize(exact.meetings))),
      columns_of<Contest>(compare_columns(), run_time_column(duration)), contests);
  out.summary = terminal(shown, {"policy", "dt", "tunneled", "pushed_through", "met", "unmet", "extra", "error_median",
                                 "error_largest", "seconds"});
  bool held = exact.went_through() == 0;
  for (const Contest& c : contests) {
    held &= c.repeated_alike;
    if (looks_at_all_motion(c.contender.policy, comparison.scene.options.gate)) held &= c.trial.went_through() == 0;
  }
  out.summary += fmt::format("\nSelf-test: {}.\n", verdict_text(held));
  out.tables = {
      in_report(table("compare", "Each time policy and step against the exact run.", compare_columns(), contests)),
      compare_timings_table(comparison, contests)};
  out.figures = {compare_figure(comparison, contests), error_against_time_figure(comparison, contests)};
  out.self_test_passed = held;
  return out;
}

/// A unit for each repeat of each contender, repeats outermost so that they lie apart in time; the exact run last.
std::unique_ptr<Run> configure_compare(const Settings& settings, const RunOptions& options) {
  const auto comparison = std::make_shared<const Comparison>(read_comparison(settings, options));
  std::vector<Task<Trial>> tasks;
  const auto add = [&](const Contender& c, std::string key) {
    tasks.push_back({std::move(key), scene_for(*comparison, c).steps,
                     [comparison, c] { return run_trial(scene_for(*comparison, c)); }});
  };
  for (int repeat = 0; repeat < comparison->repeats; ++repeat) {
    for (const Contender& c : comparison->contenders) add(c, fmt::format("{} {} repeat {}", c.label(), c.dt, repeat));
  }
  add(comparison->exact, fmt::format("exact {}", comparison->exact.dt));
  return make_run([comparison](const Done<Trial>& done) { return outcome_of(*comparison, done.results); },
                  std::move(tasks));
}

}  // namespace

Experiment compare_experiment() {
  return {"compare", "Discrete or swept, on this scene: what is missed, how far off, and at what run time?",
          embedded_toml("scene"), configure_compare};
}

}  // namespace thinwall
