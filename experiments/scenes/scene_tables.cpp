#include <algorithm>
#include <functional>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/scenes/scene_results.hpp>

namespace thinwall {

namespace {

double share_of(double part, std::size_t whole) { return whole == 0 ? 0 : part / static_cast<double>(whole); }

/// Who met whom.
template <class Row> Columns<Row> pair_columns(const Scene& scene) {
  return columns_of<Row>(
      text("first", "The body with the lower id.", [&scene](const Row& row) { return name_in(scene, row.first); }),
      text("second", "The other.", [&scene](const Row& row) { return name_in(scene, row.second); }));
}

}  // namespace

std::string name_in(const Scene& scene, std::uint32_t id) {
  const auto found = std::ranges::find(scene.bodies, id, &Body::id);
  const bool named = found != scene.bodies.end() && !found->name.empty();
  return named ? found->name : "body " + std::to_string(id);
}

Table steps_table(const Playback& playback) {
  return table("steps", "What each step did.", columns_of<StepRow>(fields(std::identity())), playback.rows);
}

Table events_table(const Scene& scene, const Playback& playback) {
  const auto columns = columns_of<LoggedEvent>(
      value("time", "s", "When they met; of an end, when the step ended.", &LoggedEvent::time),
      value("step", "1", "Number of the step.", &LoggedEvent::step),
      text("event", "begin or end.", [](const LoggedEvent& e) { return e.begins ? "begin" : "end"; }),
      pair_columns<LoggedEvent>(scene));
  Table events = table("events", "Who met whom, and when: begins and ends of contacts, in order; the first 10 000.",
                       columns, playback.events);
  events.in_report = events.rows.size() <= 40;
  return events;
}

Table missed_table(const Scene& scene, const Playback& playback) {
  const auto columns = columns_of<MissedContact>(fields(std::identity(), {"time"}), pair_columns<MissedContact>(scene));
  Table missed = table("tunneled", "Who went through whom unseen, and when they first touched; the first 10 000.",
                       columns, playback.missed);
  missed.in_report = missed.rows.size() <= 40;
  return missed;
}

Table bodies_table(const Scene& scene, const Playback& playback) {
  std::vector<std::pair<std::int64_t, std::string>> names;  // by id, for a scene of many
  for (const Body& body : scene.bodies) names.emplace_back(body.id, body.name);
  std::ranges::sort(names);
  const auto name = [&names](const FinalPlace& place) {
    const auto found = std::ranges::lower_bound(names, std::pair<std::int64_t, std::string>(place.id, ""));
    return found == names.end() ? "" : found->second;
  };
  return table("bodies", "Where each body is at the end.",
               columns_of<FinalPlace>(fields(std::identity(), {"id"}), text("name", "Name.", name),
                                      fields(std::identity(), {"x", "y", "z"})),
               playback.places);
}

Table plan_table(const Plan& plan) {
  const auto columns = columns_of<PlanLine>(text("what", "A thing that a step might do.", &PlanLine::what),
                                            value("omitted", "", "It is left out.", &PlanLine::omitted),
                                            text("why", "The proof, or why it is needed.", &PlanLine::why));
  return in_report(table("plan", "What the scene needs, what was left out, and why that changes nothing.", columns,
                         std::vector<PlanLine>(plan.lines.begin(), plan.lines.end())));
}

Table phases_table(const Playback& playback) {
  struct Row {
    std::string_view phase;
    PhaseTime time;
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < phase_names.size(); ++i) rows.push_back({phase_names[i], playback.phases[i]});
  const double whole = playback.phases.back().total;
  const auto columns =
      columns_of<Row>(text("phase", "Part of a step; `step` is all of it.", &Row::phase),
                      value("mean_us", "us", "Mean over the steps.",
                            [&](const Row& row) { return 1e6 * share_of(row.time.total, playback.rows.size()); }),
                      value("most_us", "us", "The longest.", [](const Row& row) { return 1e6 * row.time.most; }),
                      value("share", "1", "Part of the whole step.",
                            [whole](const Row& row) { return whole > 0 ? row.time.total / whole : 0.0; }));
  return in_report(timing(table("timings", "Time a step by phase, on this machine.", columns, rows)));
}

}  // namespace thinwall
