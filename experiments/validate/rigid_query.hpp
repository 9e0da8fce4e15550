#pragma once
/// From a published query, whose vertices move each on its own, to one that the library serves: two shapes that translate.

#include <optional>

#include <thinwall/discrete/scalar.hpp>
#include <thinwall/experiments/validate/exact_verdict.hpp>
#include <thinwall/experiments/validate/query_file.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

/// Why a query is left out.
enum class Skipped {
  not_rigid,   ///< the vertices of a primitive do not share one displacement, exactly
  not_double,  ///< a coordinate at the start, or a displacement, has no double near it: too many digits, or too large
  rounding_decides,  ///< a displacement is no double, and with the nearest one the exact answer is another
};

/// A query that fits. Its coordinates are doubles; its displacements are, or the nearest double poses a query with the
/// same exact answer, and that is what the library is judged by.
struct RigidQuery {
  Primitives primitives = Primitives::vertex_face;
  std::array<Vec3<double>, 4> at_start;       ///< [length]
  Vec3<double> displacement_a;                ///< [length] of the vertex, or the first edge
  Vec3<double> displacement_b;                ///< [length] of the face, or the second edge
  bool rounded = false;                       ///< a displacement is not exactly a double
  std::optional<Rational> published_contact;  ///< [1] first contact of the query as published, exactly
  std::optional<Rational> posed_contact;      ///< [1] first contact of the query as posed to the library, exactly
};

struct RigidReading {
  std::optional<RigidQuery> query;
  Skipped skipped = Skipped::not_rigid;  ///< where there is no query
};

RigidReading read_rigid(Primitives primitives, const PublishedQuery& published);

/// What the library's front door answers with its default method, in double.
Toi<double> library_answer(const RigidQuery& query);

}  // namespace thinwall
