#include <thinwall/experiments/work_precision/race.hpp>

namespace thinwall {

namespace {

/// A ball of 1 to 10 cm and a wall of 2 m by 2 m, 0.1 mm to 10 cm thick.
struct SphereWall {
  using A = Sphere<double>;
  using B = Aabb<double>;
  static constexpr std::string_view name = "sphere_wall", title = "a small ball and a thin wall";
  static constexpr double key = 1;  // of its random numbers

  static A draw_a(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.01, 0.1)}; }
  static B draw_b(QueryNumbers& u) { return {Vec3<double>::Zero(), {u.decades(-4, -1) / 2, 1, 1}}; }
};

}  // namespace

QuerySet sphere_wall_set() { return query_set_of<SphereWall>(); }

}  // namespace thinwall
