#pragma once
/// Rows for batches, plain and the worst, with the scalar code's answers.

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/swept/batch.hpp>
#include <thinwall/swept/batch/run.hpp>
#include <thinwall/swept/batch/table.hpp>

#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {

/// As many rows as asked for; a fiftieth where sanitized or not optimized.
inline std::size_t batch_rows_to_judge(std::size_t rows) { return thorough(slow_build ? rows / 50 + 1 : rows); }

template <class S> Vec3<S> spoiled(Vec3<S> v, Shaker<S>& draw) {
  const std::array bad = {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity(),
                          -std::numeric_limits<S>::infinity(), std::numeric_limits<S>::max(),
                          std::numeric_limits<S>::denorm_min()};
  v[draw.pick(0, 2)] = bad[static_cast<std::size_t>(draw.pick(0, 4))];
  return v;
}

/// drawn_motion, and some at rest, far too large or small for squares, or with a NaN or an infinity.
template <class A, class B, class S> Motion<A, B> batch_motion(Shaker<S>& draw) {
  Motion<A, B> motion = drawn_motion<A, B>(draw);
  const int far = std::numeric_limits<S>::max_exponent - 60;
  switch (draw.pick(0, 30)) {
    case 0: motion.a.displacement = motion.b.displacement; break;
    case 1: {
      const int e = draw.pick(-far - 80, far);
      motion = {scaled(motion.a, e), scaled(motion.b, e)};
      break;
    }
    case 2: motion.a.displacement = times_power_of_two(motion.a.displacement, draw.pick(-far, far)); break;
    case 3: motion.a.shape = scaled(motion.a.shape, -draw.pick(20, far)); break;
    case 4: motion.b.displacement = spoiled<S>(motion.b.displacement, draw); break;
    case 5: motion.a.displacement = spoiled<S>(motion.a.displacement, draw); break;
    case 6: motion.b.shape = scaled(motion.b.shape, -draw.pick(20, far)); break;
    default: break;
  }
  return motion;
}

template <class S> void spoil_size(Moving<Sphere<S>>& sphere, const S& size) { sphere.shape.radius = size; }
template <class S> void spoil_size(Moving<Capsule<S>>& capsule, const S& size) { capsule.shape.radius = size; }
template <class Box, class S> void spoil_size(Moving<Box>& box, const S& size) { box.shape.half_extents[1] = size; }

template <class A, class B> struct BatchRows {
  using S = typename A::Scalar;
  RowTable<Moving<A>> a;
  RowTable<Moving<B>> b;
  std::vector<Toi<double>> truth;  ///< by the scalar code, in double

  BatchRows(std::size_t count, unsigned seed) {
    Shaker<S> draw(seed);
    for (std::size_t i = 0; i < count; ++i) {
      Motion<A, B> motion = batch_motion<A, B>(draw);
      const int bad = draw.pick(0, 200);
      if (bad == 0) spoil_size(motion.a, S(-1));
      if (bad == 1) spoil_size(motion.b, -std::numeric_limits<S>::denorm_min());
      if (bad == 2) spoil_size(motion.b, std::numeric_limits<S>::quiet_NaN());
      if (bad == 3) spoil_size(motion.a, std::numeric_limits<S>::infinity());
      a.push_back(motion.a);
      b.push_back(motion.b);
      const Toi<S> toi = time_of_impact(motion.a, motion.b);
      const Toi<double> fine = toi.status == ToiStatus::hit
                                   ? time_of_impact(widened<double>(motion.a), widened<double>(motion.b))
                                   : Toi<double>{};
      truth.push_back({toi.status, 0, fine.time, fine.normal, fine.point});
    }
  }

  bool has_every_status() const {
    std::array<int, 5> seen{};
    for (const Toi<double>& toi : truth) ++seen[static_cast<std::size_t>(toi.status)];
    return seen[0] > 0 && seen[1] > 0 && seen[2] > 0 && seen[4] > 0;
  }
};

/// visit(target) with each kind of vectors that this machine has, of which the best is then taken again.
template <class Visit> void for_each_target(const Visit& visit) {
  for (const std::string& target : vector_targets()) {
    SCOPED_TRACE(target);
    use_vectors(target);
    visit(target);
  }
  use_vectors("");
}

template <class S> struct Answers {
  std::vector<ToiStatus> status;
  std::vector<S> time;
  explicit Answers(std::size_t rows) : status(rows, ToiStatus::gave_up), time(rows, S(-1)) {}
  ToiRows<S> rows() { return {status, time}; }
};

}  // namespace thinwall::testing
