/// Certified times of impact, of straight motion and of what turns. Of double alone: they are proven for the numbers as given.
#include <thinwall/swept/certified.hpp>
#include <thinwall/swept/certified/turning_certified.hpp>
#include <thinwall/swept/compiled.hpp>

#include "queries.hpp"

namespace thinwall::python {

namespace {

template <class A, class B> struct Asked {
  static constexpr bool value = A::rank >= B::rank && certifies<A, B>;
};

template <class A, class B> struct AskedTurning {
  static constexpr bool value = [] {
    if constexpr (stays_along_the_axes<A> || stays_along_the_axes<B>) {
      return false;
    } else {
      return A::rank >= B::rank && ServedPair<A, B>;
    }
  }();
};

}  // namespace

bool ask_certified(const Question& q) {
  if (q.a.motion == Motion::turning || q.b.motion == Motion::turning) {
    return for_the_shapes<double, AskedTurning>(q, [&]<class A, class B>() {
      answer_rows<CertifiedToi>(q, [&](std::size_t i) {
        return certified_time_of_impact(turning_row<A, double>(q.a, i), turning_row<B, double>(q.b, i));
      });
    });
  }
  return for_the_shapes<double, Asked>(q, [&]<class A, class B>() {
    answer_rows<CertifiedToi>(q, [&](std::size_t i) {
      return certified_time_of_impact(row_of<Moving<A>, double>(q.a, i), row_of<Moving<B>, double>(q.b, i));
    });
  });
}

}  // namespace thinwall::python
