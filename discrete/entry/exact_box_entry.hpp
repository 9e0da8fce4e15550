#pragma once
/// When a moving point first enters a box, decided without rounding: for faces that it meets at once to rounding.
///
/// Plain arithmetic has a face's time to 2 u kappa t (docs/closed_forms.md), which is much where the face closes slowly. Told for the time
/// of a quick one that is truly the last, it is off by more than that one's 4 u kappa t, unless the kappas are within a factor of 2. So the
/// lengths are given as they came, before any difference of theirs was rounded; on each axis two conditions are linear in the time.
/// Source: the slabs are Ericson, Real-Time Collision Detection, 2005, section 5.3.3; the doubt is derived here.

#include <limits>
#include <optional>

#include <thinwall/discrete/entry/exact_flat_entry.hpp>

namespace thinwall {

/// Whether the axis entered last, at `time`, may be another one whose time is known twice as well: the farther end of an axis's interval is
/// what roundings take a part of, over its speed. An axis without motion has infinite ends, and is not the last.
template <Scalar S> bool is_last_in_doubt(const Vec3<S>& enter, const Vec3<S>& leave, int last, const S& time) {
  const Vec3<S> noise = 16 * std::numeric_limits<S>::epsilon() * enter.cwiseAbs().cwiseMax(leave.cwiseAbs());
  for (int i = 0; i < 3; ++i) {
    if (2 * noise[i] < noise[last] && enter[i] >= time - 2 * noise[last]) return true;
  }
  return false;
}

/// A difference or a sum that has not been rounded, of lengths or of displacements.
template <Scalar S> struct ExactTwo {
  Vec3<S> first, second;

  ExactNumber<S> sum(int i) const { return ExactNumber<S>(first[i]) + ExactNumber<S>(second[i]); }
  ExactNumber<S> difference(int i) const { return ExactNumber<S>(first[i]) - ExactNumber<S>(second[i]); }
};

/// First time t >= 0 at which a point is in a box: it starts at `place` from the box's center and moves by `path`, both the first less the
/// second; the box reaches the sum of `halves`. Nothing if it starts there or never is.
/// Error: the face is right; the time is off by a few u of itself.
template <Scalar S>
std::optional<Entry<S>> exact_box_entry(const ExactTwo<S>& place, const ExactTwo<S>& path, const ExactTwo<S>& halves) {
  using W = ExactOfAny<S>;
  const int length = binary_exponent(largest(place.first, place.second, halves.first, halves.second)),
            displacement = binary_exponent(largest(path.first, path.second));
  const auto scaled = [](const ExactTwo<S>& of, int exponent) {
    return ExactTwo<W>{near_one<W>(of.first, exponent), near_one<W>(of.second, exponent)};
  };
  const ExactTwo<W> x = scaled(place, length), h = scaled(halves, length), v = scaled(path, displacement);
  ExactStretch<W> stretch(std::numeric_limits<W>::infinity());
  for (int i = 0; i < 3; ++i) {
    const ExactNumber<W> at = x.difference(i), half = h.sum(i), speed = v.difference(i);
    stretch.not_negative(half + at, speed, axis_vector<W>(i, true));
    stretch.not_negative(half - at, -speed, axis_vector<W>(i, false));
  }
  if (stretch.empty || stretch.first.sign() == 0) return std::nullopt;
  const W time = stretch.first.rounded() / stretch.first_denominator.rounded();
  Entry<S> entry;
  entry.time = static_cast<S>(times_power_of_two(time, length - displacement));
  entry.normal = stretch.edge.template cast<S>();
  return entry;
}

}  // namespace thinwall
