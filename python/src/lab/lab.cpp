#include "lab.hpp"

#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/models/rods.hpp>
#include <thinwall/experiments/models/shot_methods.hpp>

namespace thinwall {

namespace {

namespace py = pybind11;

// ---- Advice.

using Word = std::optional<std::string>;

Wish wish_of(const std::map<std::string, Word>& words) {
  const auto word = [&](const char* name) {
    const auto found = words.find(name);
    return found == words.end() ? Word() : found->second;
  };
  return read_wish({word("speed"), word("radius"), word("thickness"), word("angle"), word("step"), word("fps"),
                    word("miss"), word("late"), word("length"), word("spin")});
}

/// Every number as JSON, and all of it in words.
std::pair<std::string, std::string> advice(const std::map<std::string, Word>& words) {
  const Advice made = advise(wish_of(words));
  return {advice_json(made).dump(), advice_text(made)};
}

std::string advice_toml(const std::map<std::string, Word>& words) {
  const Wish wish = wish_of(words);
  return check_config(wish, candidates(wish));
}

void bind_advice(py::module_& module) {
  module.def("advice", advice, py::arg("words"), py::call_guard<py::gil_scoped_release>());
  module.def("advice_toml", advice_toml, py::arg("words"), py::call_guard<py::gil_scoped_release>());
}

// ---- Theory.

constexpr Range positive_length = {.lower = 0, .lower_open = true, .unit = "m"};
constexpr Range length = {.lower = 0, .unit = "m"};
constexpr Range any_poses = {.lower = 1, .upper = 1e9};
constexpr Range positive_cosine = {.lower = 0, .upper = 1, .lower_open = true};
constexpr Range any_spin = {.lower = 0, .unit = "rad"};

double in(std::string_view name, const Range& range, double value) {
  if (contains(range, value)) return value;
  throw UsageError(fmt::format("{}: {} is not allowed; {}", name, exact_text(value), range_text("a number", range)));
}

double or_nan(const std::optional<double>& value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }

/// What poses along the way to an infinite wall see of it.
Theory poses_at_wall(double speed, double step, double radius, double thickness, double angle_deg, double poses) {
  const Cell cell = {.speed = in("speed", allowed_speed, speed),
                     .step = in("step", allowed_step, step),
                     .radius = in("radius", allowed_radius, radius),
                     .thickness = in("thickness", allowed_thickness, thickness),
                     .angle_deg = in("angle_deg", allowed_angle, angle_deg),
                     .wall = Wall::infinite,
                     .wall_size = 0};
  if (in("poses", any_poses, poses) != std::floor(poses))
    throw UsageError(fmt::format("poses: {} is not allowed; a whole number >= 1", exact_text(poses)));
  return pose_theory(cell, static_cast<int>(poses));
}

RoundedBox box_of(double x, double y, double z, double radius) {
  return {{in("half_extents", length, x), in("half_extents", length, y), in("half_extents", length, z)},
          in("radius", length, radius)};
}

Vec3<double> unit(double x, double y, double z) {
  const Vec3<double> direction(x, y, z);
  const double norm = direction.stableNorm();
  if (!std::isfinite(norm) || norm == 0) {
    throw UsageError(fmt::format("direction: [{}, {}, {}] is not allowed; finite, and not zero", exact_text(x),
                                 exact_text(y), exact_text(z)));
  }
  return direction / norm;
}

template <class Of> void bind_lateness(py::module_& module, const char* name, Of of, double Lateness::*part) {
  module.def(name, py::vectorize([of, part](double a, double b) { return of(a, b).*part; }));
}

template <class Of> void bind_parts(py::module_& module, const std::string& name, Of of) {
  bind_lateness(module, (name + "_mean").c_str(), of, &Lateness::mean);
  bind_lateness(module, (name + "_deviation").c_str(), of, &Lateness::deviation);
  bind_lateness(module, (name + "_largest").c_str(), of, &Lateness::largest);
}

void bind_theory(py::module_& module) {
  module.def("tunneling_probability", py::vectorize([](double v, double h, double r, double w, double a, double n) {
               return or_nan(poses_at_wall(v, h, r, w, a, n).probability);
             }));
  module.def("through_probability", py::vectorize([](double v, double h, double r, double w, double a, double n) {
               return or_nan(poses_at_wall(v, h, r, w, a, n).through);
             }));
  module.def("miss_probability", py::vectorize([](double chord, double spacing) {
               return miss_probability(in("chord", length, chord), in("spacing", positive_length, spacing));
             }));
  module.def("slab_chord", py::vectorize([](double thickness, double radius, double cosine) {
               return slab_chord(in("thickness", length, thickness), in("radius", length, radius),
                                 in("cosine", positive_cosine, cosine));
             }));
  module.def("volume", py::vectorize([](double x, double y, double z, double radius) {
               return volume(box_of(x, y, z, radius));
             }));
  module.def("shadow", py::vectorize([](double x, double y, double z, double radius, double u, double v, double w) {
               return shadow(box_of(x, y, z, radius), unit(u, v, w));
             }));
  module.def("longest_chord",
             py::vectorize([](double x, double y, double z, double radius, double u, double v, double w) {
               return longest_chord(box_of(x, y, z, radius), unit(u, v, w));
             }));
  module.def(
      "wall_miss_probability",
      py::vectorize([](double x, double y, double z, double radius, double u, double v, double w, double d) {
        return or_nan(miss_probability(box_of(x, y, z, radius), unit(u, v, w), in("spacing", positive_length, d)));
      }));
  module.def("center_ray_miss_probability", py::vectorize([](double x, double y, double z, double radius, double step) {
               return or_nan(center_ray_miss_probability(box_of(x, y, z, radius), in("step", positive_length, step)));
             }));
  bind_parts(module, "pose_lateness", [](double chord, double spacing) {
    return pose_lateness(in("chord", length, chord), in("spacing", positive_length, spacing));
  });
  bind_parts(module, "center_ray_lateness", [](double lead, double step) {
    return center_ray_lateness(in("lead", length, lead), in("step", positive_length, step));
  });
  module.def("rod_miss_probability", py::vectorize([](double clearance, double reach, double step, double spin) {
               return rod_miss_probability(in("clearance", positive_length, clearance), in("reach", length, reach),
                                           in("step", positive_length, step), in("spin", any_spin, spin));
             }));
  module.def("long_step_miss_probability", py::vectorize([](double clearance, double reach, double step) {
               return long_step_miss_probability(in("clearance", positive_length, clearance),
                                                 in("reach", length, reach), in("step", positive_length, step));
             }));
  module.def("blade_miss_probability", py::vectorize([](double window, double spin) {
               return blade_miss_probability(in("window", {.lower = 0, .lower_open = true, .unit = "rad"}, window),
                                             in("spin", {.lower = 0, .lower_open = true, .unit = "rad"}, spin));
             }));
}

/// What the user must mend is a ValueError; the rest is as pybind11 has it.
void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const UsageError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}

}  // namespace

}  // namespace thinwall

PYBIND11_MODULE(_lab, module) {
  pybind11::register_local_exception_translator(thinwall::translate);
  thinwall::bind_advice(module);
  thinwall::bind_run(module);
  thinwall::bind_theory(module);
  thinwall::bind_world(module);
}
