#include <thinwall/experiments/accuracy/model.hpp>

#include <algorithm>
#include <cmath>

#include <thinwall/experiments/models/queries.hpp>
#include <thinwall/experiments/models/truth.hpp>

namespace thinwall {

namespace {

constexpr int bins_an_octave = 64, octaves = 32;
constexpr double half_range = 16;

}  // namespace

void ErrorHistogram::add(double error) {
  const double octave = error > 0 ? std::log2(error) + half_range : 0;
  const double bin = std::clamp(std::ceil(octave * bins_an_octave), 0.0, double{bins_an_octave} * octaves);
  const auto i = static_cast<std::size_t>(bin);
  if (i >= bins_.size()) bins_.resize(i + 1);
  ++bins_[i];
  largest_ = std::max(largest_, error);
}

double ErrorHistogram::quantile(double share) const {
  std::int64_t total = 0, seen = 0;
  for (const std::int64_t count : bins_) total += count;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    seen += bins_[i];
    if (static_cast<double>(seen) < share * static_cast<double>(total)) continue;
    return std::min(largest_, i == 0 ? 0 : std::exp2(static_cast<double>(i) / bins_an_octave - half_range));
  }
  return 0;
}

bool is_within_goal(const AccuracyTally& t) {
  return std::max({t.forward.largest(), t.backward.largest(), t.worst_normal, t.worst_point}) <= accuracy_goal &&
         t.largest_wrong <= accuracy_goal_wrong && t.gave_up == 0;
}

namespace {

/// By how much the input would have to change, in u, to make a wrong verdict right.
template <class R, class S>
double wrongness(const oracle::Problem<R>& problem, const Toi<S>& toi, const oracle::Impact<R>& truth,
                 const R& tolerance) {
  const bool about_start = toi.status == ToiStatus::overlapping || truth.verdict == oracle::Verdict::overlapping;
  const R u = R(std::numeric_limits<S>::epsilon()) / 2;
  const R margin = about_start ? sound(problem, R(0), tolerance).margin() : least_margin(problem, tolerance, R(u / 64));
  return static_cast<double>(abs(margin) / u);
}

/// [length] Every number of a query added up until `time`.
template <class R> R size_of(const oracle::Problem<R>& problem, const R& time) {
  R size = problem.reach;
  for (std::size_t i = 0; i < 3; ++i) size += problem.start_size[i] + time * problem.speed_size[i];
  return size;
}

/// [length] By how much shapes a separation `core` apart overlap along the direction that was told. Told from places it is off by u size / R,
/// and what they move by in the time that u is worth, where the shapes are round by R, and tilts their cores by that: over their length in R
/// more, `flatness`.
template <class R, class S>
R overlap_along(const Vec3<S>& normal, const oracle::Problem<R>& problem, const R& time, const R& core) {
  const auto n = oracle::lift<R>(normal);
  const auto at = oracle::combination(R(1), problem.offset, time, problem.motion);
  return core - (oracle::dot(n, at) - problem.support(n)) / sqrt(oracle::dot(n, n));
}
template <class R> R flatness(const oracle::Problem<R>& problem) {
  R length = 0;
  for (const auto& edge : oracle::edges_of(problem)) length += 2 * sqrt(oracle::dot(edge, edge));
  return problem.reach > 0 ? R(length / problem.reach) : R(0);
}

/// [length] From a point to the surface of a shape on its way.
template <class R, class A, class S>
R off_surface(const Moving<A>& a, const Vec3<S>& point, const R& time, const R& tolerance) {
  const auto problem = oracle::pose<R>(a, Moving<Sphere<S>>{{point, 0}, Vec3<S>::Zero()});
  return abs(oracle::signed_gap_at(problem, time, tolerance).core - problem.reach);
}

/// [1] kappa t of the plane that was told.
template <class R, class S> R conditioning_of(const Vec3<S>& normal, const oracle::Problem<R>& problem, const R& time) {
  auto n = oracle::lift<R>(normal);
  const R length = sqrt(oracle::dot(n, n)), closing = -oracle::dot(n, problem.motion) / length;
  n = oracle::combination(R(1 / length), n, R(0), {});
  return closing > 0 ? R(problem.scale(time, n) / closing) : R(0);
}

void note_worst(double& worst, double error) {
  worst = std::max(worst, error);
  if (std::isnan(error)) worst = std::numeric_limits<double>::infinity();  // no direction at all
}

/// Time, verdict, normal and point against the oracle in R.
template <class R, class A, class B, class S>
AccuracyTally judged_in(const Moving<A>& a, const Moving<B>& b, const Toi<S>& toi, S min_separation) {
  AccuracyTally tally;
  const R tolerance = ldexp(R(1), -140);
  auto problem = oracle::pose<R>(a, b);
  problem.reach += R(min_separation);
  const bool timed = toi.status == ToiStatus::hit;
  const auto truth = oracle::first_contact(problem, guess_from<R>(toi), tolerance);
  ++tally.queries;
  tally.hits += truth.verdict == oracle::Verdict::hit ? 1 : 0;
  tally.overlapping += truth.verdict == oracle::Verdict::overlapping ? 1 : 0;
  tally.gave_up += toi.status == ToiStatus::gave_up ? 1 : 0;
  if (toi.status != truth.verdict) {
    ++tally.wrong_verdicts;
    tally.largest_wrong = wrongness(problem, toi, truth, tolerance);
    return tally;
  }
  if (!timed) return tally;
  const R u = R(std::numeric_limits<S>::epsilon()) / 2, time(toi.time), unit = u * size_of(problem, time);
  const auto there = oracle::gap_at(problem, time, tolerance);
  const R moved = u * truth.conditioning * sqrt(oracle::dot(problem.motion, problem.motion));
  const R tilted = unit + (unit + moved) * flatness(problem);
  const auto normal = static_cast<double>(R(overlap_along(toi.normal, problem, time, there.core) / tilted));
  const R late = abs(R(time - truth.time)) / u;
  double forward = static_cast<double>(R(late / truth.conditioning));
  if (forward > accuracy_goal && normal <= accuracy_goal) {
    // A corner is met by several planes at once: any of them may be told, with the error that is its own.
    forward = static_cast<double>(R(late / std::max(truth.conditioning, conditioning_of(toi.normal, problem, time))));
  }
  const double backward =
      there.core > 0 ? static_cast<double>(R(abs(R(there.core - problem.reach)) / (u * there.scale))) : forward;
  const auto is_graze = [&] {  // by few roundings: the time is not linear in the input
    const R depth = -least_margin(problem, tolerance, R(u / 64));
    return depth > 0 && depth <= 64 * u;
  };
  tally.forward.add(forward > accuracy_goal && is_graze() ? std::min(forward, backward) : forward);
  tally.backward.add(backward);
  const R farther = std::max(off_surface(a, toi.point, time, tolerance), off_surface(b, toi.point, time, tolerance));
  const R off = abs(R(farther - R(min_separation) / 2));  // the middle of the gap
  note_worst(tally.worst_normal, normal);
  note_worst(tally.worst_point, static_cast<double>(R(off / (unit + moved))));
  return tally;
}

/// At 50 digits, and at 110 where those find it over the goal: beside what is flat but for roundings they are too few.
template <class A, class B, class S = typename A::Scalar>
void judge_answer(const Moving<A>& a, const Moving<B>& b, const Toi<S>& toi, AccuracyTally& tally,
                  S min_separation = 0) {
  const AccuracyTally judged = judged_in<Digits50>(a, b, toi, min_separation);
  tally += is_within_goal(judged) ? judged : judged_in<Digits110>(a, b, toi, min_separation);
}

/// The verdict alone, first against the oracle in long double, and at 50 digits where that is too close to call.
template <class A, class B> void judge_verdict(const Moving<A>& a, const Moving<B>& b, AccuracyTally& tally) {
  const auto toi = time_of_impact(a, b);
  const long double tolerance = std::ldexp(1.0L, -56);
  const auto problem = oracle::pose<long double>(a, b);
  const auto rough = oracle::first_contact(problem, guess_from<long double>(toi), tolerance);
  if (toi.status == rough.verdict) {
    ++tally.queries;
    tally.hits += rough.verdict == oracle::Verdict::hit ? 1 : 0;
    tally.overlapping += rough.verdict == oracle::Verdict::overlapping ? 1 : 0;
    return;
  }
  judge_answer(a, b, toi, tally);
}

/// Puts a block of queries to one pair of shapes.
template <template <class> class A, template <class> class B>
AccuracyTally ask_pair(Inquiry inquiry, std::uint64_t seed, std::int64_t first, std::int64_t count) {
  const bool in_float = inquiry == Inquiry::in_float || inquiry == Inquiry::float_kernel;
  const bool is_random = in_float || inquiry == Inquiry::in_double;
  const double set = is_random ? 0 : inquiry == Inquiry::verdicts ? 1 : inquiry == Inquiry::along_edges ? 2 : 3;
  const std::array<double, 3> factors{double{A<double>::rank}, double{B<double>::rank}, set};
  const RandomStream stream{seed, stream_of(factors)};
  AccuracyTally tally;
  for (std::int64_t i = first; i < first + count; ++i) {
    QueryNumbers numbers(stream, static_cast<std::uint64_t>(i));
    const auto query = inquiry == Inquiry::along_edges ? draw_query_along_edge<A<double>, B<double>>(numbers)
                       : inquiry == Inquiry::upright   ? draw_upright_query<A<double>, B<double>>(numbers)
                                                       : draw_query<A<double>, B<double>>(numbers, in_float ? 3 : 8);
    const ClosedForm<double> front_door{query.min_separation};
    if (inquiry == Inquiry::verdicts) {
      judge_verdict(query.a, query.b, tally);
    } else if (!in_float) {
      judge_answer(query.a, query.b, time_of_impact(front_door, query.a, query.b), tally, query.min_separation);
    } else {
      const auto a = cast<float>(query.a);
      const auto b = cast<float>(query.b);
      judge_answer(a, b, inquiry == Inquiry::in_float ? time_of_impact(a, b) : kernel_impact(ClosedForm<float>{}, a, b),
                   tally);
    }
  }
  return tally;
}

}  // namespace

const std::vector<AccuracyPair> accuracy_pairs = {
    {"sphere_sphere", &ask_pair<Sphere, Sphere>},
    {"sphere_aabb", &ask_pair<Sphere, Aabb>},
    {"aabb_aabb", &ask_pair<Aabb, Aabb>},
    {"sphere_obb", &ask_pair<Sphere, Obb>},
    {"aabb_obb", &ask_pair<Aabb, Obb>},
    {"obb_obb", &ask_pair<Obb, Obb>},
    {"sphere_triangle", &ask_pair<Sphere, Triangle>},
    {"sphere_capsule", &ask_pair<Sphere, Capsule>},
    {"capsule_capsule", &ask_pair<Capsule, Capsule>},
    {"capsule_aabb", &ask_pair<Capsule, Aabb>},
    {"capsule_obb", &ask_pair<Capsule, Obb>},
    {"capsule_triangle", &ask_pair<Capsule, Triangle>},
};

}  // namespace thinwall
