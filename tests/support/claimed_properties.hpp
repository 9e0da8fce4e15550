#pragma once
/// Every method of the list on the same random motions, held to what it claims.

#include <sstream>

#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/claims_judge.hpp"
#include "support/moving_shaker.hpp"
#include "support/property.hpp"

namespace thinwall::testing {

/// One motion of a pair, a third of them with a gap that counts as contact.
template <class A, class B> void every_method_keeps_its_claims() {
  using S = typename A::Scalar;
  const int seed = draw_integer(0, 1 << 30);
  Shaker<S> draw(static_cast<unsigned>(seed));
  const Motion<A, B> motion = drawn_motion<A, B>(draw);
  const S gap = draw.pick(0, 2) == 0 ? draw.sizes()[0] * power<S>(-draw.pick(0, 10)) : S(0);
  const Referee<A, B> referee(motion.a, motion.b, gap);
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      Method method;
      method.min_separation = gap;
      const Toi<S> toi = time_of_impact(method, motion.a, motion.b);
      const auto judgment = judge_claims(claims_of(method), referee, toi);
      if (judgment) return;
      std::ostringstream out;
      out << Method::name << " on seed " << seed << ", min_separation " << gap << ": " << judgment.message();
      RC_FAIL(out.str());
    }
  });
}

/// `runs` motions of every pair of shapes that is served.
template <class S> void check_every_pair(int runs) {
  for_each_type(Shapes<S>{}, [&]<class A>(TypeTag<A>) {
    for_each_type(Shapes<S>{}, [&]<class B>(TypeTag<B>) {
      if constexpr (ServedPair<A, B> && A::rank >= B::rank) {
        SCOPED_TRACE(std::to_string(A::rank) + " and " + std::to_string(B::rank));
        check_property(runs, every_method_keeps_its_claims<A, B>);
      }
    });
  });
}

}  // namespace thinwall::testing
