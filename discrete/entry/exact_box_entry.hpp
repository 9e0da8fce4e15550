#pragma once
/// When a moving point first enters a box, decided without rounding: for faces that it meets at once to rounding.
///
/// Plain arithmetic has a face's time to 2 u kappa t (docs/closed_forms.md), which is much where the face closes slowly. Told for the time
/// of a quick one that is truly the last, it is off by more than that one's 4 u kappa t, unless the kappas are within a factor of 2. So the
/// lengths are given as they came, before any difference of theirs was rounded; on each axis two conditions are linear in the time.
/// Source: the slabs are Ericson, Real-Time Collision Detection, 2005, section 5.3.3; the doubt is derived here.

#include <thinwall/discrete/entry/flat_entry.hpp>

namespace thinwall {

/// Whether the axis entered last may be another one whose time is known twice as well: the farther end of an axis's interval is what
/// roundings take a part of, over its speed. An axis without motion has infinite ends, and is not the last.
template <Scalar S> bool is_last_in_doubt(const Vec3<S>& enter, const Vec3<S>& leave, int last) {
  const Vec3<S> noise = 16 * std::numeric_limits<S>::epsilon() * enter.cwiseAbs().cwiseMax(leave.cwiseAbs());
  for (int i = 0; i < 3; ++i) {
    if (2 * noise[i] < noise[last] && enter[i] >= enter[last] - 2 * noise[last]) return true;
  }
  return false;
}

/// A difference or a sum that has not been rounded, of lengths or of displacements.
template <Scalar S> struct ExactTwo {
  Vec3<S> first, second;
};

/// First time t in [0, last] at which a point is in a box: it starts at `place` from the box's center and moves by `path`, both the first
/// less the second; the box reaches the sum of `halves`. Infinity if there is none. `last` [1] >= 0 may be infinite.
/// Error: the verdict and the face are right; the time is off by a few u of itself. Unless products of lengths and displacements underflow.
template <Scalar S>
Entry<S> exact_box_entry(const ExactTwo<S>& place, const ExactTwo<S>& path, const ExactTwo<S>& halves, const S& last) {
  const SafeScale<S> scale(largest(place.first, place.second, halves.first, halves.second),
                           largest(path.first, path.second));
  ExactStretch<S> stretch(scale.time(last));
  for (int i = 0; i < 3; ++i) {
    const auto length = [&](const Vec3<S>& v) { return ExactNumber<S>(scale.length(v[i])); };
    const auto displacement = [&](const Vec3<S>& v) { return ExactNumber<S>(scale.displacement(v[i])); };
    const ExactNumber<S> x = length(place.first) - length(place.second),
                         h = length(halves.first) + length(halves.second);
    const ExactNumber<S> v = displacement(path.first) - displacement(path.second);
    stretch.not_negative(h + x, v, axis_vector<S>(i, true));
    stretch.not_negative(h - x, -v, axis_vector<S>(i, false));
  }
  Entry<S> entry;
  if (stretch.empty) return entry;
  entry.inside = stretch.first.sign() == 0;
  if (entry.inside) return entry;
  entry.time = std::min(last, scale.time_back(S(stretch.first.rounded() / stretch.first_denominator.rounded())));
  entry.normal = stretch.edge;
  return entry;
}

}  // namespace thinwall
