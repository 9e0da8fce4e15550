/// Draws the queries of a place, in doubles, rounds them to each precision, and puts them to every method in its own kernels: not
/// through the front door, which would compute a float query in double.

// GCC 12 takes Boost's rounding to more digits for a write outside an array: it does not see that the loop there ends first.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <thinwall/experiments/accuracy/draw.hpp>
#include <thinwall/experiments/extremes/kernels/textbook.hpp>
#include <thinwall/experiments/extremes/kernels/truth.hpp>
#include <thinwall/experiments/extremes/model.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

/// One query, as drawn or as a precision has it, and what it is meant to be before it is rounded.
template <class A, class B> struct ExtremeQuery {
  Moving<A> a;
  Moving<B> b;
  bool meant_to_touch;
};

/// A shape about the origin, whose size is about 1.
template <class A> struct PlainDraw;
template <> struct PlainDraw<Sphere<double>> {
  static Sphere<double> draw(QueryNumbers& u) { return {Vec3<double>::Zero(), u.between(0.5, 1)}; }
};
template <> struct PlainDraw<Aabb<double>> {
  static Aabb<double> draw(QueryNumbers& u) {
    const double x = u.between(0.3, 1), y = u.between(0.3, 1), z = u.between(0.3, 1);
    return {Vec3<double>::Zero(), {x, y, z}};
  }
};
template <> struct PlainDraw<Obb<double>> {
  static Obb<double> draw(QueryNumbers& u) {
    const Vec3<double> half = PlainDraw<Aabb<double>>::draw(u).half_extents;
    return {Vec3<double>::Zero(), half, random_axes(u)};
  }
};
template <> struct PlainDraw<Capsule<double>> {
  static Capsule<double> draw(QueryNumbers& u) {
    const Vec3<double> direction = u.direction();
    const Vec3<double> half = direction * u.between(0.3, 1);
    return {-half, half, u.between(0.2, 0.5)};
  }
};
template <> struct PlainDraw<Triangle<double>> {
  static Triangle<double> draw(QueryNumbers& u) {
    const Vec3<double> a = u.direction(), b = u.direction(), c = u.direction();
    return {a, b, c};
  }
};

/// The shape with every length multiplied by `factor`.
template <class S> Sphere<S> stretched(const Sphere<S>& s, const S& f) { return {s.center * f, s.radius * f}; }
template <class S> Aabb<S> stretched(const Aabb<S>& b, const S& f) { return {b.center * f, b.half_extents * f}; }
template <class S> Obb<S> stretched(const Obb<S>& b, const S& f) { return {b.center * f, b.half_extents * f, b.axes}; }
template <class S> Capsule<S> stretched(const Capsule<S>& c, const S& f) { return {c.a * f, c.b * f, c.radius * f}; }
template <class S> Triangle<S> stretched(const Triangle<S>& t, const S& f) { return {t.a * f, t.b * f, t.c * f}; }

/// The radius of a ball around the shape.
inline double size_of(const Sphere<double>& s) { return s.radius; }
template <class A> double size_of(const A& shape) { return safe_norm(half_widths(shape)); }

template <class B>
concept HasHalfExtents = requires(const B& box) { box.half_extents; };
template <class A>
concept HasRadius = requires(const A& ball) { ball.radius; };

/// A straight pass of A beside B, which rests about the origin.
template <class A, class B> struct ExtremePass {
  A a;
  B b;
  Vec3<double> along;  ///< [1] unit, A's direction
  Vec3<double> aside;  ///< [length] across it, as long as the size
  double size;         ///< [length] R

  Moving<A> whole(double share) const {
    const Vec3<double> start = aside * share - along * (2 * size);
    return {moved(a, start), along * (4 * size)};
  }
  /// [length] From the place nearest to B's center to first contact, along the line; nothing if there is none.
  std::optional<double> contact(double share) const {
    const Toi<double> toi = time_of_impact(whole(share), at_rest(b));
    if (toi.status == ToiStatus::apart) return {};
    return (4 * toi.time - 2) * size;
  }
  /// The share of `aside` at which the pass just touches.
  double threshold() const {
    double hit = 0, miss = 2;
    for (int i = 0; i < 60; ++i) (contact((hit + miss) / 2) ? hit : miss) = (hit + miss) / 2;
    return hit;
  }
};

/// One query in two moves along a coordinate axis beside a body at rest at the origin: so that what rounding does to a far
/// path does not turn it away from what it should meet. The others run any way, and both bodies move.
template <class A, class B> ExtremeQuery<A, B> draw_extreme(QueryNumbers& u, const Extreme& e) {
  ExtremePass<A, B> pass;
  pass.a = stretched(PlainDraw<A>::draw(u), e.ratio);
  pass.b = PlainDraw<B>::draw(u);
  if constexpr (HasHalfExtents<B>) {
    pass.b.half_extents[0] *= e.thickness;
    if constexpr (HasRadius<A>) pass.a.radius *= e.thickness;
  }
  pass.size = size_of(pass.a) + size_of(pass.b);
  const bool upright = u.one_in(2);
  const Vec3<double> any = u.direction(), other = u.direction(), off = u.direction(), drifting = u.direction();
  const int axis = static_cast<int>(3 * u());
  pass.along = upright ? axis_vector<double>(axis, any[0] < 0) : any;
  pass.aside = safe_unit(cross<double>(pass.along, other)) * pass.size;

  const double threshold = pass.threshold();
  const bool touches = u.one_in(e.grazing > 0 ? 2 : 4.0 / 3);
  const double inside = u.between(0, 0.95), outside = u.between(1.05, 1.5), phase = u.between(0.3, 0.9);
  double share = threshold * (touches ? inside : outside);
  if (e.grazing > 0) share = threshold * (touches ? 1 - e.grazing : 1 + e.grazing);
  const double contact = pass.contact(touches ? share : threshold).value_or(0);
  const double lead = e.speed > 0 ? std::min(3.0, phase * e.speed) * pass.size : e.distance * pass.size;
  const double path = e.speed > 0 ? e.speed * pass.size : lead / phase;

  const Vec3<double> origin = e.offset > 0
                                  ? Vec3<double>(off * (e.offset * pass.size))
                                  : Vec3<double>(upright ? Vec3<double>::Zero() : Vec3<double>(off * pass.size));
  const Vec3<double> drift = upright ? Vec3<double>::Zero() : Vec3<double>(drifting * (path / 4));
  const Vec3<double> start = origin + pass.aside * share + pass.along * (contact - lead);
  const A a = moved(pass.a, start);
  const B b = moved(pass.b, origin);
  const Vec3<double> v = pass.along * path + drift;
  return {{stretched(a, e.scale), v * e.scale}, {stretched(b, e.scale), drift * e.scale}, touches};
}

/// Rounded to S. The axes of a box are made orthonormal again: a box in S has axes that are so to the round-off of S.
template <class S, class A> auto rounded_to(const A& shape) { return cast<S>(shape); }
template <class S> Obb<S> rounded_to(const Obb<double>& shape) {
  Obb<S> box = cast<S>(shape);
  box.axes.col(0) = safe_unit(Vec3<S>(box.axes.col(0)));
  box.axes.col(2) = safe_unit(cross<S>(box.axes.col(0), box.axes.col(1)));
  box.axes.col(1) = cross<S>(box.axes.col(2), box.axes.col(0));
  return box;
}

/// The moving shape in S. A double in a wider S has many bits of zeros, and products without rounding: there all lengths are
/// multiplied by 4/3, which changes no answer and fills them.
template <class S, class A> auto rounded_to(const Moving<A>& m) {
  Moving<decltype(rounded_to<S>(m.shape))> rounded = {rounded_to<S>(m.shape), m.displacement.template cast<S>()};
  if constexpr (std::numeric_limits<S>::digits > std::numeric_limits<double>::digits) {
    const S filling = S(4) / S(3);
    rounded.shape = stretched(rounded.shape, filling);
    rounded.displacement *= filling;
  }
  return rounded;
}

/// True if no number of the query is lost, neither to zero nor to infinity, nor loses digits below the least normal number.
template <class S> bool holds(const Vec3<double>& v) {
  constexpr int least = std::numeric_limits<S>::min_exponent, most = std::numeric_limits<S>::max_exponent - 10;
  for (int i = 0; i < 3; ++i) {
    const int e = v[i] == 0 ? 0 : std::ilogb(v[i]);
    if (e < least || e > most) return false;
  }
  return true;
}
template <class S> bool holds(const Sphere<double>& s) {
  return holds<S>(Vec3<double>(s.center)) && holds<S>({s.radius, 0, 0});
}
template <class S> bool holds(const Aabb<double>& b) { return holds<S>(b.center) && holds<S>(b.half_extents); }
template <class S> bool holds(const Obb<double>& b) { return holds<S>(b.center) && holds<S>(b.half_extents); }
template <class S> bool holds(const Capsule<double>& c) {
  return holds<S>(c.a) && holds<S>(c.b) && holds<S>({c.radius, 0, 0});
}
template <class S> bool holds(const Triangle<double>& t) { return holds<S>(t.a) && holds<S>(t.b) && holds<S>(t.c); }

/// What a front door calls, in the shapes' own scalar.
template <class Method, Shape A, Shape B>
Toi<typename A::Scalar> kernel_of(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  if constexpr (A::rank < B::rank) {
    return flipped(impact(method, b, a));
  } else {
    return impact(method, a, b);
  }
}

template <class A, class B, class S> auto rounded_queries(const ExtremeInquiry& inquiry, std::int64_t count) {
  using Query = ExtremeQuery<decltype(cast<S>(A{})), decltype(cast<S>(B{}))>;
  const std::array<double, 4> factors = {double{A::rank}, double{B::rank}, static_cast<double>(inquiry.place.axis),
                                         inquiry.place.value};
  const RandomStream stream = {inquiry.seed, stream_of(factors)};
  std::vector<Query> queries;
  for (std::int64_t i = 0; i < count; ++i) {
    QueryNumbers numbers(stream, static_cast<std::uint64_t>(i));
    const ExtremeQuery<A, B> q = draw_extreme<A, B>(numbers, extreme_at(inquiry.place));
    if (!holds<S>(q.a.shape) || !holds<S>(q.b.shape) || !holds<S>(q.a.displacement) || !holds<S>(q.b.displacement)) {
      continue;
    }
    queries.push_back({rounded_to<S>(q.a), rounded_to<S>(q.b), q.meant_to_touch});
  }
  return queries;
}

/// The median over passes, as many as fit into a millisecond, at most nine, at least the one that answers.
template <class Method, class Query, class S>
double timed_answers(const Method& method, const std::vector<Query>& queries, std::vector<Toi<S>>& answers) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> passes;
  double spent = 0;
  while (passes.empty() || (spent < 1e6 && passes.size() < 9)) {
    const auto start = Clock::now();
    for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = kernel_of(method, queries[i].a, queries[i].b);
    const std::chrono::duration<double, std::nano> pass = Clock::now() - start;
    spent += pass.count();
    passes.push_back(pass.count() / static_cast<double>(queries.size()));
  }
  return median(passes);
}

template <class Query, class A, class B, class S>
ExtremeTally judged(const std::vector<Query>& queries, std::vector<Truth<A, B>>& truths,
                    const std::vector<Toi<S>>& answers) {
  ExtremeTally tally;
  std::vector<double> forward, backward;
  double squares = 0;
  std::int64_t losses = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const bool touches = truths[i].verdict() != oracle::Verdict::apart;
    ++tally.queries;
    tally.touching += touches ? 1 : 0;
    tally.changed += touches != queries[i].meant_to_touch ? 1 : 0;
    const Toi<S>& toi = answers[i];
    tally.gave_up += toi.status == ToiStatus::gave_up ? 1 : 0;
    const bool number = toi.time == toi.time && toi.status != ToiStatus::invalid;
    tally.invalid += number ? 0 : 1;
    if (!number || toi.status == ToiStatus::gave_up) continue;
    const AnswerErrors errors = truths[i].errors(toi);
    tally.wrong += errors.wrong ? 1 : 0;
    tally.far_wrong += errors.wrongness > 4 ? 1 : 0;
    tally.worst_wrong = std::max(tally.worst_wrong, errors.wrongness);
    if (errors.forward) forward.push_back(*errors.forward);
    if (errors.backward) backward.push_back(*errors.backward);
    if (errors.loss) {
      squares += *errors.loss * *errors.loss;
      ++losses;
      tally.loss_max = std::max(tally.loss_max, *errors.loss);
    }
  }
  tally.timed = static_cast<std::int64_t>(forward.size());
  if (!forward.empty()) {
    tally.forward_median = quantile(forward, 0.5);
    tally.forward_max = quantile(forward, 1);
    tally.backward_median = quantile(backward, 0.5);
    tally.backward_max = quantile(backward, 1);
  }
  if (losses > 0) tally.loss_rms = std::sqrt(squares / static_cast<double>(losses));
  return tally;
}

/// The methods of a list that serve the pair and are asked for, each on the same queries.
template <class A, class B, class S, class List> std::vector<ExtremeTally> ask_extreme(const ExtremeInquiry& inquiry) {
  using AS = decltype(cast<S>(A{}));
  using BS = decltype(cast<S>(B{}));
  const auto queries = rounded_queries<A, B, S>(inquiry, inquiry.queries);
  using Real = typename Truth<AS, BS>::Real;
  std::vector<Truth<AS, BS>> truths;
  for (const auto& q : queries) {
    const Toi<S> near = kernel_of(ClosedForm<S>{}, q.a, q.b);
    const Real guess = near.status == ToiStatus::hit
                           ? Real(Real(near.time) * (1 - ldexp(Real(1), -std::numeric_limits<S>::digits / 2)))
                           : Real(0);
    truths.emplace_back(q.a, q.b, guess);
  }
  std::vector<ExtremeTally> tallies;
  std::vector<Toi<S>> answers(queries.size());
  for_each_type(List{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, AS, BS>) {
      const auto& names = inquiry.methods;
      if (std::find(names.begin(), names.end(), Method::name) == names.end()) return;
      Method method;
      if constexpr (requires { method.tolerance; }) {
        method.tolerance = S(inquiry.tolerance) * std::numeric_limits<S>::epsilon();
      }
      const double nanoseconds = queries.empty() ? 0 : timed_answers(method, queries, answers);
      tallies.push_back(judged(queries, truths, answers));
      tallies.back().method = std::string(Method::name);
      tallies.back().nanoseconds = nanoseconds;
    }
  });
  return tallies;
}

/// Every method of the list, and the foil before them.
template <class S> struct EveryMethod {
  template <class... Types> static TypeList<Textbook<S>, Types...> with(TypeList<Types...>);
  using List = decltype(with(Methods<S>{}));
};
template <class S> using ClosedFormAlone = TypeList<Textbook<S>, ClosedForm<S>>;

/// A pair of the four that every method is asked.
template <class A, class B, class S> std::vector<ExtremeTally> ask_every_method(const ExtremeInquiry& inquiry) {
  return ask_extreme<A, B, S, typename EveryMethod<S>::List>(inquiry);
}

template <class A, class B> constexpr std::array<AskExtreme, precision_count> every_method() {
  return {&ask_every_method<A, B, float>, &ask_every_method<A, B, double>, &ask_every_method<A, B, long double>,
          &ask_every_method<A, B, Digits50>};
}
template <class A, class B> constexpr std::array<AskExtreme, precision_count> closed_form_alone() {
  return {&ask_extreme<A, B, float, ClosedFormAlone<float>>, &ask_extreme<A, B, double, ClosedFormAlone<double>>,
          nullptr, nullptr};
}

}  // namespace

const std::array<Precision, precision_count>& all_precisions() {
  static const std::array<Precision, precision_count> list{{
      {"float", "float", 0x1p-24},
      {"double", "double", 0x1p-53},
      {"long_double", "long double", std::ldexp(1.0, -std::numeric_limits<long double>::digits)},
      {"50_digits", "50 digits", std::ldexp(1.0, -std::numeric_limits<Digits50>::digits), true},
  }};
  return list;
}

std::span<const ExtremePair> extreme_pairs() {
  using Ball = Sphere<double>;
  using Upright = Aabb<double>;
  using Turned = Obb<double>;
  using Rod = Capsule<double>;
  using Flat = Triangle<double>;
  static constexpr std::array list = {
      ExtremePair{"sphere_sphere", true, true, false, every_method<Ball, Ball>()},
      ExtremePair{"sphere_aabb", true, true, true, every_method<Ball, Upright>()},
      ExtremePair{"sphere_capsule", true, true, false, every_method<Ball, Rod>()},
      ExtremePair{"obb_obb", false, true, true, every_method<Turned, Turned>()},
      ExtremePair{"aabb_aabb", false, false, true, closed_form_alone<Upright, Upright>()},
      ExtremePair{"sphere_obb", true, false, true, closed_form_alone<Ball, Turned>()},
      ExtremePair{"aabb_obb", false, false, true, closed_form_alone<Upright, Turned>()},
      ExtremePair{"sphere_triangle", true, false, false, closed_form_alone<Ball, Flat>()},
      ExtremePair{"capsule_capsule", true, false, false, closed_form_alone<Rod, Rod>()},
      ExtremePair{"capsule_aabb", true, false, true, closed_form_alone<Rod, Upright>()},
      ExtremePair{"capsule_obb", true, false, true, closed_form_alone<Rod, Turned>()},
      ExtremePair{"capsule_triangle", true, false, false, closed_form_alone<Rod, Flat>()},
  };
  return list;
}

std::vector<std::string_view> extreme_method_names() {
  std::vector<std::string_view> names;
  for_each_type(EveryMethod<double>::List{}, [&]<class Method>(TypeTag<Method>) { names.push_back(Method::name); });
  return names;
}

}  // namespace thinwall
