#include <thinwall/experiments/world/spin.hpp>

#include <variant>

namespace thinwall {
namespace {

Obb<double> true_axes(const Obb<double>& box) {
  Mat3<double> axes;
  axes.col(0) = safe_unit(Vec3<double>(box.axes.col(0)));
  const Vec3<double> second = box.axes.col(1) - axes.col(0) * axes.col(0).dot(box.axes.col(1));
  axes.col(1) = safe_unit(second);
  const Vec3<double> third = cross<double>(axes.col(0), axes.col(1));
  axes.col(2) = third.dot(box.axes.col(2)) < 0 ? Vec3<double>(-third) : third;  // a mirrored frame stays one
  return {box.center, box.half_extents, axes};
}

struct TurnedTrue {
  const Mat3<double>& turn;

  AnyShape operator()(const Obb<double>& box) const { return true_axes(turned(box, turn)); }
  AnyShape operator()(const Capsule<double>& capsule) const {
    const Vec3<double> middle = center(capsule), half = (capsule.b - capsule.a) / 2, now = turn * half;
    const double length = safe_norm(now);
    const Vec3<double> kept = length > 0 ? Vec3<double>(now * (safe_norm(half) / length)) : now;
    return Capsule<double>{middle - kept, middle + kept, capsule.radius};
  }
  template <class A> AnyShape operator()(const A& shape) const { return shape; }
};

/// Cylinder and hemispheres share the mass as their volumes, pi r^2 length and 4/3 pi r^3.
Gyration gyration(const Capsule<double>& capsule) {
  const double r = capsule.radius, length = safe_norm(Vec3<double>(capsule.b - capsule.a)), ends = r * 4 / 3;
  const double cylinder = length + ends > 0 ? length / (length + ends) : 0, hemispheres = 1 - cylinder;
  const double along = cylinder * r * r / 2 + hemispheres * r * r * 2 / 5;
  const double across = cylinder * (length * length / 12 + r * r / 4) +
                        hemispheres * (r * r * 2 / 5 + length * length / 4 + length * r * 3 / 8);
  Gyration gyration{Mat3<double>::Identity(), {across, across, along}};
  if (length == 0) return gyration;
  const Vec3<double> axis = safe_unit(Vec3<double>(capsule.b - capsule.a));
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3<double> side = safe_unit(cross(axis, axis_vector<double>(least)));
  gyration.axes.col(0) = side;
  gyration.axes.col(1) = cross(axis, side);
  gyration.axes.col(2) = axis;
  return gyration;
}

Gyration gyration(const Obb<double>& box) {
  const Vec3<double> square = box.half_extents.cwiseAbs2() / 3;
  return {box.axes, {square[1] + square[2], square[0] + square[2], square[0] + square[1]}};
}
Gyration gyration(const Aabb<double>& box) { return gyration(to_obb(box)); }
Gyration gyration(const Sphere<double>& ball) {
  return {Mat3<double>::Identity(), Vec3<double>::Constant(ball.radius * ball.radius * 2 / 5)};
}
Gyration gyration(const std::monostate&) { return {}; }

}  // namespace

AnyShape turned_true(const AnyShape& shape, const Mat3<double>& turn) { return std::visit(TurnedTrue{turn}, shape); }

Gyration gyration_of(const AnyShape& shape) {
  return std::visit([](const auto& held) { return gyration(held); }, shape);
}

Mat3<double> inverse_inertia(const AnyShape& shape, double inverse_mass) {
  const Gyration of = gyration_of(shape);
  Vec3<double> inverse;
  for (int i = 0; i < 3; ++i) inverse[i] = of.squares[i] > 0 ? inverse_mass / of.squares[i] : 0;
  return of.axes * inverse.asDiagonal() * of.axes.transpose();
}

long double energy_of_turning(const Body& body) {
  using Wide = long double;
  const Gyration of = gyration_of(body.shape);
  const Vec3<Wide> rate = of.axes.cast<Wide>().transpose() * body.angular_velocity.cast<Wide>();
  return Wide(body.mass) * rate.cwiseAbs2().dot(of.squares.cast<Wide>()) / 2;
}

double farthest_point(const AnyShape& shape) {
  return of_shape(shape, 0.0, []<class A>(const A& held) {
    if constexpr (std::is_same_v<A, Aabb<double>>) {
      return safe_norm(held.half_extents);
    } else {
      return farthest(core_vectors(held)) + skin_radius(held);
    }
  });
}

}  // namespace thinwall
