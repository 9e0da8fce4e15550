/// A wish as the user of `thinwall advise` words it, and the run that puts an advice to the test.

#include <charconv>

#include <fmt/format.h>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/thin_wall/model.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>

namespace thinwall {

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

std::string check_config(const Wish& wish, std::span<const Candidate> candidates) {
  std::string text = config_text(wish, candidates);
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
