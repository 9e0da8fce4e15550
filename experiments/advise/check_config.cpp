#include <thinwall/experiments/advise/check_config.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/advise/words.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>

namespace thinwall {

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
