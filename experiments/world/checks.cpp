#include <thinwall/experiments/world/checks.hpp>

#include <algorithm>
#include <cmath>

#include <thinwall/experiments/world/plan.hpp>
#include <thinwall/experiments/world/step/pair_finder.hpp>

namespace thinwall {

bool is_in_the_world(const AnyShape& shape, const Vec3<double>& displacement) {
  const double path = displacement.cwiseAbs().sum();
  return std::visit(
      [&](const auto& held) {
        if constexpr (std::is_same_v<decltype(held), const std::monostate&>) {
          return path <= end_of_the_world;
        } else {
          return magnitude(held) + path <= end_of_the_world;
        }
      },
      shape);
}

void require_valid(const Body& body) {
  const auto complain = [&](const std::string& what) { throw WorldError(called(body) + ": " + what); };
  std::visit(
      [&](const auto& shape) {
        if constexpr (!std::is_same_v<decltype(shape), const std::monostate&>) {
          if (!is_finite(magnitude(shape))) complain("its shape must have finite numbers only");
          if (!has_valid_sizes(shape)) complain("the sizes of its shape must be >= 0");
          if (!valid(shape)) complain("the axes of its box must be unit vectors at right angles");
        }
      },
      body.shape);
  const Vec3<double>& v = body.velocity;
  if (!is_finite(v)) complain("its velocity must be finite");
  if (!is_in_the_world(body.shape, Vec3<double>::Zero())) complain("its place is out of the range of coordinates");
  if (body.is_static && v != Vec3<double>::Zero()) complain("it is static, so that its velocity must be zero");
  if (!(body.mass > 0)) complain("its mass must be > 0; infinite for a body that nothing moves");
  if (!is_finite(1 / body.mass)) complain("its mass is so small that 1 / mass is not finite");
  if (!(body.restitution >= 0 && body.restitution <= 1)) complain("its restitution must be in [0, 1]");
  if (!is_finite(body.gravity_scale)) complain("its gravity scale must be finite");
}

void require_valid(const WorldOptions& options) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw WorldError("world: " + what);
  };
  require(is_finite(options.gravity), "gravity must be finite");
  require(options.substeps >= 1, "substeps must be >= 1");
  require(options.max_events >= 1, "max_events must be >= 1");
  require(options.contact_rounds >= 0, "contact_rounds must be >= 0");
  require(options.correction >= 0 && options.correction <= 1, "correction must be in [0, 1]");
  require(options.end_after >= 1, "end_after must be >= 1");
  require(options.gate >= 0 && is_finite(options.gate), "gate must be finite and >= 0; 0 is off");
  require(options.threads >= 1, "threads must be >= 1");
  require(options.max_pairs >= 1, "max_pairs must be >= 1");
  for (const std::string& kept : options.keep) {
    const auto names = omission_names();
    require(std::find(names.begin(), names.end(), kept) != names.end(), "there is no omission '" + kept + "' to keep");
  }
  if (options.broad_phase == "auto") return;
  std::string names = "auto";
  for (const std::string_view name : PairFinder::names()) {
    if (name == options.broad_phase) return;
    names += ", " + std::string(name);
  }
  require(false, "there is no broad phase '" + options.broad_phase + "'; there are: " + names);
}

std::vector<Body> checked_and_sorted(std::vector<Body> bodies) {
  for (const Body& body : bodies) require_valid(body);
  std::stable_sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) { return a.id < b.id; });
  const auto twins =
      std::adjacent_find(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) { return a.id == b.id; });
  if (twins != bodies.end()) throw WorldError(called(*twins) + " and " + called(*(twins + 1)) + " share one id");
  return bodies;
}

}  // namespace thinwall
