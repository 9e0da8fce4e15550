#include <thinwall/experiments/work_precision/race.hpp>

namespace thinwall {

namespace {

/// A capsule with a core of 0.2 to 2 m and a radius of 5 to 30 cm, and a box of 0.2 to 2 m a side, both turned any way.
struct CapsuleBox {
  using A = Capsule<double>;
  using B = Obb<double>;
  static constexpr std::string_view name = "capsule_box", title = "a capsule and a box";
  static constexpr double key = 3;  // of its random numbers

  static A draw_a(QueryNumbers& u) {
    const double half_length = u.between(0.1, 1);
    const Vec3<double> half = u.direction() * half_length;
    return {-half, half, u.between(0.05, 0.3)};
  }
  static B draw_b(QueryNumbers& u) {
    const Vec3<double> half = random_half_extents(u);
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
};

}  // namespace

QuerySet capsule_box_set() { return query_set_of<CapsuleBox>(); }

}  // namespace thinwall
