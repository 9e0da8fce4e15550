#include <thinwall/experiments/work_precision/race.hpp>

namespace thinwall {

namespace {

/// Two boxes of 0.2 to 2 m a side, turned any way.
struct BoxBox {
  using A = Obb<double>;
  using B = Obb<double>;
  static constexpr std::string_view name = "box_box", title = "two boxes";
  static constexpr double key = 4;  // of its random numbers

  static A draw_a(QueryNumbers& u) {
    const Vec3<double> half = random_half_extents(u);
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
  static B draw_b(QueryNumbers& u) { return draw_a(u); }
};

}  // namespace

QuerySet box_box_set() { return query_set_of<BoxBox>(); }

}  // namespace thinwall
