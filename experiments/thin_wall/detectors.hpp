#pragma once
/// Every method of the method list, at every scalar, behind one interface: fire a shot at it, and ask what theory
/// expects of it. A method added to the list appears here by itself; its theory is empty until given in method_theory.hpp.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/thin_wall/bounce.hpp>
#include <thinwall/experiments/thin_wall/shots.hpp>
#include <thinwall/experiments/thin_wall/tally.hpp>
#include <thinwall/experiments/thin_wall/theory.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// One step of a shot, as it is put to a method.
struct ShotStep {
  Moving<Sphere<double>> ball;
  Moving<Aabb<double>> wall;
};

struct Detector {
  std::string method;  ///< the method's name; with the number of poses for `substeps`: substeps_8
  std::string scalar;  ///< "float" or "double"
  int poses_per_step;  ///< [1] that the method tests and nothing else; 0 if it does more
  double round_off;    ///< [1] machine epsilon of the scalar
  std::function<void(const Target&, const Vec3<double>& start, Tally&)> fire;
  std::function<Theory(const Cell&)> theory;
  std::function<void(std::span<const ShotStep>)> ask;  ///< to be timed: asks about each step and keeps no answer
};

std::vector<std::string_view> method_names();
inline constexpr std::array<std::string_view, 2> scalar_names = {"float", "double"};

/// By scalar, then in the order of the method list, then by the number of poses.
std::vector<Detector> detectors(std::span<const std::string> methods, std::span<const std::int64_t> substeps,
                                std::span<const std::string> scalars, Response response = Response::none);

}  // namespace thinwall
