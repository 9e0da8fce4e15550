#pragma once
/// A scene as its file describes it: bodies, how they are stepped, for how long, and what is pushed by hand.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/options.hpp>

namespace thinwall {

/// A hand that sets a body's velocity before the first step that begins at `time` or later.
struct Push {
  double time = 0;  ///< [s] >= 0
  std::uint32_t id = 0;
  Vec3<double> velocity = Vec3<double>::Zero();  ///< [m/s]
};

struct Scene {
  std::string name;          ///< letters, digits, _ and -
  std::vector<Body> bodies;  ///< in the order of the file
  WorldOptions options;
  double dt = 0;           ///< [s] > 0
  std::int64_t steps = 0;  ///< >= 1
  std::vector<Push> pushes;
  bool trace = false;
  std::int64_t trace_every = 1;  ///< [1] steps between two frames
  int across = 0, up = 1;        ///< the axes of the picture

  double duration() const { return dt * static_cast<double>(steps); }  ///< [s]
};

/// Throws UsageError: a key out of range, a body or an option that no world can hold.
/// `options.trials` stands for the number of steps, `options.seed` for the copies' random places.
Scene read_scene(const Settings& settings, const RunOptions& options);

/// The policies a scene may name, in the order of TimePolicy.
std::vector<std::string_view> policy_names();
TimePolicy policy_named(std::string_view name);

}  // namespace thinwall
