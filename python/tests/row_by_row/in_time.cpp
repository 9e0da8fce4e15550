#include <thinwall/swept/time_of_impact.hpp>

#include "row_by_row.hpp"

namespace thinwall::row_by_row {

template <class S> bool in_time(const Task& task) {
  bool asked = false;
  for_each_type(Shapes<S>{}, [&]<class TagA>(TagA) {
    for_each_type(Shapes<S>{}, [&]<class TagB>(TagB) {
      using A = typename TagA::type;
      using B = typename TagB::type;
      if constexpr (serves<ClosedForm<S>, A, B>) {
        asked = asked || each_row<A, B, S>(task, [](const auto& a, const auto& b) {
                  put(time_of_impact(Moving<A>{a.shape, a.displacement}, Moving<B>{b.shape, b.displacement}));
                });
      }
    });
  });
  return asked;
}
template bool in_time<float>(const Task&);
template bool in_time<double>(const Task&);

}  // namespace thinwall::row_by_row
