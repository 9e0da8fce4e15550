#pragma once
/// The clear cases of a moving point and a flat core rounded by R, a triangle or a parallelogram: its face, its edges and its corners all at
/// once, none waiting for another.
///
/// The rounded core is the prism of its face, R to either side, and a cylinder around each edge, a ball around each corner. It is entered at
/// the earliest of their times; where two join they have one tangent plane, so that a place taken for its neighbor's gives the same time.
/// An edge D is met as in clear_segment_entry.hpp, by k = P x D and w = v x D. They tell too how far inside of an edge the plane of the face
/// is met: -N.(k + w t).
///
/// Most misses are told before any root: a line that passes the cylinder of an edge on its outer side passes all of the core, as the plane
/// through the edge along v has that on one side, R or more from the line. There k.v is of the sign of N.v.

#include <thinwall/discrete/clear/clear_entry.hpp>
#include <thinwall/discrete/clear/clear_triangle.hpp>
#include <thinwall/discrete/clear/vectors.hpp>

namespace thinwall {

/// The convex core { s d + u f }, in lanes: a corner each, and an edge from there. A triangle's last lane repeats the third.
struct ClearFlat {
  packed::Lanes d, f;
  packed::Vectors<packed::Lanes> corner, edge;
  packed::Lanes ahead;  ///< 1, or -1 where the edge comes to its corner
  /// s and u of a corner, and by how much they change along its edge.
  packed::Lanes s, u, by_s, by_u;

  packed::PairMask has_fourth;  ///< d + f is a corner too

  /// How far it reaches along a vector of which these are the products with d and f.
  THINWALL_HOT packed::Pair reach(const packed::Pair& of_d_f) const {
    const packed::Pair one = max(max(of_d_f, swapped(of_d_f)), packed::both(0));
    return max(one, keep(has_fourth, of_d_f + swapped(of_d_f)));
  }

  /// s, u >= 0, s + u <= 1.
  THINWALL_HOT static ClearFlat triangle(const ClearTriangle& of) {
    using packed::both, packed::lanes, packed::pair;
    return {of.d,
            of.f,
            of.corners(),
            of.edges(),
            packed::all(1),
            lanes(pair(0, 1), pair(0, 0)),
            lanes(pair(0, 0), pair(1, 1)),
            lanes(pair(1, -1), pair(0, 0)),
            lanes(pair(0, 1), pair(-1, -1)),
            both(1) < both(0)};
  }
  /// s and u in [0, 1].
  THINWALL_HOT static ClearFlat parallelogram(const packed::Lanes& d, const packed::Lanes& f) {
    using packed::Pair, packed::both, packed::lanes, packed::pair;
    const auto corners = [](const Pair& of) {
      const Pair sum = of + swapped(of);
      return lanes(firsts(both(0), of), firsts(sum, swapped(of)));
    };
    const Pair x = firsts(xy_of(d), xy_of(f)), y = seconds(xy_of(d), xy_of(f)), z = firsts(zz_of(d), zz_of(f));
    return {d,
            f,
            {corners(x), corners(y), corners(z)},
            {lanes(x, x), lanes(y, y), lanes(z, z)},
            lanes(both(1), both(-1)),
            lanes(pair(0, 1), pair(1, 0)),
            lanes(pair(0, 0), pair(1, 1)),
            lanes(pair(1, 0), pair(-1, 0)),
            lanes(pair(0, 1), pair(0, -1)),
            both(0) < both(1)};
  }
};

/// First time at which p + v t is within R > 0 of a flat core.
struct ClearFlatEntry {
  bool clear;
  packed::Pair time;       ///< [1] >= 0, twice; ClearEntry::never for a miss
  packed::Pair s;          ///< [1] where on the core
  packed::Lanes normal;    ///< unit, out of the core; of no meaning for a miss
  packed::PairMask broad;  ///< d and f are 2^-4 from parallel
  unsigned passed;         ///< edges whose cylinders the line was told to pass on their outer side, as bits

  THINWALL_HOT ClearFlatEntry(const ClearFlat& core, const packed::Lanes& p, const packed::Lanes& v,
                              const packed::Pair& R) {
    using packed::Lanes, packed::LanesMask, packed::Pair, packed::PairMask, packed::Vectors, packed::all, packed::both;
    const Lanes zero = all(0), never = all(ClearEntry::never), n = cross(core.d, core.f);
    const Lanes graze = all(packed::beside_graze);
    const Pair rr = R * R, nn = dot(n, n), edges = two_sums(core.d * core.d, core.f * core.f);
    const Lanes RR = all(rr);
    const Vectors<Lanes> P = spread(p) - core.corner, V = spread(v), N = spread(n);
    const Vectors<Lanes>& D = core.edge;

    const Vectors<Lanes> k = cross(P, D), w = cross(V, D);
    const Lanes length = dot(D, D), k_k = dot(k, k), w_w = dot(w, w), k_w = dot(k, w), beside = dot(k, V);
    const Lanes start = dot(P, D) * core.ahead, by = dot(V, D) * core.ahead;
    const Lanes RR_d = RR * length, reach = w_w * RR, off = beside * beside;

    const Pair speed = dot(v, v), size = sum((abs(p) + abs(v)) + (abs(core.d) + abs(core.f))), squares = size * size;
    const PairMask in_range = (size * both(0x1p-14) <= R) & (squares * both(0x1p-54) <= speed) &
                              (both(packed::least_square) <= min(min(rr, speed), smallest_of(length))) &
                              (size <= both(packed::most_length));
    // all but along an edge, what rounding leans w along it counts by the way to its corner: ClearSide's aslant() and is_steady()
    const LanesMask aslant = all(max(squares * both(0x1p-50), speed) * both(0x1p-10)) * length <= w_w;
    const LanesMask passes = reach < off * graze;
    const Pair through = two_sums(n * p, n * v);
    const LanesMask on_outer_side = zero < beside * core.ahead * all(seconds(through));
    passed = all_of(in_range) ? four_bits(passes & aslant & on_outer_side) : 0U;
    if (passed != 0U) {
      clear = true, time = both(ClearEntry::never), s = both(0), normal = zero, broad = both(1) < both(0);
      return;
    }

    const Lanes side = (k_k - RR_d) / (root(max((reach - off) * length, zero)) - k_w), at = start + by * side;
    const LanesMask pierces = off < reach * graze;
    const LanesMask meets_side = pierces & (k_w < zero) & (zero <= side) & (zero <= at) & (at <= length);

    const Vectors<Lanes> moment = cross(P, V);
    const Pair wide = speed * rr;
    const Lanes square = dot(P, P), toward = dot(P, V), aside = dot(moment, moment);
    const Lanes ball = (square - RR) / (root(max(all(wide) - aside, zero)) - toward);
    const LanesMask strikes = aside < all(wide * both(packed::beside_graze));
    const Lanes earliest = min(select(meets_side, side, never), select(strikes & (toward < zero), ball, never));

    const Pair rate = abs(seconds(through));
    const Pair high = against(firsts(through), seconds(through)), by_edge = smallest_of(earliest);
    const Pair reach_n = R * root(nn), face = (high - reach_n) / rate;
    const Lanes outwards = dot(N, k) * core.ahead, inside = outwards + dot(N, w) * core.ahead * all(face);
    // a face this narrow is in the cylinders, all but its square over 8 R, and its plane is rounding
    const Pair narrowest = largest_of(RR_d) * both(0x1p-52);
    const PairMask by_face = (both(0) <= face) & (face <= by_edge) & (largest_of(inside) <= both(0)) & (narrowest < nn);
    time = select(by_face, face, by_edge);

    // where, by s and u
    const LanesMask met = lowest_of_four(earliest <= all(time));
    const Lanes on = max(min((start + by * all(time)) / length, all(1)), zero);
    const Lanes at_s = keep(met, core.s + core.by_s * on), at_u = keep(met, core.u + core.by_u * on);
    const Pair of_s = xy_of(at_s) + zz_of(at_s), of_u = xy_of(at_u) + zz_of(at_u);
    const Pair of_face = (both(0) - firsts(swapped(zz_of(inside)), xy_of(inside))) / nn;
    const Pair place = select(by_face, of_face, firsts(of_s, of_u) + seconds(of_s, of_u));
    s = firsts(place);
    const Lanes about = ((p + v * all(time)) - (core.d * all(s) + core.f * all(seconds(place)))) * all(both(1) / R);
    const Pair unit = dot(about, about);
    normal = nearer_unit(about, unit);

    const Pair extents = firsts(edges) * seconds(edges);
    broad = extents * both(0x1p-8) < nn;
    const LanesMask steady = pierces & (off * (all(speed * both(0x1p-6)) * length) <= reach * w_w);
    const LanesMask side_clear = ((steady | passes) & aslant) | (w_w <= zero);
    const LanesMask ball_clear = strikes | (all(wide) < aside * graze);
    const Lanes beyond = all(1 + 0x1p-30);  // a moment seen from 2^14 R is off by 2^-38 of itself
    const LanesMask outside = (RR * beyond < square) & ((RR_d * beyond < k_k) | (start < zero) | (length < start));
    const PairMask narrow = nn <= narrowest;
    const PairMask above = narrow | (both(0) < largest_of(outwards)) |
                           (reach_n + size * (firsts(edges) + seconds(edges)) * both(0x1p-48) < high);
    const PairMask plain = narrow | (extents * both(0x1p-40) <= nn);
    const PairMask steep = speed * nn * both(0x1p-16) < rate * rate;
    // beside what it was told to be of, the gap is as long to its square, and leans over the rest of the core
    const Pair leans = two_sums(about * core.d, about * core.f), lean = leans * place;
    const Pair over = core.reach(leans) - (lean + swapped(lean));
    const unsigned hit_clear =
        bits((abs(unit - both(1)) <= both(0x1p-28)) & (over * R <= squares * both(0x1p-50)) & (broad | narrow)) &
        (bits(steep) | ~bits(by_face));
    const unsigned all_clear = bits(in_range & above & plain) & (hit_clear | bits(both(1) < time));
    clear = (four_bits(side_clear & ball_clear & outside) | all_clear << 4U) == 63U;
  }
};

}  // namespace thinwall
