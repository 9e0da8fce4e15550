#pragma once
/// When a moving point first comes within R of a convex core: a segment, a parallelogram, a triangle, a box and a segment.
///
/// The core is known by one function, closest(x): the flat part of it that is nearest to x (a corner, an edge, a face) and
/// the gap from there. Extended without end, a corner, a line or a plane rounded by R has a closed-form entry time that does
/// not cancel (ball_entry.hpp's perpendicular form, in three, two and one dimensions). The walk solves the part nearest
/// now, moves to its answer, and looks again: the same part nearest there proves the answer, because the distance to a
/// convex core is convex along the motion. Another part is solved in its turn; where an answer overshoots, a Newton step,
/// which passes the first contact by roundings at most, takes its place.
///
/// Error: forward at most 4 u kappa t, backward at most 4 u (docs/closed_forms.md). Source: derived there.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/entry/ball_entry.hpp>
#include <thinwall/discrete/entry/core_part.hpp>

namespace thinwall {

/// When the line p + v t enters and is closest to a part extended without end and rounded by R.
template <Scalar S> struct PartEntry {
  bool exists = false;               ///< it enters, while approaching
  S time = 0;                        ///< [1] of entry, where it exists
  S closest_time = 0;                ///< [1] of closest approach
  Vec3<S> normal = Vec3<S>::Zero();  ///< unit, away from the part, at entry
};

template <Scalar S> PartEntry<S> entry_by_chord(const Chord<S>& chord, const Vec3<S>& v) {
  PartEntry<S> entry{chord.exists && chord.approach > S(0), S(0), chord.approach / chord.speed_square, Vec3<S>::Zero()};
  if (!entry.exists) return entry;
  entry.time = chord.entry_time();
  entry.normal = chord.entry_normal(v);
  return entry;
}

template <Scalar S> PartEntry<S> corner_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R) {
  return entry_by_chord(chord_through_ball(p, v, R), v);
}

/// Seen along the edge the line is a point and its rounding a disc: p x d, v x d and R |d| take the places of p, v and R. So d
/// is not made unit, which would turn it by a rounding.
template <Scalar S> PartEntry<S> edge_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& direction, const S& R) {
  using std::sqrt;
  const Vec3<S> d = times_power_of_two(direction, -binary_exponent(largest(direction)));  // about 1 long
  const S length_square = d.squaredNorm();
  const Vec3<S> w = accurate_cross(v, d);
  if (w == Vec3<S>::Zero()) return {};  // along the edge: the distance to its line does not change
  const auto accurate = [&] { return accurate_edge_discriminant(p, v, d, R) * (length_square * length_square); };
  PartEntry<S> entry = entry_by_chord<S>(chord_through_ball<S>(cross(p, d), w, R * sqrt(length_square), accurate), w);
  if (entry.exists) entry.normal = safe_unit(cross(d, entry.normal));
  return entry;
}

template <Scalar S> PartEntry<S> face_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& direction, const S& R) {
  const Vec3<S> n = safe_unit(direction);
  const S height = p.dot(n), speed = v.dot(n);
  if (speed == S(0)) return {};
  PartEntry<S> entry{(height > S(0)) != (speed > S(0)), S(0), -height / speed, Vec3<S>::Zero()};
  if (!entry.exists) return entry;
  entry.time = (largest(height) - R) / largest(speed);
  entry.normal = speed > S(0) ? Vec3<S>(-n) : n;
  return entry;
}

template <Scalar S> PartEntry<S> part_entry(const CorePart<S>& part, const Vec3<S>& p, const Vec3<S>& v, const S& R) {
  const Vec3<S> from_part = p - part.origin;
  switch (part.kind) {
    case CorePart<S>::corner: return corner_entry(from_part, v, R);
    case CorePart<S>::edge: return edge_entry(from_part, v, part.direction, R);
    case CorePart<S>::face: return face_entry(from_part, v, part.direction, R);
  }
  return {};
}

/// First time t >= 0 at which p + v t is within R of the core. `size` [length] is the core's own, for the noise level.
/// No contact lies before `not_before` [1] >= 0; > 0 says that there is none at the start either.
/// Requires lengths and displacements whose products of four are in range.
template <Scalar S, class Closest>
Entry<S> core_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R, const S& size, const Closest& closest,
                    const S& not_before = S(0)) {
  constexpr int round_limit = 256;
  Entry<S> answer;
  S least = std::numeric_limits<S>::infinity();  // of all places looked at: a step far past a graze leaves its doubt
  const auto look = [&](const S& time) {
    CorePart<S> nearest = closest(p + v * time);
    least = std::min(least, nearest.distance());
    return nearest;
  };
  S free = not_before, now = not_before;  // no contact before `free`; `part` is the nearest at `now`
  CorePart<S> part = look(now);
  answer.inside = not_before == S(0) && (part.contains_point() || within(part.gap, R));
  if (answer.inside) return answer;
  const S sizes = largest(p, S(R + size)), noise = gap_noise(sizes);
  const S speed = largest(v), speed_noise = gap_noise(speed);
  // What closes slowly, even where it meets the rounding of an edge, is known to noise over that: another part may be met then.
  const auto hit = [&](const S& time, const Vec3<S>& normal) {
    answer.time = time;
    answer.normal = normal == Vec3<S>::Zero() ? Vec3<S>(-safe_unit(v)) : normal;
    if (R <= noise && answer.normal.dot(v) > speed_noise)
      answer.normal = -normal;  // the side it is seen from is rounding
    const S closing = largest(answer.normal.dot(v)), off = 4 * noise / closing;
    const auto met_at = [&](const S& at) { return closest(p + v * at).id; };
    if (closing * closing * R < 64 * noise * speed * speed)
      answer.graze = !is_finite(off) || met_at(time - off) != met_at(time) || met_at(time) != met_at(time + off);
    return answer;
  };
  const auto miss = [&] {
    answer.graze = least - R <= near_miss(sizes);
    return answer;
  };
  // This near, the side it is seen from is rounding: what has it inside a moment later did not recede.
  const auto miss_unless_soon_inside = [&](const CorePart<S>& nearest, const S& time) {
    const bool decided = nearest.distance() - R > noise || speed == S(0);
    const bool inside_soon = !decided && closest(p + v * S(time + 4 * noise / speed)).distance() < R;
    return inside_soon ? hit(time, nearest.outward()) : miss();
  };
  // A path along an edge passes a corner where the edge begins, to rounding, and may close in on that; and so with a face.
  int passed = 0;
  const auto goes_on = [&](const CorePart<S>& nearest, const S& time) {
    const S across = nearest.kind == CorePart<S>::edge ? largest(cross(v, safe_unit(nearest.direction))) : speed;
    const S soon = time + 4 * noise / across;
    if (!is_finite(soon) || ++passed > 4) return false;
    const CorePart<S> next = look(soon);
    if (next.id == nearest.id || !(next.closing_speed(v) > S(0))) return false;
    free = next.distance() > R ? soon : time;  // convex: it has come nearer all the while
    now = soon;
    part = next;
    return true;
  };
  int touches = 0;
  bool touched = false;                      // in contact at `now`, to rounding
  Vec3<S> touched_normal = Vec3<S>::Zero();  // of the part that led there
  while (++answer.rounds < round_limit) {
    const S closing = part.closing_speed(v);
    if (touched && largest(closing) <= speed_noise)
      return hit(now, part.outward());  // along it: no other time is any better
    if (touched && part.contains_point() && !(closing > S(0))) return hit(now, touched_normal);  // its side is rounding
    if (!(closing > S(0))) {  // convex: what recedes does not come back
      if (!touched && goes_on(part, now)) continue;
      return miss_unless_soon_inside(part, now);
    }
    const PartEntry<S> entry = part_entry(part, p, v, R);
    const S target = std::max(free, entry.exists ? entry.time : entry.closest_time);
    if (!is_finite(target)) return answer;
    const CorePart<S> there = look(target);
    if (there.id == part.id) {
      // Where another part was as near, to rounding, a step by its normal may have passed this one's entry, which then proves itself.
      const bool passed_by = entry.exists && entry.time < free && there.distance() < R;
      const S earlier = std::max(not_before, entry.time);
      if (passed_by && closest(p + v * earlier).id == part.id) return hit(earlier, entry.normal);
      if (entry.exists) return hit(target, entry.normal);
      if (goes_on(there, target)) continue;
      return miss_unless_soon_inside(there, target);
    }
    const S ahead = there.distance() - R;
    const bool is_there = entry.exists && entry.time <= free && ahead <= noise;  // what is left is rounding
    if (is_there || (ahead == S(0) && R == S(0))) return hit(target, entry.normal);
    const bool before = ahead > S(0) && there.closing_speed(v) > S(0) && target > free;
    const bool touching = ahead <= S(0) && ahead >= -noise && ++touches < 4;  // to rounding: let that part have its say
    if (before || touching) {
      if (before) free = target;
      touched = touching;
      touched_normal = entry.exists ? entry.normal : part.outward();
      now = target;
      part = there;
      continue;
    }
    const S step = (part.distance() - R) / closing,
            next = now + step;  // Newton: not past the first contact, but for roundings
    if (touched && largest(step) * speed > noise) return hit(now, part.outward());  // what is left is rounding
    if (!(next > free) || next == now) return hit(std::max(free, next), part.outward());
    free = now = next;
    touched = false;
    part = look(now);
  }
  answer.gave_up = true;
  answer.time = free;
  return answer;
}

/// core_entry for a core spanned by vectors, at any scale; closest(x, spans...) gets all of them at a scale that is safe.
template <Scalar S, class Closest, class... Spans>
Entry<S> core_entry_at_any_scale(const Closest& closest, const Vec3<S>& p, const Vec3<S>& v, const S& R,
                                 const Spans&... spans) {
  const auto entry_of = [&closest](const Vec3<S>& from, const Vec3<S>& along, const S& reach, const auto&... scaled) {
    return core_entry(from, along, reach, largest(scaled...), [&](const Vec3<S>& x) { return closest(x, scaled...); });
  };
  return entry_at_safe_scale<S>(entry_of, p, v, R, spans...);
}

}  // namespace thinwall
