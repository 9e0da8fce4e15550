#pragma once
/// What every time of impact must fulfil, whatever the shapes and motions.

#include <thinwall/swept/methods.hpp>

#include "fuzz/discrete_checks.hpp"
#include "fuzz/moderate.hpp"

namespace thinwall::fuzz {

/// Status, time, normal and point belong together.
template <class A, class B>
void check_answer(const Scene<A, B>& scene, const std::string& method, const Toi<typename A::Scalar>& toi) {
  using S = typename A::Scalar;
  const Check check(scene);
  const auto show = [&] { return text(toi); };
  const auto expect = [&](bool holds, const char* property) { check(holds, method + ": " + property, show); };
  const bool ordinary = is_ordinary(scene.size());
  expect(toi.evaluations >= 0, "the count of evaluations is negative");
  if (!scene.is_valid()) {
    expect(toi.status == ToiStatus::invalid, "bad input is not invalid");
    expect(toi.time != toi.time, "invalid with a time");
    return;
  }
  switch (toi.status) {
    case ToiStatus::apart:
      expect(toi.time == S(1) && is_zero(toi.normal) && is_zero(toi.point), "apart with data");
      break;
    case ToiStatus::overlapping:
      expect(toi.time == S(0), "overlapping after the start");
      expect(is_unit(toi.normal), "overlapping, and the normal is not unit");
      break;
    case ToiStatus::hit:
      expect(toi.time >= S(0) && toi.time <= S(1), "hit, and the time is out of range");
      expect(is_unit(toi.normal), "hit, and the normal is not unit");
      break;
    case ToiStatus::gave_up:
      expect(toi.time >= S(0) && toi.time <= S(1), "gave up, and the time is out of range");
      break;
    case ToiStatus::invalid: expect(false, "good input is invalid"); break;
  }
  if (ordinary) expect(is_finite(toi.point), "the point is not finite");
}

/// The closed form: it always answers, unless numbers 2^50 apart leave no digits to walk by; the other way round says the same.
template <class A, class B> Toi<typename A::Scalar> check_closed_form(const Scene<A, B>& scene) {
  using S = typename A::Scalar;
  const Check check(scene);
  const Toi<S> there = time_of_impact(scene.a, scene.b), back = time_of_impact(scene.b, scene.a);
  check_answer(scene, "closed form", there);
  check(there.status != ToiStatus::gave_up || !is_moderate(scene, 25), "closed form: gave up",
        [&] { return text(there); });
  const auto both = [&] { return text(there) + "\n  " + text(back); };
  if constexpr (std::is_same_v<A, B>) {
    check_answer(scene, "closed form, the other way round", back);
  } else if (scene.is_valid()) {
    check(there.status == back.status && there.time == back.time, "closed form: the other way round differs", both);
    check(there.point == back.point || !is_finite(there.point), "closed form: the other way round the point differs",
          both);
    check(there.normal == -back.normal, "closed form: the other way round the normal does not flip", both);
  }
  return there;
}

/// Verdict and time to 4 u, both ways round.
template <class A, class B> void judge_closed_form(const Scene<A, B>& scene, const Toi<typename A::Scalar>& toi) {
  const Check check(scene);
  const auto judge_one = [&](const std::string& way, const auto& a, const auto& b, const auto& answer) {
    const Judgment judgment = judge_impact(exhibit(a, b), answer.status, double{answer.time}, 4);
    check.no_fault(judgment, way, [&] { return text(answer) + ": "; });
  };
  if (toi.status == ToiStatus::gave_up || toi.status == ToiStatus::invalid || !is_judged(scene)) return;
  judge_one("closed form: ", scene.a, scene.b, toi);
  if constexpr (std::is_same_v<A, B>) {
    judge_one("closed form, the other way round: ", scene.b, scene.a, time_of_impact(scene.b, scene.a));
  }
}

/// Lengths times 2^k change no bit, as long as no product of them leaves the range of the scalar.
template <class A, class B> void check_scale(const Scene<A, B>& scene, int choice) {
  using S = typename A::Scalar;
  constexpr bool in_float = std::is_same_v<S, float>;
  constexpr int most = in_float ? 4 : 24;
  constexpr std::array<int, 8> steps = in_float ? std::array<int, 8>{-90, -60, -2, -1, 1, 2, 60, 90}
                                                : std::array<int, 8>{-700, -500, -30, -1, 1, 30, 500, 700};
  if (!is_moderate(scene, most)) return;
  const Check check(scene);
  const int k = steps[static_cast<std::size_t>(choice) % steps.size()];
  const Scene<A, B> other{scaled(scene.a, k), scaled(scene.b, k)};
  const Toi<S> here = time_of_impact(scene.a, scene.b), there = time_of_impact(other.a, other.b);
  const std::string factor = "times 2^" + std::to_string(k) + ": ";
  check(here.status == there.status && here.time == there.time, "closed form: scale changes the time",
        [&] { return text(here) + "\n  " + factor + text(there); });
  check(here.normal == there.normal && times_power_of_two(here.point, k) == there.point,
        "closed form: scale changes the normal or the point",
        [&] { return text(here) + "\n  " + factor + text(there); });
  const Separation<S> near = separation(scene.a.shape, scene.b.shape), far = separation(other.a.shape, other.b.shape);
  check(times_power_of_two(near.distance, k) == far.distance && near.normal == far.normal,
        "separation(): scale changes it", [&] {
          return text(near.distance) + " " + text(near.normal) + "\n  " + factor + text(far.distance) + " " +
                 text(far.normal);
        });
  check(overlaps(scene.a.shape, scene.b.shape) == overlaps(other.a.shape, other.b.shape),
        "overlaps(): scale changes it", [&] { return factor; });
}

/// The certified answer, and the plain one beside it.
template <class A, class B> void check_certified(const Scene<A, B>& scene, const Toi<typename A::Scalar>& toi) {
  Check(scene).no_fault(judge_certified(exhibit(scene.a, scene.b), toi.status, double{toi.time}, is_judged(scene)), "",
                        [&] { return text(toi) + ";\n  "; });
}

/// One of the methods: its answer is whole, and one that claims never to be late is not.
template <class A, class B> void check_methods(const Scene<A, B>& scene, int choice) {
  using S = typename A::Scalar;
  const Check check(scene);
  int index = 0;
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      if (index++ != choice) return;
      const Toi<S> toi = time_of_impact(Method{}, scene.a, scene.b);
      check_answer(scene, std::string(Method::name), toi);
      constexpr bool claims = std::is_same_v<Method, ConservativeAdvancement<S>> ||
                              std::is_same_v<Method, Inclusion<S>> || std::is_same_v<Method, Speculative<S>>;
      if (!claims || !is_judged(scene)) return;
      const Judgment judgment = judge_never_late(exhibit(scene.a, scene.b), toi.status, double{toi.time});
      check.no_fault(judgment, std::string(Method::name) + ": ", [&] { return text(toi) + ", "; });
    }
  });
}

}  // namespace thinwall::fuzz
