#include "lab.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <ranges>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/scenes/scene.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

namespace py = pybind11;
using namespace std::chrono_literals;

constexpr auto look = 50ms;  // at Ctrl-C

using Numbers = py::array_t<double>;

Scene scene_of(const std::string& text, const std::string& file, std::uint64_t seed, int threads) {
  Settings settings(text, file, scene_experiment().default_toml);
  settings.reject_unknown_keys();
  settings.require("scene", "its name; without one it is not a scene");
  Scene scene = read_scene(settings, {.seed = seed, .trials = {}});
  scene.options.threads = threads;
  return scene;
}

template <class Rows, class Get> Numbers vectors_of(const Rows& rows, Get get) {
  Numbers out({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  auto to = out.mutable_unchecked<2>();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3<double> vector = get(rows[i]);
    for (int axis = 0; axis < 3; ++axis) to(static_cast<py::ssize_t>(i), axis) = vector[axis];
  }
  return out;
}

template <class T, class Rows, class Get> py::array_t<T> column_of(const Rows& rows, Get get) {
  py::array_t<T> out(static_cast<py::ssize_t>(rows.size()));
  auto to = out.template mutable_unchecked<1>();
  for (std::size_t i = 0; i < rows.size(); ++i) to(static_cast<py::ssize_t>(i)) = static_cast<T>(get(rows[i]));
  return out;
}

/// What steps told.
struct Told {
  std::vector<CollisionEvent> events;
  std::vector<Hit> hits;
};

/// A scene that is stepped as long as somebody asks for it. Calls from several threads wait for each other, for those of many steps
/// until they look for signals.
class SteppedScene {
 public:
  SteppedScene(const std::string& text, const std::string& file, std::uint64_t seed, int threads)
      : scene_(scene_of(text, file, seed, threads)), world_(scene_.bodies, scene_.options) {}

  /// Looks for Ctrl-C between steps; then so many are done, and the world is whole. What was told is kept until another call ends.
  std::vector<CollisionEvent> step(double dt, std::int64_t steps) {
    const py::gil_scoped_release others;
    Told told;
    const auto keep = [&] {
      const std::scoped_lock lock(mutex_);
      told_ = told;
    };
    try {
      take_steps(dt, steps, told);
    } catch (...) {
      keep();
      throw;
    }
    keep();
    return std::move(told.events);
  }

  template <class Read> auto read(Read get) const {
    const std::unique_lock lock = hold();
    return get(*this);
  }

  template <class Change> void change(Change by_hand) {
    const std::unique_lock lock = hold();
    by_hand(world_);
  }

  const Scene& scene() const { return scene_; }
  const World& world() const { return world_; }
  const Told& told() const { return told_; }

 private:
  /// Waits without the GIL: a step that is under way may want it.
  std::unique_lock<std::mutex> hold() const {
    const py::gil_scoped_release others;
    return std::unique_lock(mutex_);
  }

  void take_steps(double dt, std::int64_t steps, Told& told) {
    std::unique_lock lock(mutex_);
    auto looked = std::chrono::steady_clock::now();
    for (std::int64_t i = 0; i < steps; ++i) {
      take_step(dt);
      const auto& events = world_.events().events();
      told.events.insert(told.events.end(), events.begin(), events.end());
      told.hits.insert(told.hits.end(), world_.hits().begin(), world_.hits().end());
      const auto now = std::chrono::steady_clock::now();
      if (now - looked < look) continue;
      looked = now;
      lock.unlock();  // a handler, which runs on this thread, may read this world, or step it
      {
        const py::gil_scoped_acquire ours;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      }
      lock.lock();
    }
  }

  /// With what the scene's [[push]] say, before the first step that begins then or later: with the scene's own step at the times at
  /// which the program pushes. If it throws, nothing has changed.
  void take_step(double dt) {
    const bool uniform = uniform_ && dt == scene_.dt;
    const double time = uniform ? static_cast<double>(steps_) * dt : world_.time();
    std::size_t pushed = pushed_;
    std::vector<Push> undo;
    try {
      for (; pushed < scene_.pushes.size() && scene_.pushes[pushed].time <= time; ++pushed) {
        const Push& push = scene_.pushes[pushed];
        const Body* const body = world_.find(push.id);
        if (body == nullptr) continue;
        undo.push_back({push.time, push.id, body->velocity});
        world_.set_velocity(push.id, push.velocity);
      }
      world_.step(dt);
    } catch (...) {
      for (const Push& push : undo | std::views::reverse) world_.set_velocity(push.id, push.velocity);
      throw;
    }
    uniform_ = uniform;
    pushed_ = pushed;
    ++steps_;
  }

  Scene scene_;
  World world_;
  mutable std::mutex mutex_;
  Told told_;
  std::size_t pushed_ = 0;
  std::int64_t steps_ = 0;
  bool uniform_ = true;  // every step was the scene's own
};

using Text = std::vector<std::string>;

/// As a scene file calls it.
std::string shape_name(const AnyShape& shape) {
  constexpr std::array<const char*, 5> names = {"none", "sphere", "box", "turned_box", "capsule"};
  static_assert(std::variant_size_v<AnyShape> == names.size());
  return names.at(shape.index());
}

py::dict bodies_of(const SteppedScene& self) {
  const std::vector<Body>& bodies = self.world().bodies();
  Text names, shapes;
  for (const Body& body : bodies) {
    names.push_back(body.name);
    shapes.push_back(shape_name(body.shape));
  }
  py::dict out;
  out["id"] = column_of<std::uint32_t>(bodies, [](const Body& b) { return b.id; });
  out["name"] = names;
  out["shape"] = shapes;
  out["size"] = vectors_of(bodies, size_of);
  out["mass"] = column_of<double>(bodies, [](const Body& b) { return b.mass; });
  out["restitution"] = column_of<double>(bodies, [](const Body& b) { return b.restitution; });
  out["is_static"] = column_of<bool>(bodies, [](const Body& b) { return b.is_static; });
  return out;
}

py::dict events_of(const std::vector<CollisionEvent>& events) {
  using Event = CollisionEvent;
  py::dict out;
  out["kind"] = column_of<std::int8_t>(events, [](const Event& e) { return static_cast<int>(e.kind); });
  out["first"] = column_of<std::uint32_t>(events, [](const Event& e) { return e.first; });
  out["second"] = column_of<std::uint32_t>(events, [](const Event& e) { return e.second; });
  out["step"] = column_of<std::int64_t>(events, [](const Event& e) { return e.step; });
  out["time"] = column_of<double>(events, [](const Event& e) { return e.time; });
  out["removed"] = column_of<bool>(events, [](const Event& e) { return e.removed; });
  return out;
}

py::dict hits_of(const SteppedScene& self) {
  const std::vector<Hit>& hits = self.told().hits;
  py::dict out;
  out["first"] = column_of<std::uint32_t>(hits, [](const Hit& h) { return h.first; });
  out["second"] = column_of<std::uint32_t>(hits, [](const Hit& h) { return h.second; });
  out["time"] = column_of<double>(hits, [](const Hit& h) { return h.time; });
  out["at_start"] = column_of<bool>(hits, [](const Hit& h) { return h.at_start; });
  out["normal"] = vectors_of(hits, [](const Hit& h) { return h.normal; });
  out["point"] = vectors_of(hits, [](const Hit& h) { return h.point; });
  return out;
}

template <class Read> auto reader(Read get) {
  return [get](const SteppedScene& self) { return self.read(get); };
}

using Triple = std::array<double, 3>;

Vec3<double> vector(const Triple& t) { return {t[0], t[1], t[2]}; }

}  // namespace

void bind_world(py::module_& module) {
  py::class_<SteppedScene>(module, "SteppedScene")
      .def(py::init<const std::string&, const std::string&, std::uint64_t, int>(), py::arg("text"), py::arg("file"),
           py::arg("seed"), py::arg("threads"), py::call_guard<py::gil_scoped_release>())
      .def(
          "step", [](SteppedScene& self, double dt, std::int64_t steps) { return events_of(self.step(dt, steps)); },
          py::arg("dt"), py::arg("steps"))
      .def("set_velocity",
           [](SteppedScene& self, std::uint32_t id, const Triple& velocity) {
             self.change([&](World& world) { world.set_velocity(id, vector(velocity)); });
           })
      .def("move", [](SteppedScene& self, std::uint32_t id,
                      const Triple& by) { self.change([&](World& world) { world.move(id, vector(by)); }); })
      .def("remove", [](SteppedScene& self, std::uint32_t id) { self.change([&](World& world) { world.remove(id); }); })
      .def_property_readonly("name", [](const SteppedScene& self) { return self.scene().name; })
      .def_property_readonly("dt", [](const SteppedScene& self) { return self.scene().dt; })
      .def_property_readonly("steps", [](const SteppedScene& self) { return self.scene().steps; })
      .def_property_readonly("policy",
                             [](const SteppedScene& self) { return std::string(name_of(self.scene().options.policy)); })
      .def_property_readonly("time", reader([](const SteppedScene& self) { return self.world().time(); }))
      .def_property_readonly("energy", reader([](const SteppedScene& self) { return self.world().energy(); }))
      .def_property_readonly("state_hash", reader([](const SteppedScene& self) { return self.world().state_hash(); }))
      .def_property_readonly("positions", reader([](const SteppedScene& self) {
                               return vectors_of(self.world().bodies(), [](const Body& b) { return position(b); });
                             }))
      .def_property_readonly("velocities", reader([](const SteppedScene& self) {
                               return vectors_of(self.world().bodies(),
                                                 [](const Body& b) -> Vec3<double> { return b.velocity; });
                             }))
      .def_property_readonly("bodies", reader(bodies_of))
      .def_property_readonly("events", reader([](const SteppedScene& self) { return events_of(self.told().events); }))
      .def_property_readonly("hits", reader(hits_of));
}

}  // namespace thinwall
