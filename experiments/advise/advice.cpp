#include <thinwall/experiments/advise/advice.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/thin_wall/model.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>
#include <thinwall/swept/certified.hpp>

namespace thinwall {

namespace {

double lateness(const AdviceRow& row) {
  return row.theory.largest_lateness().value_or(std::numeric_limits<double>::infinity());
}

/// Of the first `meeting` rows, which are sorted by cost, the advised one comes first.
void put_advised_first(std::vector<AdviceRow>& rows, std::ptrdiff_t meeting) {
  if (meeting == 0) return;
  const double noise = rows.front().cost.dearer().spread.upper;
  const auto tied = std::find_if(rows.begin(), rows.begin() + meeting,
                                 [&](const AdviceRow& row) { return row.cost.dearer().spread.lower > noise; });
  const auto least_late = std::min_element(
      rows.begin(), tied, [](const AdviceRow& a, const AdviceRow& b) { return lateness(a) < lateness(b); });
  std::rotate(rows.begin(), least_late, least_late + 1);
}

}  // namespace

bool meets_wish(const Wish& wish, const Theory& theory) {
  if (!theory.probability || *theory.probability > wish.miss + no_chance) return false;
  const std::optional<double> latest = theory.largest_lateness();
  return !wish.late || (latest && *latest <= *wish.late * (1 + no_chance));
}

std::optional<double> longest_step(const Wish& wish, const std::function<Theory(const Cell&)>& theory) {
  const auto met = [&](double step) {
    Cell cell = wish.cell;
    cell.step = step;
    return meets_wish(wish, theory(cell));
  };
  constexpr double shortest = 1e-30;
  if (met(allowed_step.upper)) return allowed_step.upper;
  if (!met(shortest)) return std::nullopt;
  auto good = std::bit_cast<std::uint64_t>(shortest), bad = std::bit_cast<std::uint64_t>(allowed_step.upper);
  while (bad - good > 1) {  // positive doubles are in the order of their bits
    const std::uint64_t middle = good + (bad - good) / 2;
    (met(std::bit_cast<double>(middle)) ? good : bad) = middle;
  }
  return std::bit_cast<double>(good);
}

Advice advise(const Wish& wish, std::span<const Candidate> candidates, std::span<const StepCost> costs) {
  Advice advice = {wish, {}};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Theory theory = candidates[i].theory(wish.cell);
    advice.rows.push_back(
        {candidates[i], theory, costs[i], meets_wish(wish, theory), longest_step(wish, candidates[i].theory)});
  }
  std::stable_sort(advice.rows.begin(), advice.rows.end(), [](const AdviceRow& a, const AdviceRow& b) {
    return std::tuple(!a.meets, a.cost.dearer().median) < std::tuple(!b.meets, b.cost.dearer().median);
  });
  put_advised_first(advice.rows, std::count_if(advice.rows.begin(), advice.rows.end(),
                                               [](const AdviceRow& row) { return row.meets; }));
  return advice;
}

namespace {

using Word = std::optional<std::string>;

double read(const char* option, const std::string& word, const Range& range) {
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc{} && stop == end && contains(range, value)) return value;
  throw UsageError(fmt::format("{}: '{}' is not allowed; {}", option, one_line(word), range_text("a number", range)));
}

double needed(const char* option, const Word& word, const Range& range) {
  if (!word) throw UsageError(fmt::format("{} is missing; {}", option, range_text("a number", range)));
  return read(option, *word, range);
}

double read_step(const Word& step, const Word& fps) {
  if (step && fps) throw UsageError("--step and --fps say the same thing twice; give one of them");
  if (!step && !fps) {
    throw UsageError("--step [s] or --fps [1/s] is missing; how long is a step, or how many are there a second?");
  }
  if (step) return read("--step", *step, allowed_step);
  return 1 / read("--fps", *fps, {.lower = 1 / allowed_step.upper, .upper = 1e12, .unit = "1/s"});
}

}  // namespace

Wish read_wish(const WishWords& words) {
  Wish wish = {.cell = {.speed = needed("--speed", words.speed, allowed_speed),
                        .step = 0,
                        .radius = needed("--radius", words.radius, allowed_radius),
                        .thickness = needed("--thickness", words.thickness, allowed_thickness),
                        .angle_deg = words.angle ? read("--angle", *words.angle, allowed_angle) : 0,
                        .wall = Wall::infinite,
                        .wall_size = 0}};
  wish.cell.step = read_step(words.step, words.fps);
  constexpr double shortest = 1e-30;  // float holds the poses of the shots that are timed
  if (step_length(wish.cell) < shortest) {
    throw UsageError(fmt::format("--speed {}: in a step of {} s the ball moves {} m; at least {} m is needed",
                                 exact_text(wish.cell.speed), exact_text(wish.cell.step),
                                 rounded_text(step_length(wish.cell), 3), exact_text(shortest)));
  }
  if (words.miss) wish.miss = read("--miss", *words.miss, {.lower = 0, .upper = 1});
  if (words.late) wish.late = read("--late", *words.late, {.lower = 0, .unit = "m"});
  return wish;
}

namespace {

/// Steps of the shots that the thin wall fires, `back` steps before the one in which the ball touches.
std::vector<ShotStep> steps_before(const Cell& cell, std::int64_t count, double back) {
  const Target aimed = target(cell);
  const RandomStream stream = random_stream(cell, 0);
  std::vector<ShotStep> steps;
  for (std::int64_t i = 0; i < count; ++i) {
    const Vec3<double> start = random_start(aimed, stream, static_cast<std::uint64_t>(i)) - back * aimed.displacement;
    steps.push_back({{Sphere<double>{start, aimed.radius}, aimed.displacement},
                     at_rest(Aabb<double>{Vec3<double>::Zero(), aimed.half_extents})});
  }
  return steps;
}

std::vector<QueryTime> timed(std::span<const Candidate> candidates, const std::vector<ShotStep>& steps,
                             const TimingEffort& effort, const RandomStream& stream) {
  std::vector<TimedLoop<ShotStep>> loops;
  for (const Candidate& candidate : candidates) loops.push_back({candidate.ask});
  run_rounds(loops, std::span<const ShotStep>(steps), effort.rounds, effort.round_ns, stream);
  std::vector<QueryTime> times;
  for (const TimedLoop<ShotStep>& loop : loops) {
    times.push_back({median(loop.nanoseconds), bootstrap_median(loop.nanoseconds, stream)});
  }
  return times;
}

}  // namespace

std::vector<StepCost> measure_costs(const Cell& cell, std::span<const Candidate> candidates,
                                    const TimingEffort& effort) {
  // The same geometry, a step a second; a step too short for the grid of the poses is timed as a longer one.
  Cell even = cell;
  even.speed = 1;
  even.step = std::max(step_length(cell), 1e-4 * slab_chord(cell));
  const auto clear = timed(candidates, steps_before(even, effort.queries, 1), effort, {0, 1});
  const auto contact = timed(candidates, steps_before(even, effort.queries, 0), effort, {0, 2});
  std::vector<StepCost> costs;
  for (std::size_t i = 0; i < candidates.size(); ++i) costs.push_back({clear[i], contact[i]});
  return costs;
}

namespace {

/// What a certified answer promises, lower end first: no contact before it, and contact within 2^-26 of it.
Theory certified_theory(const Cell& cell) {
  Theory theory = early_theory(cell, 0x1p-26);
  theory.why = "0: the verdict is proven";
  return theory;
}

void ask_certified(std::span<const ShotStep> steps) {
  for (const ShotStep& step : steps) keep(certified_time_of_impact(step.ball, step.wall));
}

}  // namespace

std::vector<std::int64_t> offered_poses(const Wish& wish) {
  std::vector<std::int64_t> poses = {2, 8};
  const auto meets = [&](int n) { return meets_wish(wish, pose_theory(wish.cell, n)); };
  if (meets(1) || !meets(most_substeps)) return poses;  // nobody needs them, or they are of no use
  int fewer = 1, enough = most_substeps;
  while (enough - fewer > 1) {
    const int middle = (fewer + enough) / 2;
    (meets(middle) ? enough : fewer) = middle;
  }
  if (std::find(poses.begin(), poses.end(), enough) == poses.end()) poses.push_back(enough);
  std::sort(poses.begin(), poses.end());
  return poses;
}

std::vector<Candidate> candidates(const Wish& wish) {
  const std::vector<std::string_view> names = method_names();
  const std::vector<std::string> methods(names.begin(), names.end());
  const std::array<std::string, 1> scalars = {"double"};
  std::vector<Candidate> all;
  for (const ThinWallMethod& m : thin_wall_methods(methods, offered_poses(wish), scalars)) {
    all.push_back({m.name, m.poses_per_step, true, m.theory, m.ask});
  }
  all.push_back({"certified", 0, false, certified_theory, ask_certified});
  return all;
}

namespace {

/// Enough to see a chance as small as the wish's 100 times; 1e5 otherwise.
std::int64_t shots_for(double miss) {
  constexpr double least = 1e5, most = 1e7;
  return miss > 0 ? std::llround(std::clamp(100 / miss, least, most)) : std::llround(least);
}

std::string expectations(const Wish& wish, std::span<const Candidate> candidates) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    if (!candidate.fired) continue;
    const Theory theory = candidate.theory(wish.cell);
    const auto latest = theory.largest_lateness();
    text += fmt::format("#   {:<26}{:<12}{:<14}{}\n", candidate.name,
                        theory.probability ? percent_text(*theory.probability) : "no formula",
                        latest ? rounded_text(*latest, 3) + " m" : "-", meets_wish(wish, theory) ? "yes" : "no");
  }
  return text;
}

}  // namespace

std::string check_config(const Wish& wish, std::span<const Candidate> candidates) {
  const Cell& cell = wish.cell;
  std::vector<std::string> methods;
  for (const std::string_view name : method_names()) methods.push_back(fmt::format("\"{}\"", name));
  std::string text = fmt::format(
      "{}\n#\n# Wanted: {}.\n# Expected:                    tunnel      seen late by  meets the wish\n{}"
      "# Every run fires the bullet of the textbook as well.\n"
      "experiment = \"thin_wall\"\nshots = {}\n\nspeed = [{}]  # [m/s]\nstep = [{}]  # [s]\n"
      "angle_deg = [{}]  # [deg]\nradius = [{}]  # [m]\nthickness = [{}]  # [m]\nwall = [\"infinite\"]\n\n",
      check_config_title, wanted_words(wish), expectations(wish, candidates), shots_for(wish.miss),
      exact_text(cell.speed), exact_text(cell.step), exact_text(cell.angle_deg), exact_text(cell.radius),
      exact_text(cell.thickness));
  text += fmt::format("method = [{}]\nsubsteps = [{}]  # poses a step\nscalar = [\"double\"]\n",
                      fmt::join(methods, ", "), fmt::join(offered_poses(wish), ", "));
  const Experiment thin_wall = thin_wall_experiment();
  try {
    make_plan(Settings(text, "config", thin_wall.default_toml), {});
  } catch (const UsageError& refusal) {
    const std::string why = refusal.what();
    throw UsageError("--toml: the experiment cannot fire this; " + why.substr(why.find("key ")));
  }
  return text;
}

}  // namespace thinwall
