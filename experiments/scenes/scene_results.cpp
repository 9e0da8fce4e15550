#include <thinwall/experiments/scenes/scene.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// What a body is called, by its id.
std::string name_in(const Playback& playback, std::uint32_t id) {
  const auto found = std::ranges::lower_bound(playback.places, std::int64_t{id}, {}, &FinalPlace::id);
  const bool named = found != playback.places.end() && found->id == id && !found->name.empty();
  return named ? found->name : "body " + std::to_string(id);
}

std::string policy_text(const Scene& scene) {
  std::string text(name_of(scene.options.policy));
  if (scene.options.policy == TimePolicy::substeps) text += fmt::format(" {}", scene.options.substeps);
  if (scene.options.gate > 0) text += fmt::format(", gate {}", exact_text(scene.options.gate));
  return text;
}

/// The first lines of the log: who met whom.
std::string log_text(const Playback& playback) {
  const std::size_t shown = std::min<std::size_t>(12, playback.events.size());
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    const LoggedEvent& e = playback.events[i];
    text += fmt::format("{:>10} s  {} {} {}\n", rounded_text(e.time, 6), name_in(playback, e.first),
                        e.begins ? "meets" : "leaves", name_in(playback, e.second));
  }
  const auto more = static_cast<std::int64_t>(playback.events.size() - shown);
  const std::int64_t lost = playback.all_events - std::ssize(playback.events);
  if (more > 0) text += fmt::format("{:>12}  {} more in data/events.csv\n", "", grouped_text(more));
  if (lost > 0) text += fmt::format("{:>12}  {} after them in no file\n", "", grouped_text(lost));
  return text.empty() ? "nothing met anything\n" : text;
}

Table phases_table(const Playback& playback) {
  struct Row {
    std::string_view phase;
    PhaseTime time;
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < phase_names.size(); ++i) rows.push_back({phase_names[i], playback.phases[i]});
  const double whole = playback.phases.back().total;
  const auto columns = columns_of<Row>(
      text("phase", "Part of a step; `step` is all of it.", &Row::phase),
      value("mean_us", "us", "Mean over the steps.",
            [&](const Row& row) { return 1e6 * share_of(row.time.total, playback.rows.size()).value_or(0); }),
      value("most_us", "us", "The longest.", [](const Row& row) { return 1e6 * row.time.most; }),
      value("share", "1", "Part of the whole step.",
            [whole](const Row& row) { return share_of(row.time.total, whole).value_or(0); }));
  return in_report(timing(table("timings", "Time a step by phase, on this machine.", columns, rows)));
}

std::string summary_text(const Scene& scene, const Plan& plan, const Playback& playback) {
  const StepRow sums = playback.sums();
  const auto omitted =
      std::count_if(plan.lines.begin(), plan.lines.end(), [](const PlanLine& line) { return line.omitted; });
  std::string text = fmt::format("{}: {} {}, {} of {} ms, {}\n\n", scene.name, grouped_text(std::ssize(scene.bodies)),
                                 scene.bodies.size() == 1 ? "body" : "bodies", plural_text(scene.steps, "step"),
                                 rounded_text(1e3 * scene.dt, 4), policy_text(scene));
  text += log_text(playback);
  text += fmt::format("\ncontacts begun {:>12}   ended {:>12}   not ended {:>12}\n", grouped_text(sums.begins),
                      grouped_text(sums.ends), grouped_text(playback.live));
  text += fmt::format("pairs found    {:>12}   asked {:>12}   gated     {:>12}\n", grouped_text(sums.counts.pairs),
                      grouped_text(sums.counts.sweeps), grouped_text(sums.counts.gated));
  text += fmt::format("hits           {:>12}   impulses {:>9}   waited    {:>12}\n", grouped_text(sums.counts.hits),
                      grouped_text(sums.counts.impulses), grouped_text(sums.counts.waiting));
  text += fmt::format("tunneled       {:>12}   pushed through {:>3}\n", grouped_text(playback.all_missed),
                      grouped_text(sums.counts.pushed_through));
  text += fmt::format("energy         {:>12} J, {} J at the end\n", rounded_text(playback.energy, 6),
                      rounded_text(playback.rows.back().energy, 6));
  text += fmt::format("state hash     {:016x}\n", playback.hash);
  text += fmt::format("broad phase    {}; the plan leaves out {} of {} things ({})\n\n", plan.broad_phase, omitted,
                      plan.lines.size(), plan.full ? "full" : "lean");
  return text + terminal(phases_table(playback));
}

/// Who met whom.
template <class Row> Columns<Row> pair_columns(const Playback& playback) {
  return columns_of<Row>(
      text("first", "The body with the lower id.", [&](const Row& row) { return name_in(playback, row.first); }),
      text("second", "The other.", [&](const Row& row) { return name_in(playback, row.second); }));
}

Table in_report_if_short(Table table) {
  table.in_report = table.rows.size() <= 40;
  return table;
}

Table events_table(const Playback& playback) {
  return in_report_if_short(
      table("events", "Who met whom, and when: begins and ends of contacts, in order; the first 10 000.",
            playback.events, value("time", "s", "When they met; of an end, when the step ended.", &LoggedEvent::time),
            value("step", "1", "Number of the step.", &LoggedEvent::step),
            text("event", "begin or end.", [](const LoggedEvent& e) { return e.begins ? "begin" : "end"; }),
            pair_columns<LoggedEvent>(playback)));
}

Table missed_table(const Playback& playback) {
  return in_report_if_short(table("tunneled", "Who touched whom unseen, and when; the first 10 000.", playback.missed,
                                  fields(std::identity(), {"time"}), pair_columns<Meeting>(playback)));
}

/// Of records that say all of it.
template <class Row> Table records_table(const char* name, const char* description, const std::vector<Row>& rows) {
  return table(name, description, columns_of<Row>(fields(std::identity())), rows);
}

Table plan_table(const Plan& plan) {
  const auto columns = columns_of<PlanLine>(text("what", "A thing that a step might do.", &PlanLine::what),
                                            value("omitted", "", "It is left out.", &PlanLine::omitted),
                                            text("why", "The proof, or why it is needed.", &PlanLine::why));
  return in_report(table("plan", "What the scene needs, what was left out, and why that changes nothing.", columns,
                         std::vector<PlanLine>(plan.lines.begin(), plan.lines.end())));
}

constexpr std::size_t most_outlines = 400;
constexpr std::size_t most_marks = 1500;  // more would be a blot: then lines
constexpr std::size_t most_named = 8;     // tracks in the legend; the others share one entry

using Point = Eigen::Vector2d;  ///< [m] of the picture
using Window = Eigen::AlignedBox2d;

Point seen(const Scene& scene, const Vec3<double>& at) { return {at[scene.across], at[scene.up]}; }

/// Where anything moved, with room for the bodies themselves and a fifth more on each side.
Window window_of(const Scene& scene, const Playback& playback) {
  Window window;
  for (const Track& track : playback.tracks) {
    const auto body = std::ranges::find(scene.bodies, track.id, &Body::id);
    const Point half = seen(scene, box_of(*body).half_extents);
    for (std::size_t i = 0; i < track.x.size(); ++i) {
      const Point at = {track.x[i], track.y[i]};
      window.extend(at - half).extend(at + half);
    }
  }
  const Point room = 0.2 * window.sizes();
  return {window.min() - room, window.max() + room};
}

/// The part of a segment within the window, appended with a gap before it. Source: Liang and Barsky, 1984.
void append_clipped(Series& series, const Window& w, const Point& a, const Point& b) {
  double from = 0, to = 1;
  for (const int axis : {0, 1}) {
    const double start = a[axis], change = b[axis] - start, low = w.min()[axis], high = w.max()[axis];
    if (change == 0) {
      if (start < low || high < start) return;
      continue;
    }
    from = std::max(from, ((change > 0 ? low : high) - start) / change);
    to = std::min(to, ((change > 0 ? high : low) - start) / change);
  }
  if (from > to) return;
  series.end_line();
  for (const double t : {from, to}) series.add(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]));
}

/// The twelve edges of a box: its corners differ along one axis.
void append_edges(Series& series, const Window& w, const Scene& scene, const Obb<double>& box) {
  const auto corner = [&](unsigned which) {
    Vec3<double> at = box.center;
    for (unsigned i = 0; i < 3; ++i) {
      const double side = (which >> i & 1U) != 0 ? 1 : -1;
      at += side * box.half_extents[static_cast<int>(i)] * box.axes.col(static_cast<int>(i));
    }
    return seen(scene, at);
  };
  for (unsigned from = 0; from < 8; ++from) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((from >> axis & 1U) == 0) append_clipped(series, w, corner(from), corner(from | 1U << axis));
    }
  }
}

/// The edges of what stays, where they are in the window; of what is round, those of the box that holds it. `drawn` counts them, one more than
/// are drawn where that is not all.
Series outlines(const Scene& scene, const Window& window, std::size_t& drawn) {
  Series series = {.label = "at rest", .mark = Mark::line, .color = "#888888"};
  for (const Body& body : scene.bodies) {
    if (!body.is_static || std::holds_alternative<std::monostate>(body.shape)) continue;
    const std::size_t before = series.x.size();
    const Aabb<double> upright = box_of(body);
    const auto* const turned = std::get_if<Obb<double>>(&body.shape);
    append_edges(series, window, scene,
                 turned ? *turned : Obb<double>{upright.center, upright.half_extents, Mat3<double>::Identity()});
    if (series.x.size() == before || ++drawn <= most_outlines) continue;
    series.x.resize(before);  // one too many
    series.y.resize(before);
    break;
  }
  return series;
}

/// [1] How many points of each track are drawn: all, or as many as keep the ways together below 50 diagonals of the window. More would cover
/// each other.
std::size_t points_drawn(const Playback& playback, const Window& window) {
  if (playback.tracks.empty()) return 0;
  const std::size_t all = playback.tracks.front().x.size();
  std::size_t points = 1;
  for (double way = 0; points < all && way <= 50 * window.diagonal().norm(); ++points) {
    for (const auto& [id, x, y] : playback.tracks)
      way += std::hypot(x[points] - x[points - 1], y[points] - y[points - 1]);
  }
  return points;
}

Figure tracks_figure(const Scene& scene, const Playback& playback) {
  Panel panel = {.x_label = fmt::format("{} [m]", "xyz"[scene.across]),
                 .y_label = fmt::format("{} [m]", "xyz"[scene.up])};
  std::size_t outlined = 0;
  const Window window = window_of(scene, playback);
  panel.series.push_back(outlines(scene, window, outlined));
  if (panel.series.back().x.empty()) panel.series.clear();
  const bool few = playback.tracks.size() <= most_named;
  const std::size_t points = points_drawn(playback, window);
  const Mark mark = points * playback.tracks.size() <= most_marks ? Mark::points : Mark::line;
  for (const Track& track : playback.tracks) {
    if (few || &track == &playback.tracks.front())
      panel.series.push_back({.label = few ? name_in(playback, track.id) : "bodies that move", .mark = mark});
    Series& series = panel.series.back();
    series.end_line();
    for (std::size_t i = 0; i < points; ++i) series.add(track.x[i], track.y[i]);
  }
  const std::int64_t drawn = std::ssize(playback.tracks), all = std::ranges::count_if(scene.bodies, is_drawn);
  const std::int64_t stride = steps_a_point(scene);
  const std::string who = drawn < all
                              ? fmt::format("{} of the {} bodies that move, evenly spread", drawn, grouped_text(all))
                              : "each body that moves";
  const std::string when =
      stride == 1 ? "at the end of each step" : fmt::format("every {} steps", grouped_text(stride));
  std::string caption = fmt::format("The center of {}, {}", who, when);
  if (drawn > 0 && points < playback.tracks.front().x.size()) {
    caption +=
        fmt::format(", until {} s: longer, they would cover each other",
                    rounded_text(static_cast<double>((static_cast<std::int64_t>(points) - 1) * stride) * scene.dt, 3));
  }
  if (outlined > 0) {
    caption += fmt::format("; {} stays, as the box that holds it, cut off at the edge",
                           outlined > most_outlines ? fmt::format("the first {} of what", most_outlines) : "what");
  }
  return {.name = "tracks",
          .title = "Where the bodies were " + when,
          .caption = caption + ".",
          .panels = {std::move(panel)}};
}

Figure course_figure(const Playback& playback) {
  Series energy = {.label = "energy", .mark = Mark::line}, begun = {.label = "contacts begun", .mark = Mark::line};
  Series through = {.label = "tunneled", .mark = Mark::dashes},
         pushed = {.label = "pushed through", .mark = Mark::dashes};
  std::int64_t begins = 0, tunneled = 0, ahead = 0;
  energy.add(0, playback.energy);
  begun.add(0, 0);
  through.add(0, 0);
  pushed.add(0, 0);
  for (const StepRow& row : playback.rows) {
    energy.add(row.time, row.energy);
    begun.add(row.time, static_cast<double>(begins += row.begins));
    through.add(row.time, static_cast<double>(tunneled += row.tunneled));
    pushed.add(row.time, static_cast<double>(ahead += row.counts.pushed_through));
  }
  std::vector<Series> counted = {begun, through};
  if (ahead > 0) counted.push_back(pushed);
  const std::string time = "time [s]";
  return {.name = "course",
          .title = "Energy and contacts over time",
          .caption =
              "Above: kinetic energy and energy of height at the end of each step. Below: contacts that have begun, "
              "and those that went unseen" +
              std::string(ahead > 0 ? ", or pushed a body on through." : "."),
          .panels = {{.x_label = time, .y_label = "energy [J]", .series = {energy}},
                     {.x_label = time, .y_label = "counted so far [1]", .series = std::move(counted)}}};
}

Outcome scene_outcome(const Scene& scene, const Plan& plan, const Playback& playback) {
  const StepRow sums = playback.sums();
  Outcome out;
  out.answer = fmt::format(
      "In {} s, stepped {} at a time under {}, {} began and {} ended; {} more went unseen{}. "
      "Energy went from {} J to {} J. State hash {:016x}.",
      rounded_text(scene.duration(), 6), rounded_text(scene.dt, 4) + " s", policy_text(scene),
      plural_text(sums.begins, "contact"), grouped_text(sums.ends), grouped_text(playback.all_missed),
      sums.counts.pushed_through > 0
          ? fmt::format(", and {} pushed a body on through", grouped_text(sums.counts.pushed_through))
          : "",
      rounded_text(playback.energy, 6), rounded_text(playback.rows.back().energy, 6), playback.hash);
  out.summary = summary_text(scene, plan, playback);
  out.tables = {plan_table(plan),
                missed_table(playback),
                events_table(playback),
                records_table("steps", "What each step did.", playback.rows),
                records_table("bodies", "Where each body is at the end.", playback.places),
                phases_table(playback)};
  out.figures = {tracks_figure(scene, playback), course_figure(playback)};
  out.self_test_passed = claims_held(scene, playback);
  return out;
}

/// One unit: a step needs the one before it.
std::unique_ptr<Run> configure_scene(const Settings& settings, const RunOptions& options) {
  const auto scene = std::make_shared<const Scene>(read_scene(settings, options));
  std::vector<Task<Playback>> tasks = {
      {fmt::format("scene {}", scene->name), scene->steps, [scene] { return play(*scene); }}};
  const auto finish = [scene](const Done<Playback>& done) {
    Outcome out = scene_outcome(*scene, plan(scene->bodies, scene->options), done.results.front());
    if (scene->trace) out.files.push_back({"trace.jsonl", trace_of(*scene)});
    return out;
  };
  return make_run(finish, std::move(tasks));
}

}  // namespace

bool looks_at_all_motion(TimePolicy policy, double gate) { return sweeps(policy) && gate == 0; }

bool claims_held(const Scene& scene, const Playback& playback) {
  const StepRow sums = playback.sums();
  const bool paired = sums.begins - sums.ends == playback.live;
  return paired && (playback.all_missed == 0 || !looks_at_all_motion(scene.options.policy, scene.options.gate));
}

Experiment scene_experiment() {
  return {"scene", "What happens in this scene?", embedded_toml("scene"), configure_scene};
}

}  // namespace thinwall
