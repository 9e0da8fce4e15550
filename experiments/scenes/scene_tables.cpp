#include <thinwall/experiments/scenes/scene_results.hpp>

#include <algorithm>

#include <thinwall/experiments/scenes/bodies.hpp>

namespace thinwall {

namespace {

using enum ColumnType;

double share(double part, std::size_t whole) { return whole == 0 ? 0 : part / static_cast<double>(whole); }

}  // namespace

std::string name_in(const Scene& scene, std::uint32_t id) {
  const auto found =
      std::find_if(scene.bodies.begin(), scene.bodies.end(), [id](const Body& body) { return body.id == id; });
  const bool named = found != scene.bodies.end() && !found->name.empty();
  return named ? found->name : "body " + std::to_string(id);
}

Table steps_table(const Playback& playback) {
  Table table;
  table.name = "steps";
  table.description = "What each step did.";
  table.columns = {
      {"step", integer, "1", "Number of the step, from 1."},
      {"time", number, "s", "Time at its end."},
      {"pairs", integer, "1", "Pairs whose boxes meet, as the broad phase found them."},
      {"sweeps", integer, "1", "Pairs that were asked, those after a hit included."},
      {"gated", integer, "1", "Of those, tested at an instant because both moved less than the gate."},
      {"hits", integer, "1", "Contacts."},
      {"impulses", integer, "1", "Impulses exchanged."},
      {"waiting", integer, "1", "Bodies that stopped before the end of the step."},
      {"begins", integer, "1", "Contacts that began."},
      {"ends", integer, "1", "Contacts that ended."},
      {"tunneled", integer, "1", "Pairs that went through each other unseen."},
      {"energy", number, "J", "Kinetic, and of height, at its end."},
  };
  for (const StepRow& r : playback.rows) {
    table.rows.push_back({r.step, r.time, r.pairs, r.sweeps, r.gated, r.hits, r.impulses, r.waiting, r.begins, r.ends,
                          r.tunneled, r.energy});
  }
  return table;
}

Table events_table(const Scene& scene, const Playback& playback) {
  Table table;
  table.name = "events";
  table.description = "Who met whom, and when: begins and ends of contacts, in order; the first 10 000.";
  table.in_report = playback.events.size() <= 40;
  table.columns = {
      {"time", number, "s", "When they met; of an end, when the step ended."},
      {"step", integer, "1", "Number of the step."},
      {"event", text, "", "begin or end."},
      {"first", text, "", "The body with the lower id."},
      {"second", text, "", "The other."},
  };
  for (const CollisionEvent& e : playback.events) {
    table.rows.push_back({e.time, static_cast<std::int64_t>(e.step),
                          std::string(e.kind == CollisionEventKind::begin ? "begin" : "end"), name_in(scene, e.first),
                          name_in(scene, e.second)});
  }
  return table;
}

Table missed_table(const Scene& scene, const Playback& playback) {
  Table table;
  table.name = "tunneled";
  table.description = "Who went through whom unseen, and when they first touched; the first 10 000.";
  table.in_report = playback.missed.size() <= 40;
  table.columns = {
      {"time", number, "s", "When they first touched."},
      {"first", text, "", "The body with the lower id."},
      {"second", text, "", "The other."},
  };
  for (const MissedContact& m : playback.missed)
    table.rows.push_back({m.time, name_in(scene, m.first), name_in(scene, m.second)});
  return table;
}

Table bodies_table(const Scene& scene, const Playback& playback) {
  Table table;
  table.name = "bodies";
  table.description = "Where each body is at the end.";
  table.columns = {
      {"id", integer, "1", "Id."},     {"name", text, "", "Name."},     {"x", number, "m", "Of its center."},
      {"y", number, "m", "The same."}, {"z", number, "m", "The same."},
  };
  std::vector<std::pair<std::uint32_t, std::string>> names;  // by id, for a scene of many
  for (const Body& body : scene.bodies) names.emplace_back(body.id, body.name);
  std::sort(names.begin(), names.end());
  for (const auto& [id, at] : playback.places) {
    const auto found = std::lower_bound(names.begin(), names.end(), std::pair<std::uint32_t, std::string>(id, ""));
    table.rows.push_back(
        {static_cast<std::int64_t>(id), found == names.end() ? "" : found->second, at[0], at[1], at[2]});
  }
  return table;
}

Table plan_table(const Plan& plan) {
  Table table;
  table.name = "plan";
  table.description = "What the scene needs, what was left out, and why that changes nothing.";
  table.in_report = true;
  table.columns = {
      {"what", text, "", "A thing that a step might do."},
      {"omitted", boolean, "", "It is left out."},
      {"why", text, "", "The proof, or why it is needed."},
  };
  for (const PlanLine& line : plan.lines) table.rows.push_back({line.what, line.omitted, line.why});
  return table;
}

Table phases_table(const Playback& playback) {
  Table table;
  table.name = "timings";
  table.description = "Time a step by phase, on this machine.";
  table.in_report = true;
  table.is_timing = true;
  table.columns = {
      {"phase", text, "", "Part of a step; `step` is all of it."},
      {"mean_us", number, "us", "Mean over the steps."},
      {"most_us", number, "us", "The longest."},
      {"share", number, "1", "Part of the whole step."},
  };
  const double whole = playback.phases.back().total;
  for (std::size_t i = 0; i < phase_names.size(); ++i) {
    const PhaseTime& phase = playback.phases[i];
    table.rows.push_back({std::string(phase_names[i]), 1e6 * share(phase.total, playback.rows.size()), 1e6 * phase.most,
                          whole > 0 ? phase.total / whole : 0.0});
  }
  return table;
}

}  // namespace thinwall
