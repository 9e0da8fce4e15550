#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/options.hpp>

namespace thinwall {

Vec3<double> position(const Body& body) {
  return std::visit(
      [](const auto& shape) -> Vec3<double> {
        if constexpr (std::is_same_v<decltype(shape), const std::monostate&>) {
          return Vec3<double>::Zero();
        } else {
          return center(shape);
        }
      },
      body.shape);
}

std::string called(const Body& body) {
  return (body.name.empty() ? "body" : body.name) + " (id " + std::to_string(body.id) + ")";
}

std::string_view name_of(TimePolicy policy) {
  switch (policy) {
    case TimePolicy::discrete: return "discrete";
    case TimePolicy::substeps: return "substeps";
    case TimePolicy::clamp: return "clamp";
    case TimePolicy::event_driven: return "event_driven";
  }
  return "";
}

}  // namespace thinwall
