#include <algorithm>

#include <fmt/format.h>

#include <thinwall/experiments/scenes/scene_results.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

std::string policy_text(const Scene& scene) {
  std::string text(name_of(scene.options.policy));
  if (scene.options.policy == TimePolicy::substeps) text += fmt::format(" {}", scene.options.substeps);
  if (scene.options.gate > 0) text += fmt::format(", gate {}", exact_text(scene.options.gate));
  return text;
}

bool looks_at_all_motion(const WorldOptions& options) {
  const bool sweeps = options.policy == TimePolicy::clamp || options.policy == TimePolicy::event_driven;
  return sweeps && options.gate == 0;
}

/// The first lines of the log: who met whom.
std::string log_text(const Scene& scene, const Playback& playback) {
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, playback.events.size()); ++i) {
    const LoggedEvent& e = playback.events[i];
    text += fmt::format("{:>10} s  {} {} {}\n", rounded_text(e.time, 6), name_in(scene, e.first),
                        e.begins ? "meets" : "leaves", name_in(scene, e.second));
  }
  const auto more = playback.all_events - static_cast<std::int64_t>(std::min(most, playback.events.size()));
  if (more > 0) text += fmt::format("{:>12}  {} more in data/events.csv\n", "", grouped_text(more));
  return text.empty() ? "nothing met anything\n" : text;
}

std::string phases_text(const Playback& playback) {
  const double steps = static_cast<double>(playback.rows.size());
  std::string text = fmt::format("{:<12}{:>14}{:>14}{:>9}\n", "phase", "mean [us]", "most [us]", "share");
  for (std::size_t i = 0; i < phase_names.size(); ++i) {
    const PhaseTime& phase = playback.phases[i];
    const double whole = playback.phases.back().total;
    text += fmt::format("{:<12}{:>14.1f}{:>14.1f}{:>8.1f}%\n", phase_names[i], 1e6 * phase.total / steps,
                        1e6 * phase.most, whole > 0 ? 100 * phase.total / whole : 0);
  }
  return text;
}

std::string summary_text(const Scene& scene, const Plan& plan, const Playback& playback) {
  const StepRow sums = playback.sums();
  const auto omitted =
      std::count_if(plan.lines.begin(), plan.lines.end(), [](const PlanLine& line) { return line.omitted; });
  std::string text = fmt::format("{}: {} bodies, {} steps of {} ms, {}\n\n", scene.name,
                                 grouped_text(static_cast<std::int64_t>(scene.bodies.size())),
                                 grouped_text(scene.steps), rounded_text(1e3 * scene.dt, 4), policy_text(scene));
  text += log_text(scene, playback);
  text += fmt::format("\ncontacts begun {:>12}   ended {:>12}   not ended {:>12}\n", grouped_text(sums.begins),
                      grouped_text(sums.ends), grouped_text(playback.live));
  text += fmt::format("pairs found    {:>12}   asked {:>12}   gated     {:>12}\n", grouped_text(sums.pairs),
                      grouped_text(sums.sweeps), grouped_text(sums.gated));
  text += fmt::format("hits           {:>12}   impulses {:>9}   waited    {:>12}\n", grouped_text(sums.hits),
                      grouped_text(sums.impulses), grouped_text(sums.waiting));
  text += fmt::format("tunneled       {:>12}\n", grouped_text(playback.all_missed));
  text += fmt::format("energy         {:>12} J, {} J at the end\n", rounded_text(playback.energy, 6),
                      rounded_text(playback.rows.back().energy, 6));
  text += fmt::format("state hash     {:016x}\n", playback.hash);
  text += fmt::format("broad phase    {}; the plan leaves out {} of {} things ({})\n\n", plan.broad_phase, omitted,
                      plan.lines.size(), plan.full ? "full" : "lean");
  return text + phases_text(playback);
}

}  // namespace

bool claims_held(const Scene& scene, const Playback& playback) {
  const StepRow sums = playback.sums();
  const bool paired = sums.begins - sums.ends == playback.live;
  return paired && (!looks_at_all_motion(scene.options) || playback.all_missed == 0);
}

Outcome scene_outcome(const Scene& scene, const Plan& plan, const Playback& playback) {
  const StepRow sums = playback.sums();
  Outcome out;
  out.answer = fmt::format(
      "In {} s, stepped {} at a time under {}, {} contacts began and {} ended; {} {} through each other "
      "unseen. Energy went from {} J to {} J. State hash {:016x}.",
      rounded_text(scene.duration(), 6), rounded_text(scene.dt, 4) + " s", policy_text(scene),
      grouped_text(sums.begins), grouped_text(sums.ends), grouped_text(playback.all_missed),
      playback.all_missed == 1 ? "pair went" : "pairs went", rounded_text(playback.energy, 6),
      rounded_text(playback.rows.back().energy, 6), playback.hash);
  out.summary = summary_text(scene, plan, playback);
  out.tables = {plan_table(plan),      missed_table(scene, playback), events_table(scene, playback),
                steps_table(playback), bodies_table(scene, playback), phases_table(playback)};
  out.figures = {tracks_figure(scene, playback), course_figure(playback)};
  out.sections = {
      {"What tunneled means here",
       "Between two steps a body that nothing touched moved straight. Of two such bodies, apart before and after, the "
       "closed form says whether they touched on the way. If they did, and the step told no contact of theirs, they went "
       "through each other. Bodies in any contact during a step are not judged against others in that step. Under "
       "substeps gravity bends the way by at most g dt^2 / 8, and a contact less deep than that may be judged wrong."},
      {"Self-test",
       "Every contact that ended had begun, and those that have not ended are as many as the world says. Under "
       "policies that look at all of the motion (clamp, event_driven; no gate) nothing may go through anything."},
      {"Plan", to_text(plan)},
      {"Limits",
       "Bodies do not turn, and there is no friction. Times are of this machine, the scene's threads at work."},
  };
  out.self_test_passed = claims_held(scene, playback);
  return out;
}

}  // namespace thinwall
