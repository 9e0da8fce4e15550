#pragma once
/// Two moving shapes, their types put aside, for a judge that is compiled once and not for every pair, and what it judges.
/// Doubles hold all of them exactly.
///
/// Errors are backward: by how much, in units of round-off u, each coordinate, size and displacement would have to change
/// for the answer to be exact. To first order that is the separation over
///   sum |n_i| (|cA| + |cB| + h + t (|vA| + |vB|))_i + R.

#include <limits>
#include <optional>
#include <string>
#include <variant>

#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall::fuzz {

template <class List> struct VariantOf;
template <class... Types> struct VariantOf<TypeList<Types...>> {
  using type = std::variant<Types...>;
};
using AnyShape = VariantOf<Shapes<double>>::type;

struct Exhibit {
  AnyShape a, b;
  Vec3<double> displacement_a = Vec3<double>::Zero(), displacement_b = Vec3<double>::Zero();
  double u = 0, least = 0;    ///< of the scalar that was asked: unit round-off, smallest positive number
  double min_separation = 0;  ///< [length] the gap that counts as contact
};

template <class A, class B> Exhibit exhibit(const Moving<A>& a, const Moving<B>& b, double min_separation = 0) {
  using Limits = std::numeric_limits<typename A::Scalar>;
  return {cast<double>(a.shape),
          cast<double>(b.shape),
          a.displacement.template cast<double>(),
          b.displacement.template cast<double>(),
          double{Limits::epsilon()} / 2,
          double{Limits::denorm_min()},
          min_separation};
}

/// What is wrong with an answer, in words and with figures.
struct Fault {
  std::string property, details;
};
using Judgment = std::optional<Fault>;

/// Holds a time of impact to a backward error of `allowed` u, in verdict and time.
Judgment judge_impact(const Exhibit& exhibit, ToiStatus status, double time, double allowed);

/// Holds a time to the claim that nothing touches before, and that no contact is missed: to the last bit.
Judgment judge_never_late(const Exhibit& exhibit, ToiStatus status, double time);

/// Holds a separation and a yes-or-no at the start to a few u of the sum of all coordinates and sizes.
Judgment judge_separation(const Exhibit& exhibit, double distance, const Vec3<double>& normal, bool overlap);

/// Holds a proven verdict and bracket to the truth, as far as 50 digits tell.
Judgment judge_bracket(const Exhibit& exhibit, ToiStatus verdict, double lower, double upper);

/// Holds a time to the proven bracket, widened by `allowed` u kappa t.
Judgment judge_time(const Exhibit& exhibit, double time, double lower, double upper, double allowed);

/// Asks for a certified time of impact, both ways round, and holds it to be whole; where `judged`, holds it to the oracle,
/// and the plain answer to it: a verdict that differs, or a time outside the bracket, by no more than 4 u.
Judgment judge_certified(const Exhibit& exhibit, ToiStatus plain, double time, bool judged);

}  // namespace thinwall::fuzz
