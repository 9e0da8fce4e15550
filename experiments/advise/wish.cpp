/// A wish as the user of `thinwall advise` words it, and the run that puts an advice to the test.

#include <fmt/format.h>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/models/shots.hpp>

namespace thinwall {

namespace {

using Word = std::optional<std::string>;

double read(const char* option, const std::string& word, const Range& range) {
  const auto value = parsed<double>(word);
  if (value && contains(range, *value)) return *value;
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

TumblingRod read_rod(const WishWords& words, const Cell& cell) {
  if (!words.length)
    throw UsageError("--spin: a ball looks the same however it spins; of a rod, give --length [m] too");
  constexpr double most_turns = 100;
  const TumblingRod rod = {
      read("--length", *words.length, {.lower = 0, .upper = allowed_radius.upper, .lower_open = true, .unit = "m"}),
      words.spin ? read("--spin", *words.spin, {.lower = 0, .upper = 1e9, .unit = "deg/s"}) : 0};
  if (!(rod.length > 2 * cell.radius)) {
    throw UsageError(fmt::format(
        "--length: a rod {} m long, end to end, is no longer than it is wide, {} m; without --length it is a ball",
        exact_text(rod.length), exact_text(2 * cell.radius)));
  }
  if (!(cell.thickness + 2 * cell.radius > 0))
    throw UsageError("--radius, --thickness: a rod and a wall of no thickness; one of them must be more than 0 m");
  if (rod.spin * cell.step > 360 * most_turns) {
    throw UsageError(fmt::format("--spin {}: in a step of {} s that is {} turns; at most {}", exact_text(rod.spin),
                                 exact_text(cell.step), rounded_text(rod.spin * cell.step / 360, 3), most_turns));
  }
  return rod;
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
  if (words.length || words.spin) wish.rod = read_rod(words, wish.cell);
  return wish;
}

std::string check_config(const Wish& wish, std::span<const Candidate> candidates) {
  if (wish.rod) throw UsageError("--toml: thin_wall fires balls; rods are fired by thinwall run spinning_rod");
  std::string text = config_text(wish, candidates);
  const Experiment thin_wall = thin_wall_experiment();
  try {
    (void)thin_wall.configure(Settings(text, "config", thin_wall.default_toml), {});
  } catch (const UsageError& refusal) {
    const std::string why = refusal.what();
    throw UsageError("--toml: the experiment cannot fire this; " + why.substr(why.find("key ")));
  }
  return text;
}

}  // namespace thinwall
