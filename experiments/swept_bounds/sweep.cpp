#include <thinwall/experiments/swept_bounds/sweep.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// Exact at the ends, where a sine or cosine would not be.
double cosine(double deg) { return deg == 90 ? 0 : std::cos(deg * (std::numbers::pi / 180)); }
double sine(double deg) { return deg == 90 ? 1 : std::sin(deg * (std::numbers::pi / 180)); }

double nearest(const std::vector<double>& values, double wanted) {
  return *std::min_element(values.begin(), values.end(),
                           [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
}

void check(const Settings& settings, const Sweep& s) {
  if (least_path <= path_in_widths(s) && path_in_widths(s) <= longest_path) return;
  settings.complain("speed", fmt::format("a path of {} to {} widths a step; speed {}, step {}, width {} make {}",
                                         least_path, longest_path, s.speed, s.step, s.width, path_in_widths(s)));
}

std::vector<SweptForm> chosen_forms(const Settings& settings) {
  std::vector<std::string_view> names;
  for (const SweptForm form : all_swept_forms) names.push_back(name(form));
  const std::vector<std::string> chosen = settings.choices("shape", names);
  std::vector<SweptForm> forms;
  for (const SweptForm form : all_swept_forms) {
    if (std::find(chosen.begin(), chosen.end(), name(form)) != chosen.end()) forms.push_back(form);
  }
  return forms;
}

}  // namespace

std::string_view name(SweptForm form) {
  switch (form) {
    case SweptForm::sphere: return "sphere";
    case SweptForm::cube: return "cube";
    case SweptForm::plate: return "plate";
    case SweptForm::rod: return "rod";
  }
  return "";
}

bool is_diagonal(const Sweep& s) { return std::find(diagonals.begin(), diagonals.end(), s) != diagonals.end(); }

std::string key(const Sweep& s) {
  return fmt::format("{} speed {} step {} width {} angle {} turn {} obstacle {}", name(s.form), s.speed, s.step,
                     s.width, s.angle_deg, s.turn_deg, s.obstacle);
}

double path_in_widths(const Sweep& s) { return s.speed * s.step / s.width; }

double ball_radius(const Sweep& s) { return s.obstacle * s.width / 2; }

Vec3<double> half_extents(const Sweep& s) {
  constexpr double thin = 0.1;
  const double half = s.width / 2;
  if (s.form == SweptForm::plate) return {thin * half, half, half};
  if (s.form == SweptForm::rod) return {half, thin * half, thin * half};
  return {half, half, half};
}

Vec3<double> direction(const Sweep& s) {
  const double across = sine(s.angle_deg);
  return {cosine(s.angle_deg), across * cosine(s.turn_deg), across * sine(s.turn_deg)};
}

Vec3<double> path(const Sweep& s) { return direction(s) * (s.speed * s.step); }

Moving<Sphere<double>> moving_ball(const Sweep& s) { return {{Vec3<double>::Zero(), s.width / 2}, path(s)}; }

Moving<Aabb<double>> moving_box(const Sweep& s) { return {{Vec3<double>::Zero(), half_extents(s)}, path(s)}; }

RandomStream random_stream(const Sweep& s, std::uint64_t seed) {
  return {seed, stream_of(std::array{static_cast<double>(s.form), s.speed, s.step, s.width, s.angle_deg, s.turn_deg,
                                     s.obstacle})};
}

SweepPlan make_sweeps(const Settings& settings) {
  const std::vector<SweptForm> forms = chosen_forms(settings);
  const auto speeds = settings.numbers("speed", {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"});
  const double step = settings.number("step", {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"});
  const double width = settings.number("width", {.lower = 1e-9, .upper = 1e3, .unit = "m"});  // its cube is a double
  const auto angles = settings.numbers("angle_deg", {.lower = 0, .upper = 90, .unit = "deg"});
  const auto turns = settings.numbers("turn_deg", {.lower = 0, .upper = 90, .unit = "deg"});
  const auto obstacles = settings.numbers("obstacle", {.lower = 0, .upper = 1000, .unit = "widths"});

  const Sweep& seen = diagonals[1];
  SweepPlan plan = {.cells = {diagonals.begin(), diagonals.end()},
                    .view = {seen.form, nearest(speeds, seen.speed), step, width, nearest(angles, seen.angle_deg),
                             nearest(turns, seen.turn_deg), nearest(obstacles, seen.obstacle)},
                    .timed = {}};
  if (plan.view.angle_deg == 0) plan.view.turn_deg = 0;
  for (const SweptForm form : forms) {
    for (const double speed : speeds) {
      for (const double angle : angles) {
        for (const double turn : turns) {
          for (const double obstacle : obstacles) {
            const Sweep s = {form, speed, step, width, angle, angle == 0 ? 0 : turn, obstacle};
            if (is_diagonal(s) || (angle == 0 && turn != turns.front())) continue;  // is there already
            check(settings, s);
            plan.cells.push_back(s);
          }
        }
      }
      Sweep timed = plan.view;
      timed.form = form;
      timed.speed = speed;
      plan.timed.push_back(timed);
    }
  }
  return plan;
}

}  // namespace thinwall
