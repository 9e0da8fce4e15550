// The golden table: every pair of shapes, every query, and the form that serves it. The compiler checks that exactly the
// listed ones are served; the tests, that docs/pairs.md shows this table.

#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <thinwall/capsule/capsule_manifold.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>
#include <type_traits>

#include <gtest/gtest.h>

namespace thinwall::testing {
namespace {

constexpr std::string_view postponed = "postponed";

struct Row {
  std::string_view first, second;  ///< the shapes, the one of lower rank first
  std::string_view overlaps, contact, manifold, time_of_impact, turning;
};
constexpr std::array table{
    Row{"Sphere", "Sphere", "distance of the centers", "distance of the centers", "one point",
        "perpendicular quadratic", "attached planes"},
    Row{"Sphere", "Aabb", "clamp", "clamp; nearest face", "one point", "walk over slabs", "attached planes"},
    Row{"Sphere", "Obb", "clamp", "clamp; nearest face", "one point", "walk over slabs", "attached planes"},
    Row{"Sphere", "Triangle", "nearest part", "nearest part", "one point", "walk over parts; exact signs",
        "attached planes"},
    Row{"Sphere", "Capsule", "point and segment", "point and segment", "one point", "rounded segment",
        "attached planes"},
    Row{"Aabb", "Aabb", "slabs", "slabs", "shared rectangle", "walk over slabs", "attached planes; 15 axes"},
    Row{"Aabb", "Obb", "15 axes", "15 axes; nearest features", "clipped face; two edges", "15 axes in time",
        "attached planes; 15 axes"},
    Row{"Aabb", "Triangle", postponed, postponed, postponed, postponed, postponed},
    Row{"Aabb", "Capsule", "segment and box", "segment and box; 6 axes", "clipped core", "walk over parts",
        "attached planes"},
    Row{"Obb", "Obb", "15 axes", "15 axes; nearest features", "clipped face; two edges", "15 axes in time",
        "attached planes; 15 axes"},
    Row{"Obb", "Triangle", postponed, postponed, postponed, postponed, postponed},
    Row{"Obb", "Capsule", "segment and box", "segment and box; 6 axes", "clipped core", "walk over parts",
        "attached planes"},
    Row{"Triangle", "Triangle", postponed, postponed, postponed, postponed, postponed},
    Row{"Triangle", "Capsule", "segment and triangle", "segment and triangle", "clipped core", "walk over parts",
        "attached planes"},
    Row{"Capsule", "Capsule", "two segments", "two segments", "shared stretch", "walk over parts; exact signs",
        "attached planes"},
};

struct RayRow {
  std::string_view shape, raycast;
};
constexpr std::array ray_table{
    RayRow{"Sphere", "perpendicular quadratic"},
    RayRow{"Aabb", "slabs"},
    RayRow{"Obb", "slabs"},
    RayRow{"Triangle", "exact signs"},
    RayRow{"Capsule", "rounded segment"},
};

// A shape without a name here does not compile.
template <class A> constexpr std::string_view name_of = A::has_no_name_in_the_golden_table;
template <> constexpr std::string_view name_of<Sphere<double>> = "Sphere";
template <> constexpr std::string_view name_of<Aabb<double>> = "Aabb";
template <> constexpr std::string_view name_of<Obb<double>> = "Obb";
template <> constexpr std::string_view name_of<Triangle<double>> = "Triangle";
template <> constexpr std::string_view name_of<Capsule<double>> = "Capsule";

/// Of the pair; null if it has none, or two.
template <class A, class B> constexpr const Row* row_of() {
  const Row* found = nullptr;
  for (const Row& row : table) {
    if (row.first != name_of<A> || row.second != name_of<B>) continue;
    if (found != nullptr) return nullptr;
    found = &row;
  }
  return found;
}

template <class A>
concept CanBeHitByRays = requires(const Ray<typename A::Scalar>& ray, const A& shape) { ray_entry(ray, shape); };

/// What turns of a shape: a box along the axes is an oriented one then.
template <class A> using WhatTurns = std::conditional_t<stays_along_the_axes<A>, Obb<double>, A>;

template <class A, class B> constexpr bool check_pair() {
  if constexpr (A::rank <= B::rank) {
    constexpr const Row* row = row_of<A, B>();
    static_assert(row != nullptr, "a pair of shapes has no row in the golden table, or two");
    static_assert(ServedPair<A, B> == (row->overlaps != postponed));
    static_assert(ServedPair<A, B> == (row->contact != postponed));
    static_assert(serves_manifold<A, B> == (row->manifold != postponed));
    static_assert(serves_manifold<B, A> == (row->manifold != postponed));
    static_assert(serves<ClosedForm<double>, A, B> == (row->time_of_impact != postponed));
    static_assert(serves<ClosedForm<double>, B, A> == (row->time_of_impact != postponed));
    static_assert(serves_turning<ConservativeAdvancement<double>, WhatTurns<A>, WhatTurns<B>> ==
                  (row->turning != postponed));
  }
  return true;
}

template <class A> constexpr bool check_ray() {
  int rows = 0;
  for (const RayRow& row : ray_table) rows += row.shape == name_of<A>;
  return CanBeHitByRays<A> && rows == 1;
}

template <class A, class... Bs> constexpr bool check_shape(TypeList<Bs...>) {
  static_assert(check_ray<A>());
  return (check_pair<A, Bs>() && ...);
}
template <class... As> constexpr bool check_all(TypeList<As...> all) { return (check_shape<As>(all) && ...); }
template <class... As> constexpr std::size_t length(TypeList<As...>) { return sizeof...(As); }

static_assert(check_all(Shapes<double>{}));
static_assert(table.size() == length(Shapes<double>{}) * (length(Shapes<double>{}) + 1) / 2, "a row of no pair");
static_assert(ray_table.size() == length(Shapes<double>{}), "a row of no shape");

/// The rows of the Markdown table that starts with `head`, with their line ends.
std::string rows_after(const std::string& head) {
  std::ifstream file(THINWALL_PAIRS_PAGE);
  std::string line, rows;
  while (std::getline(file, line) && line != head) continue;
  std::getline(file, line);  // |---|
  while (std::getline(file, line) && line.starts_with("|")) rows += line + "\n";
  return rows;
}

TEST(GoldenTable, is_the_one_on_the_page) {
  std::ostringstream rows;
  for (const Row& row : table) {
    rows << "| " << row.first << ", " << row.second << " | " << row.overlaps << " | " << row.contact << " | "
         << row.manifold << " | " << row.time_of_impact << " | " << row.turning << " |\n";
  }
  EXPECT_EQ(rows_after("| pair | overlaps | contact, separation | manifold | time_of_impact | the same, turning |"),
            rows.str());
}

TEST(GoldenTable, of_rays_is_the_one_on_the_page) {
  std::ostringstream rows;
  for (const RayRow& row : ray_table) rows << "| " << row.shape << " | " << row.raycast << " |\n";
  EXPECT_EQ(rows_after("| shape | raycast |"), rows.str());
}

}  // namespace
}  // namespace thinwall::testing
