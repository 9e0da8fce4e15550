/// Sums and products without rounding, against fractions of integers.

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <thinwall/discrete/numbers/exact_number.hpp>

namespace thinwall {
namespace {

using Fraction = boost::multiprecision::cpp_rational;

template <class S> Fraction value(const ExactNumber<S>& number) {
  Fraction sum = 0;
  for (const S& term : number.terms) sum += Fraction(static_cast<double>(term));
  return sum;
}

template <class S> class ExactNumbers : public ::testing::Test {
 public:
  /// Full digits at exponents far apart, of which two cancel now and then.
  S drawn(int exponents) {
    const S x = std::ldexp(S(static_cast<double>(engine_()) * 0x1p-64) + S(1), pick(-exponents, exponents));
    if (pick(0, 3) != 0) last_ = pick(0, 1) == 0 ? x : -x;
    return last_;
  }
  int pick(int low, int high) { return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1)); }

 private:
  std::mt19937_64 engine_{20261123};
  S last_ = 1;
};
using Plain = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ExactNumbers, Plain, );

TYPED_TEST(ExactNumbers, are_what_fractions_say) {
  using S = TypeParam;
  const int exponents = std::numeric_limits<S>::max_exponent / 8;
  for (int i = 0; i < 300; ++i) {
    ExactNumber<S> number = this->drawn(exponents);
    Fraction truth(static_cast<double>(number.rounded()));
    for (int step = 0; step < 12; ++step) {
      const S x = this->drawn(exponents), y = this->drawn(exponents);
      const ExactNumber<S> product = ExactNumber<S>(x) * ExactNumber<S>(y);
      const Fraction part = Fraction(static_cast<double>(x)) * Fraction(static_cast<double>(y));
      ASSERT_EQ(value(product), part);
      const bool adds = this->pick(0, 1) == 0;
      number = adds ? number + product : number - product;
      truth += adds ? part : Fraction(-part);
      ASSERT_EQ(value(number), truth);
      ASSERT_EQ(number.sign(), truth.sign());
      ASSERT_LE(std::abs(number.rounded() - static_cast<S>(truth)),
                std::abs(number.rounded()) * 2 * std::numeric_limits<S>::epsilon());
    }
    if (number.terms.size() < 8) number = number * number;
    for (std::size_t k = 1; k < number.terms.size(); ++k) {
      const S above = std::abs(number.terms[k]);
      ASSERT_LE(std::abs(number.terms[k - 1]), std::nextafter(above, std::numeric_limits<S>::infinity()) - above);
    }
  }
}

/// One bit at every exponent, the longest numbers that there are, must find room.
TYPED_TEST(ExactNumbers, have_room_for_every_bit_of_the_range) {
  using S = TypeParam;
  using Limits = std::numeric_limits<S>;
  ExactNumber<S> number;
  const int lowest = Limits::min_exponent - Limits::digits;
  for (int e = Limits::max_exponent - 1; e >= lowest; --e) {
    number += std::ldexp(S(e % 3 == 0 ? -1 : 1), e);
    ASSERT_LE(number.terms.size() * sizeof(S) + sizeof(std::size_t), sizeof(number));
  }
  EXPECT_GT(number.terms.size(), static_cast<std::size_t>((Limits::max_exponent - lowest) / (Limits::digits + 2)));
  for (int e = lowest; e < Limits::max_exponent; ++e) number += std::ldexp(S(e % 3 == 0 ? 1 : -1), e);
  EXPECT_TRUE(number.terms.empty());
}

}  // namespace
}  // namespace thinwall
