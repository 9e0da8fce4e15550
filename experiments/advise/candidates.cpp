#include <thinwall/experiments/advise/candidates.hpp>

#include <algorithm>
#include <array>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/thin_wall/model.hpp>
#include <thinwall/experiments/timing/interleaved.hpp>
#include <thinwall/swept/certified.hpp>

namespace thinwall {

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

}  // namespace thinwall
