// Answers against the oracle: in long double, and at 50 digits where that finds fault.

#include <cmath>

#include "fuzz/finding.hpp"
#include "fuzz/referee.hpp"

namespace thinwall::fuzz {
namespace {

template <class R> double narrow(const R& x) { return static_cast<double>(x); }
template <class R> R size_of(const R& x) { return x < 0 ? R(-x) : x; }

template <class R> Judgment judge_impact_in(const Exhibit& exhibit, ToiStatus status, double time, double allowed) {
  const Referee<R> referee(exhibit);
  const R u = exhibit.u, t = time;
  const auto in_u = [&](const typename Referee<R>::State& s) { return narrow(R(s.margin / u)); };
  const auto fault = [](const char* property, double backward, const R& truly) {
    return Fault{property, std::to_string(backward) + " u, truly at " + text(narrow(truly))};
  };
  const auto truth = referee.first_contact(status == ToiStatus::hit ? R(t * (1 - 1024 * u)) : R(0));
  const bool touches = truth.verdict != oracle::Verdict::apart;
  if (status == ToiStatus::overlapping) {
    const double start = in_u(referee.at(R(0)));
    if (start > allowed) return fault("overlapping, yet apart at the start", start, truth.time);
    return {};
  }
  if (status == ToiStatus::apart) {
    const double depth = touches ? in_u(referee.deepest(truth.time)) : 0.0;
    if (depth < -allowed) return fault("missed", depth, truth.time);
    return {};
  }
  if (truth.verdict == oracle::Verdict::overlapping) {  // no rounding hides contact this deep
    const double start = in_u(referee.at(R(0)));
    if (start < -allowed) return fault("hit, yet in contact at the start", start, truth.time);
    return {};
  }
  const double there = in_u(referee.at(t));
  if (there <= allowed && there >= -allowed) return {};
  if (touches && size_of(R(t - truth.time)) <= exhibit.least) return {};
  // A displacement that much longer or shorter makes it exact: where the first contact is that near, or the separation
  // changes sign about the time.
  if (touches && size_of(R(t - truth.time)) <= allowed * u * t) return {};
  const R before = referee.at(R(t * (1 - allowed * u))).gap, after = referee.at(R(t * (1 + allowed * u))).gap;
  if (before >= 0 && after <= 0) return {};
  return fault(!touches ? "a hit that is a miss" : there > 0 ? "early" : "late", there, truth.time);
}

/// In long double only what is clear passes.
template <class R> Judgment judge_never_late_in(const Exhibit& exhibit, ToiStatus status, double time) {
  constexpr bool rough = std::is_same_v<R, long double>;
  const Referee<R> referee(exhibit);
  const R clear = referee.size_at(R(1)) * (rough ? R(ldexp(R(1), -50)) : R(0));
  if (status != ToiStatus::apart) {
    const auto there = referee.at(R(time));
    if (there.gap > clear && there.closing > 0) return {};
  }
  const auto truth = referee.first_contact(R(0));
  const bool touches = truth.verdict != oracle::Verdict::apart;
  const std::string truly = "truly at " + text(narrow(truth.time));
  if (status == ToiStatus::apart) {
    const R deepest = referee.deepest(touches ? truth.time : R(0)).gap;
    const bool rests = exhibit.displacement_a == exhibit.displacement_b;  // then overlaps() decides, to rounding
    if (rests && deepest >= -8 * R(exhibit.u) * referee.size_at(R(0))) return {};
    if (touches ? deepest < 0 : rough && deepest <= clear) return Fault{"missed", truly};
    return {};
  }
  const R slack = truth.time * (rough ? R(ldexp(R(1), -50)) : R(ldexp(R(1), -140)));
  const bool late = rough ? R(time) >= truth.time - slack : R(time) > truth.time + slack;
  if (touches && late) return Fault{"late", truly};
  return {};
}

template <class R>
Judgment judge_separation_in(const Exhibit& exhibit, double distance, const Vec3<double>& normal, bool overlap) {
  const Referee<R> referee(exhibit);
  const R rounding = R(exhibit.u) * referee.size_at(R(0)) + R(exhibit.least);
  const R truth = referee.at(R(0)).gap, core = truth + referee.reach();
  const auto in_roundings = [&](const R& x) { return std::to_string(narrow(R(x / rounding))) + " u size"; };
  const R off = size_of(R(R(distance) - truth));
  const R short_by = truth - referee.separation_along(R(0), oracle::lift<R>(normal));
  if (!(off <= 8 * rounding))
    return Fault{"separation() is off", text(distance) + " for " + text(narrow(truth)) + ": " + in_roundings(off)};
  // Where the cores touch any normal will do. Where they are near, the closest points are right to rounding, and the normal
  // to that over the distance: along it the shapes reach farther by their size times as much.
  const R turned = core > 0 ? R(referee.size_at(R(0)) * 16 * rounding / core) : R(0);
  if (size_of(core) > 64 * rounding && !(short_by <= 32 * rounding + turned)) {
    return Fault{"separation(): the normal does not part them that far",
                 text(normal) + " is short by " + in_roundings(short_by)};
  }
  if (size_of(truth) > 8 * rounding && overlap != (truth < 0))
    return Fault{"overlaps() is wrong", "the gap is " + in_roundings(truth)};
  return {};
}

/// The oracle's search for the nearest point loses its digits where numbers are more than about 2^56 apart.
bool is_clear(const Exhibit& exhibit) {
  constexpr int most = 28;
  const auto moderate = [](const AnyShape& any, const Vec3<double>& displacement) {
    return std::visit([&](const auto& shape) { return is_moderate(Moving{shape, displacement}, most); }, any);
  };
  return moderate(exhibit.a, exhibit.displacement_a) && moderate(exhibit.b, exhibit.displacement_b);
}

}  // namespace

Judgment judge_bracket(const Exhibit& exhibit, ToiStatus verdict, double lower, double upper) {
  if (!is_clear(exhibit)) return {};
  using R = Digits50;
  const auto margin = [](const auto& s) { return s.scale > 0 ? decltype(s.gap)(s.gap / s.scale) : decltype(s.gap)(0); };
  if (verdict == ToiStatus::apart) {
    const Referee<long double> rough(exhibit);
    if (margin(rough.deepest(0.0L)) > 0x1p-50L) return {};
  }
  const Referee<R> referee(exhibit);
  const R blur = ldexp(R(1), -80), low = lower, high = upper;  // [1] what the oracle cannot tell from a touch
  const R start = margin(referee.at(R(0)));
  const auto fault = [&](const char* property) { return Fault{property, "by the oracle"}; };
  if (verdict == ToiStatus::overlapping) return start > blur ? Judgment(fault("wrong about the start")) : Judgment();
  if (start < -blur) return fault("wrong about the start");
  if (verdict == ToiStatus::apart) {
    return margin(referee.deepest(R(0))) < -blur ? Judgment(fault("missed")) : Judgment();
  }
  const auto truth = referee.first_contact(R(low * (1 - blur)));
  if (truth.verdict == oracle::Verdict::apart) {
    return margin(referee.deepest(R(0))) > blur ? Judgment(fault("a hit that is a miss")) : Judgment();
  }
  const std::string truly = "truly at " + text(narrow(truth.time));
  if (truth.time < low * (1 - blur) && margin(referee.at(low)) < -blur) return Fault{"the lower bound is late", truly};
  if (truth.time > high && margin(referee.at(high)) > blur) return Fault{"the upper bound is early", truly};
  return {};
}

Judgment judge_time(const Exhibit& exhibit, double time, double lower, double upper, double allowed) {
  if ((time >= lower && time <= upper) || !is_clear(exhibit)) return {};
  const Referee<Digits50> referee(exhibit);
  const double backward = narrow(referee.at(Digits50(time)).margin);
  if (std::abs(backward) <= allowed * exhibit.u) return {};
  const auto truth = referee.first_contact(Digits50(lower) / 2);
  const double off = time < lower ? lower - time : time - upper;
  const double slack = exhibit.u * allowed * (narrow(truth.conditioning) + time) + exhibit.least;
  if (off <= slack) return {};
  return Fault{"the plain time is outside the proven ones",
               text(time) + " not in [" + text(lower) + ", " + text(upper) + "], allowed are " + text(slack)};
}

Judgment judge_impact(const Exhibit& exhibit, ToiStatus status, double time, double allowed) {
  if (!is_clear(exhibit) || !judge_impact_in<long double>(exhibit, status, time, allowed * 0.99)) return {};
  return judge_impact_in<Digits50>(exhibit, status, time, allowed);
}

Judgment judge_never_late(const Exhibit& exhibit, ToiStatus status, double time) {
  if (!is_clear(exhibit) || !judge_never_late_in<long double>(exhibit, status, time)) return {};
  return judge_never_late_in<Digits50>(exhibit, status, time);
}

Judgment judge_separation(const Exhibit& exhibit, double distance, const Vec3<double>& normal, bool overlap) {
  if (!is_clear(exhibit) || !judge_separation_in<long double>(exhibit, distance, normal, overlap)) return {};
  return judge_separation_in<Digits50>(exhibit, distance, normal, overlap);
}

}  // namespace thinwall::fuzz
