#include <thinwall/experiments/work_precision/query_sets.hpp>

namespace thinwall {

std::span<const QuerySet> query_sets() {
  static const std::array list = {sphere_wall_set(), sphere_sphere_set(), capsule_box_set(), box_box_set()};
  return list;
}

}  // namespace thinwall
