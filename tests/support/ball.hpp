#pragma once
/// Numbers that know how wrong they are: a midpoint and a radius, by the library Arb. Whatever is computed from balls encloses whatever
/// could be computed from the numbers in them, so that a ball above zero is a proof.

#include <string>
#include <type_traits>
#include <utility>

#include <arb.h>

namespace thinwall::oracle {

class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  /// The very number, whatever its digits: a sum of doubles.
  template <class N> explicit Ball(const N& number) : Ball() {
    if constexpr (std::is_same_v<N, double> || std::is_integral_v<N>) {
      arb_set_d(x_, static_cast<double>(number));
    } else {
      N rest = number;
      while (rest != N(0)) {
        const auto part = static_cast<double>(rest);
        rest -= N(part);
        const Ball exact(part);
        arb_add(x_, x_, exact.x_, ARF_PREC_EXACT);
      }
    }
  }
  /// The least ball that holds both.
  static Ball hull(const Ball& a, const Ball& b) {
    Ball both;
    arb_union(both.x_, a.x_, b.x_, precision());
    return both;
  }

  /// [bits] that midpoints are rounded to, from now on and in this thread.
  static slong& precision() {
    thread_local slong bits = 64;
    return bits;
  }

  friend Ball operator+(const Ball& a, const Ball& b) { return made(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return made(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return made(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return made(arb_div, a, b); }
  Ball operator-() const { return made(negated); }
  Ball& operator+=(const Ball& other) {
    arb_add(x_, x_, other.x_, precision());
    return *this;
  }
  Ball& operator-=(const Ball& other) {
    arb_sub(x_, x_, other.x_, precision());
    return *this;
  }
  friend Ball sqrt(const Ball& a) { return a.made(arb_sqrtpos); }
  friend Ball abs(const Ball& a) { return a.made(without_sign); }
  friend Ball max(const Ball& a, const Ball& b) { return made(arb_max, a, b); }
  friend Ball min(const Ball& a, const Ball& b) { return made(arb_min, a, b); }
  friend std::pair<Ball, Ball> sine_and_cosine(const Ball& a) {
    std::pair<Ball, Ball> both;
    arb_sin_cos(both.first.x_, both.second.x_, a.x_, precision());
    return both;
  }

  /// For certain: of every number in it.
  bool is_positive() const { return arb_is_positive(x_) != 0; }
  bool is_negative() const { return arb_is_negative(x_) != 0; }
  bool is_not_negative() const { return arb_is_nonnegative(x_) != 0; }
  bool is_zero() const { return arb_is_zero(x_) != 0; }
  bool is_finite() const { return arb_is_finite(x_) != 0; }
  friend bool certainly_less(const Ball& a, const Ball& b) { return arb_lt(a.x_, b.x_) != 0; }

  /// Near the midpoint.
  double rough() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }
  /// So many digits, of which the last may be off by one; fewer where the ball is wider than that.
  std::string digits(int count) const {
    char* text = arb_get_str(x_, count, ARB_STR_NO_RADIUS);
    std::string copy = text;
    flint_free(text);
    return copy;
  }

 private:
  static void negated(arb_t made, const arb_t x, slong) { arb_neg(made, x); }
  static void without_sign(arb_t made, const arb_t x, slong) { arb_abs(made, x); }
  template <class F> Ball made(const F& f) const {
    Ball result;
    f(result.x_, x_, precision());
    return result;
  }
  template <class F> static Ball made(const F& f, const Ball& a, const Ball& b) {
    Ball result;
    f(result.x_, a.x_, b.x_, precision());
    return result;
  }

  arb_t x_;
};

/// So many bits for as long as it lives.
class BallPrecision {
 public:
  explicit BallPrecision(slong bits) : before_(std::exchange(Ball::precision(), bits)) {}
  ~BallPrecision() { Ball::precision() = before_; }
  BallPrecision(const BallPrecision&) = delete;
  BallPrecision& operator=(const BallPrecision&) = delete;

 private:
  slong before_;
};

}  // namespace thinwall::oracle
