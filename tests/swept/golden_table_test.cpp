// The golden table is docs/pairs.md: of every pair of shapes and every query the form that serves it, or that it is postponed, which it
// says of exactly what the code does not serve.

#include <fstream>
#include <map>
#include <string>
#include <thinwall/capsule/capsule_manifold.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "support/numbers_of.hpp"

namespace thinwall::testing {
namespace {

using Rows = std::map<std::string, std::vector<std::string>>;

/// The cells of the Markdown table that starts with `head`, by the first of each row.
Rows table_after(const std::string& head) {
  std::ifstream file(THINWALL_PAIRS_PAGE);
  std::string line;
  while (std::getline(file, line) && line != head) continue;
  std::getline(file, line);  // |---|
  Rows rows;
  while (std::getline(file, line) && line.starts_with("|")) {
    std::vector<std::string> cells;
    for (std::size_t from = 2, to = 0; (to = line.find(" |", from)) != line.npos; from = to + 3)
      cells.push_back(line.substr(from, to - from));
    const std::string first = cells.at(0);
    cells.erase(cells.begin());
    EXPECT_TRUE(rows.emplace(first, cells).second) << "a second row of " << first;
  }
  return rows;
}

template <class A> std::string name_of() { return std::string(shape_name<A>); }

/// What turns of a shape: a box along the axes is an oriented one then.
template <class A> using WhatTurns = std::conditional_t<stays_along_the_axes<A>, Obb<double>, A>;

template <class A, class B> void expect_row(const Rows& rows) {
  const std::string pair = name_of<A>() + ", " + name_of<B>();
  SCOPED_TRACE(pair);
  ASSERT_TRUE(rows.contains(pair));
  const std::vector<bool> served = {ServedPair<A, B>, ServedPair<A, B>, serves_manifold<A, B>,
                                    serves<ClosedForm<double>, A, B>,
                                    serves_turning<ConservativeAdvancement<double>, WhatTurns<A>, WhatTurns<B>>};
  ASSERT_EQ(rows.at(pair).size(), served.size());
  for (std::size_t i = 0; i < served.size(); ++i)
    EXPECT_EQ(rows.at(pair)[i] != "postponed", served[i]) << "column " << i + 2;
  EXPECT_EQ((serves_manifold<B, A>), served[2]);
  EXPECT_EQ((serves<ClosedForm<double>, B, A>), served[3]);
}

TEST(GoldenTable, postpones_what_is_not_served_and_nothing_else) {
  const Rows rows =
      table_after("| pair | overlaps | contact, separation | manifold | time_of_impact | the same, turning |");
  std::size_t pairs = 0;
  for_each_type(Shapes<double>{}, [&]<class A>(TypeTag<A>) {
    for_each_type(Shapes<double>{}, [&]<class B>(TypeTag<B>) {
      if constexpr (A::rank <= B::rank) {
        expect_row<A, B>(rows);
        ++pairs;
      }
    });
  });
  EXPECT_EQ(rows.size(), pairs) << "a row of no pair";
}

template <class A>
concept CanBeHitByRays = requires(const Ray<typename A::Scalar>& ray, const A& shape) { ray_entry(ray, shape); };

TEST(GoldenTable, of_rays_has_every_shape) {
  const Rows rows = table_after("| shape | raycast |");
  std::size_t shapes = 0;
  for_each_type(Shapes<double>{}, [&]<class A>(TypeTag<A>) {
    static_assert(CanBeHitByRays<A>);
    EXPECT_TRUE(rows.contains(name_of<A>())) << name_of<A>();
    ++shapes;
  });
  EXPECT_EQ(rows.size(), shapes) << "a row of no shape";
}

}  // namespace
}  // namespace thinwall::testing
