#include <thinwall/experiments/work_precision/race.hpp>

namespace thinwall {

namespace {

/// Two balls of 0.1 to 1 m.
struct SphereSphere {
  using A = Sphere<double>;
  using B = Sphere<double>;
  static constexpr std::string_view name = "sphere_sphere", title = "two balls";
  static constexpr double key = 2;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.1, 1)}; }
  static B draw_b(QueryNumbers& u) { return draw_a(u); }
};

}  // namespace

QuerySet sphere_sphere_set() { return query_set_of<SphereSphere>(); }

}  // namespace thinwall
