#pragma once
/// The sets of queries that methods are raced on: a pair of shapes, and how they are drawn. A set is a source file in
/// sets/ and a line in query_sets.cpp.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include <thinwall/experiments/work_precision/race_options.hpp>
#include <thinwall/experiments/work_precision/racer.hpp>

namespace thinwall {

enum class QueryClass {
  hit,    ///< they touch; first contact is uniform over the step
  miss,   ///< one passes beside the other
  graze,  ///< the path is within 1e-8 (in float 1e-3) to 1e-2 of its offset from the last that touches, on either side
};
inline constexpr std::array all_query_classes{QueryClass::hit, QueryClass::miss, QueryClass::graze};
constexpr std::string_view name(QueryClass kind) {
  constexpr std::array<std::string_view, 3> names{"hit", "miss", "graze"};
  return names[static_cast<std::size_t>(kind)];
}

struct QuerySet {
  std::string_view name;                  ///< as in the settings
  std::string_view title;                 ///< "a ball and a thin wall"
  std::vector<std::string_view> methods;  ///< that serve the pair
  std::vector<Racer> (*in_float)(QueryClass kind, const RaceOptions& options);
  std::vector<Racer> (*in_double)(QueryClass kind, const RaceOptions& options);
};

std::span<const QuerySet> query_sets();

QuerySet sphere_wall_set();
QuerySet sphere_sphere_set();
QuerySet capsule_box_set();
QuerySet box_box_set();

}  // namespace thinwall
