// Every pair with one shape as the later, at one scalar: compiled once for each, for all of them in one file take minutes.

#include "fuzz/pairs_of.hpp"
#include "fuzz/checks.hpp"
#include "fuzz/turning_checks.hpp"

namespace thinwall::fuzz {
namespace {

template <class A, class B> void check_pair(Bytes& bytes, Reading reading) {
  using S = typename A::Scalar;
  const int plan = bytes();
  Numbers<S> numbers(bytes, reading);
  const Scene<A, B> scene = draw_scene<A, B>(numbers);
  const Toi<S> toi = check_closed_form(scene);
  const int choice = plan / 8;
  if (!scene.is_valid()) {
    check_bad_shapes(scene);
    check_raycast(scene);
    check_methods(scene, choice % 10);
    check_certified(scene, toi);
    check_turning(scene, numbers);
    return;
  }
  check_discrete(scene);
  switch (plan % 8) {
    case 0: judge_discrete(scene); break;
    case 1: check_raycast(scene); break;
    case 2: check_scale(scene, choice); break;
    case 3: check_methods(scene, choice % 10); break;
    case 4: check_certified(scene, toi); break;
    case 5: check_turning(scene, numbers); break;
    default: judge_closed_form(scene, toi); break;
  }
}

template <class A, class B>
inline constexpr bool is_pair = [] {
  if constexpr (ServedPair<A, B>) return A::rank >= B::rank;
  return false;
}();

}  // namespace

template <class A> void check_one_pair_of(Bytes& bytes) {
  const int kind = bytes.below(8);
  const Reading reading = kind == 0 ? Reading::raw : kind == 1 ? Reading::unruly : Reading::nasty;
  const auto for_each_partner = [&](const auto& f) {
    for_each_type(Shapes<typename A::Scalar>{}, [&]<class B>(TypeTag<B> tag) {
      if constexpr (is_pair<A, B>) f(tag);
    });
  };
  int count = 0, index = 0;
  for_each_partner([&](auto) { ++count; });
  const int wanted = bytes.below(count);
  for_each_partner([&](auto tag) {
    if (index++ == wanted) check_pair<A, typename decltype(tag)::type>(bytes, reading);
  });
}

template void check_one_pair_of<THINWALL_FUZZ_SHAPE<THINWALL_FUZZ_SCALAR>>(Bytes& bytes);

}  // namespace thinwall::fuzz
