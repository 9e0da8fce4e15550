#pragma once
/// Times of impact known exactly: touches, grazes by one unit in the last place, extreme scales, thin walls.
///
/// Inputs are written as doubles. A scalar that does not hold one takes its nearest value, and then the oracle alone
/// says what is right; a scalar in which one overflows or vanishes leaves the case out.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/swept/time_of_impact.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {

template <class A, class B> struct ExactCase {
  std::string name;
  Moving<A> a;
  Moving<B> b;
  ToiStatus status;
  std::optional<double> listed;  ///< the time in double, from rational arithmetic
  bool as_written;               ///< the scalar holds every input: `status` must come out
};

/// Collects cases, and notes which inputs a scalar could not hold.
template <class S, class B> class CaseTable {
 public:
  using Case = ExactCase<Sphere<S>, B>;

  /// The scalar's value for x.
  S operator()(double x) {
    const S value = static_cast<S>(x);
    if (value - value != S(0) || (value == S(0) && x != 0)) out_of_range_ = true;
    if (oracle_differs(value, x)) as_written_ = false;
    return value;
  }
  Vec3<S> operator()(double x, double y, double z) { return {(*this)(x), (*this)(y), (*this)(z)}; }
  Sphere<S> ball(const Vec3<S>& center, double radius) { return {center, (*this)(radius)}; }

  void add(std::string name, const Moving<Sphere<S>>& a, const Moving<B>& b, ToiStatus status,
           std::optional<double> listed = {}) {
    if (!out_of_range_) cases_.push_back({std::move(name), a, b, status, listed, as_written_});
    out_of_range_ = false;
    as_written_ = true;
  }
  const std::vector<Case>& cases() const { return cases_; }

 private:
  static bool oracle_differs(const S& value, double x) {
    using Both =
        boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
    return Both(value) != Both(x);
  }

  bool out_of_range_ = false;
  bool as_written_ = true;
  std::vector<Case> cases_{};
};

}  // namespace thinwall::testing
