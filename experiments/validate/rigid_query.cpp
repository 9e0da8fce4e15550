#include <thinwall/experiments/validate/rigid_query.hpp>

#include <cmath>

#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {
namespace {

RationalPoint exact_point(const Vec3<double>& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

/// The nearest doubles; nothing if one is out of range.
std::optional<Vec3<double>> nearest(const RationalPoint& point) {
  Vec3<double> v;
  for (std::size_t i = 0; i < 3; ++i) v[static_cast<int>(i)] = point[i].convert_to<double>();
  return is_finite(v) ? std::optional(v) : std::nullopt;
}

std::optional<Rational> exact_contact(Primitives primitives, const std::array<RationalPoint, 4>& at,
                                      const RationalPoint& displacement_a, const RationalPoint& displacement_b) {
  ExactQuery query;
  if (primitives == Primitives::vertex_face) {  // the vertex, seen from the face
    query = {FlatSet::triangle, difference(at[0], at[1]), difference(displacement_a, displacement_b),
             difference(at[2], at[1]), difference(at[3], at[1])};
  } else {  // the second edge, seen from the first
    query = {FlatSet::parallelogram, difference(at[2], at[0]), difference(displacement_b, displacement_a),
             difference(at[1], at[0]), difference(at[2], at[3])};
  }
  return first_contact(query);
}

}  // namespace

RigidReading read_rigid(Primitives primitives, const PublishedQuery& published) {
  const std::size_t first_b = primitives == Primitives::vertex_face ? 1 : 2;
  std::array<RationalPoint, 4> displacement;
  for (std::size_t k = 0; k < 4; ++k) {
    displacement[k] = difference(published.at_end[k], published.at_start[k]);
    const std::size_t leader = k < first_b ? 0 : first_b;
    if (displacement[k] != displacement[leader]) return {std::nullopt, Skipped::not_rigid};
  }
  RigidQuery query;
  query.primitives = primitives;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto vertex = nearest(published.at_start[k]);
    if (!vertex || exact_point(*vertex) != published.at_start[k]) return {std::nullopt, Skipped::not_double};
    query.at_start[k] = *vertex;
  }
  const auto a = nearest(displacement[0]), b = nearest(displacement[first_b]);
  if (!a || !b) return {std::nullopt, Skipped::not_double};
  query.displacement_a = *a;
  query.displacement_b = *b;
  const RationalPoint posed_a = exact_point(*a), posed_b = exact_point(*b);
  query.rounded = posed_a != displacement[0] || posed_b != displacement[first_b];
  query.published_contact = exact_contact(primitives, published.at_start, displacement[0], displacement[first_b]);
  query.posed_contact = query.rounded ? exact_contact(primitives, published.at_start, posed_a, posed_b)  //
                                      : query.published_contact;
  if (query.posed_contact.has_value() != query.published_contact.has_value()) {
    return {std::nullopt, Skipped::rounding_decides};
  }
  return {query, Skipped::not_rigid};
}

Toi<double> library_answer(const RigidQuery& query) {
  const auto& at = query.at_start;
  if (query.primitives == Primitives::vertex_face) {
    return time_of_impact(Moving{Sphere<double>{at[0], 0}, query.displacement_a},
                          Moving{Triangle<double>{at[1], at[2], at[3]}, query.displacement_b});
  }
  return time_of_impact(Moving{Capsule<double>{at[0], at[1], 0}, query.displacement_a},
                        Moving{Capsule<double>{at[2], at[3], 0}, query.displacement_b});
}

}  // namespace thinwall
