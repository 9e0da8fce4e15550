#include <thinwall/experiments/scenes/trace.hpp>

#include <fmt/format.h>

#include <thinwall/experiments/scenes/bodies.hpp>
#include <thinwall/experiments/scenes/playback.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

std::string vector_text(const Vec3<double>& v) {
  return fmt::format("[{},{},{}]", exact_text(v[0]), exact_text(v[1]), exact_text(v[2]));
}

/// The shape around its own center: a body's place in a frame is where that center is.
struct ShapeText {
  std::string operator()(const std::monostate&) const { return "null"; }
  std::string operator()(const Sphere<double>& s) const {
    return fmt::format(R"({{"type":"sphere","radius":{}}})", exact_text(s.radius));
  }
  std::string operator()(const Aabb<double>& b) const {
    return fmt::format(R"({{"type":"box","size":{}}})", vector_text(2 * b.half_extents));
  }
  std::string operator()(const Obb<double>& b) const {
    return fmt::format(R"({{"type":"turned_box","size":{},"axes":[{},{},{}]}})", vector_text(2 * b.half_extents),
                       vector_text(b.axes.col(0)), vector_text(b.axes.col(1)), vector_text(b.axes.col(2)));
  }
  std::string operator()(const Capsule<double>& c) const {
    const Vec3<double> half = (c.b - c.a) / 2;
    return fmt::format(R"({{"type":"capsule","radius":{},"half_core":{}}})", exact_text(c.radius), vector_text(half));
  }
};

std::string header(const Scene& scene, const World& world) {
  std::string bodies;
  for (const Body& body : world.bodies()) {
    bodies += fmt::format(R"({}{{"id":{},"name":{},"static":{},"shape":{},"at":{}}})", bodies.empty() ? "" : ",",
                          body.id, json_string(body.name), body.is_static, std::visit(ShapeText{}, body.shape),
                          vector_text(box_of(body).center));
  }
  return fmt::format("{{\"scene\":{},\"dt\":{},\"bodies\":[{}]}}\n", json_string(scene.name), exact_text(scene.dt),
                     bodies);
}

std::string frame(const World& world) {
  std::string at, events;
  for (const Body& body : world.bodies()) {
    if (can_move(body)) at += (at.empty() ? "" : ",") + vector_text(box_of(body).center);
  }
  for (const CollisionEvent& event : world.events().events()) {
    if (event.kind == CollisionEventKind::stay) continue;
    const char* const kind = event.kind == CollisionEventKind::begin ? "begin" : "end";
    events += fmt::format(R"({}["{}",{},{},{}])", events.empty() ? "" : ",", kind, event.first, event.second,
                          exact_text(event.time));
  }
  return fmt::format("{{\"time\":{},\"at\":[{}],\"events\":[{}]}}\n", exact_text(world.time()), at, events);
}

}  // namespace

std::string trace_of(const Scene& scene) {
  std::string text;
  std::int64_t step = 0;
  play(scene, [&](const World& world) {
    if (step == 0) text += header(scene, world);
    if (step % scene.trace_every == 0 || step == scene.steps) text += frame(world);
    ++step;
  });
  return text;
}

}  // namespace thinwall
