#include <thinwall/swept/certified.hpp>

#include "row_by_row.hpp"

namespace thinwall::row_by_row {

bool certified(const Task& task) {
  bool asked = false;
  for_each_type(Shapes<double>{}, [&]<class TagA>(TagA) {
    for_each_type(Shapes<double>{}, [&]<class TagB>(TagB) {
      using A = typename TagA::type;
      using B = typename TagB::type;
      if constexpr (certifies<A, B>) {
        asked = asked || each_row<A, B, double>(task, [](const auto& a, const auto& b) {
                  const CertifiedToi toi =
                      certified_time_of_impact(Moving<A>{a.shape, a.displacement}, Moving<B>{b.shape, b.displacement});
                  put(toi.verdict);
                  put(toi.lower);
                  put(toi.upper);
                  put(toi.decided_by);
                });
      }
    });
  });
  return asked;
}

}  // namespace thinwall::row_by_row
