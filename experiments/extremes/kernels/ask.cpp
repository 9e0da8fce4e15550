/// Draws the queries of a place, in doubles, rounds them to each precision, and puts them to every method in its own kernels: not
/// through the front door, which would compute a float query in double.

// GCC 12 takes Boost's rounding to more digits for a write outside an array: it does not see that the loop there ends first.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numeric>
#include <span>

#include <thinwall/experiments/extremes/model.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/models/queries.hpp>
#include <thinwall/experiments/models/textbook.hpp>
#include <thinwall/experiments/models/truth.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

template <class S> constexpr int digits = std::numeric_limits<S>::digits;

/// One query, as drawn or as a precision has it, and what it is meant to be before it is rounded.
template <class A, class B> struct ExtremeQuery : MovingPair<A, B> {
  bool meant_to_touch;
};

/// A shape about the origin, whose size is about 1.
template <class A> A plain_shape(QueryNumbers& u) {
  const Vec3<double> origin = Vec3<double>::Zero();
  if constexpr (std::same_as<A, Sphere<double>>) {
    return {origin, u.between(0.5, 1)};
  } else if constexpr (std::same_as<A, Aabb<double>>) {
    return {origin, random_half_extents(u, 0.3)};
  } else if constexpr (std::same_as<A, Obb<double>>) {
    return {origin, random_half_extents(u, 0.3), random_axes(u)};
  } else if constexpr (std::same_as<A, Capsule<double>>) {
    const Vec3<double> direction = u.direction();
    const Vec3<double> half = direction * u.between(0.3, 1);
    return {-half, half, u.between(0.2, 0.5)};
  } else {
    return {u.direction(), u.direction(), u.direction()};
  }
}

/// What `f` makes of every place and length: the same kind of shape.
template <class S, class F> Sphere<S> mapped(const Sphere<S>& s, const F& f) { return {f(s.center), f(s.radius)}; }
template <class S, class F> Aabb<S> mapped(const Aabb<S>& b, const F& f) { return {f(b.center), f(b.half_extents)}; }
template <class S, class F> Obb<S> mapped(const Obb<S>& b, const F& f) {
  return {f(b.center), f(b.half_extents), b.axes};
}
template <class S, class F> Capsule<S> mapped(const Capsule<S>& c, const F& f) { return {f(c.a), f(c.b), f(c.radius)}; }
template <class S, class F> Triangle<S> mapped(const Triangle<S>& t, const F& f) { return {f(t.a), f(t.b), f(t.c)}; }
template <class A, class F> Moving<A> mapped(const Moving<A>& m, const F& f) {
  return {mapped(m.shape, f), f(m.displacement)};
}

/// With every length multiplied by `factor`.
template <class A, class S> A stretched(const A& a, const S& factor) {
  return mapped(a, [&]<class Length>(const Length& x) { return Length(x * factor); });
}

/// The radius of a ball around the shape.
double size_of(const Sphere<double>& s) { return s.radius; }
template <class A> double size_of(const A& shape) { return safe_norm(half_widths(shape)); }

/// One query in two moves along a coordinate axis beside a body at rest at the origin: so that what rounding does to a far
/// path does not turn it away from what it should meet. The others run any way, and both bodies move.
template <class A, class B> ExtremeQuery<A, B> draw_extreme(QueryNumbers& u, const Extreme& e) {
  StraightPass<A, B> pass;
  pass.a = stretched(plain_shape<A>(u), e.ratio);
  pass.b = plain_shape<B>(u);
  if constexpr (requires { pass.b.half_extents; }) {
    pass.b.half_extents[0] *= e.thickness;
    if constexpr (requires { pass.a.radius; }) pass.a.radius *= e.thickness;
  }
  pass.reach = size_of(pass.a) + size_of(pass.b);
  const double size = pass.reach;
  const bool upright = u.one_in(2);
  const Vec3<double> any = u.direction(), other = u.direction(), off = u.direction(), drifting = u.direction();
  const int axis = static_cast<int>(3 * u());
  pass.along = upright ? axis_vector<double>(axis, any[0] < 0) : any;
  pass.aside = safe_unit(cross<double>(pass.along, other)) * size;

  const double threshold = last_that_touches([&](double share) { return pass.contact(share).has_value(); }, 2, 60);
  const bool touches = u.one_in(e.grazing > 0 ? 2 : 4.0 / 3);
  const double inside = u.between(0, 0.95), outside = u.between(1.05, 1.5), phase = u.between(0.3, 0.9);
  double share = threshold * (touches ? inside : outside);
  if (e.grazing > 0) share = threshold * (touches ? 1 - e.grazing : 1 + e.grazing);
  const double contact = pass.contact(touches ? share : threshold).value_or(0);
  const double lead = e.speed > 0 ? std::min(3.0, phase * e.speed) * size : e.distance * size;
  const double path = e.speed > 0 ? e.speed * size : lead / phase;

  const double off_origin = e.offset > 0 ? e.offset : upright ? 0 : 1;
  const Vec3<double> origin = off * (off_origin * size);
  const Vec3<double> drift = drifting * (upright ? 0 : path / 4);
  const Vec3<double> start = origin + pass.aside * share + pass.along * (contact - lead);
  const Moving<A> a = {moved(pass.a, start), pass.along * path + drift};
  const Moving<B> b = {moved(pass.b, origin), drift};
  return {{stretched(a, e.scale), stretched(b, e.scale)}, touches};
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
  const Moving rounded = {rounded_to<S>(m.shape), Vec3<S>(m.displacement.template cast<S>())};
  return stretched(rounded, digits<S> > digits<double> ? S(S(4) / S(3)) : S(1));
}

/// True if no number of the query is lost, neither to zero nor to infinity, nor loses digits below the least normal number.
template <class S, class A> bool holds(const Moving<A>& m) {
  constexpr int least = std::numeric_limits<S>::min_exponent, most = std::numeric_limits<S>::max_exponent - 10;
  bool all = true;
  const auto check = [&](double x) { all = all && (x == 0 || (least <= std::ilogb(x) && std::ilogb(x) <= most)); };
  mapped(m, [&]<class Length>(const Length& x) {
    if constexpr (std::same_as<Length, double>) {
      check(x);
    } else {
      std::ranges::for_each(x, check);
    }
    return x;
  });
  return all;
}

template <template <class> class A, template <class> class B, class S>
auto rounded_queries(const ExtremeInquiry& inquiry) {
  const std::array<double, 4> factors = {double{A<double>::rank}, double{B<double>::rank},
                                         static_cast<double>(inquiry.place.axis), inquiry.place.value};
  const RandomStream stream = {inquiry.seed, stream_of(factors)};
  std::vector<ExtremeQuery<A<S>, B<S>>> queries;
  for (std::int64_t i = 0; i < inquiry.queries; ++i) {
    QueryNumbers numbers(stream, static_cast<std::uint64_t>(i));
    const auto q = draw_extreme<A<double>, B<double>>(numbers, extreme_at(inquiry.place));
    if (holds<S>(q.a) && holds<S>(q.b)) queries.push_back({{rounded_to<S>(q.a), rounded_to<S>(q.b)}, q.meant_to_touch});
  }
  return queries;
}

/// The median over passes, as many as fit into a millisecond, at most nine, at least the one that answers.
template <class Method, class Query, class S>
double timed_answers(const Method& method, const std::vector<Query>& queries, std::vector<Toi<S>>& answers) {
  const TimedLoop<Query> loop = {[&](std::span<const Query> all) {
    for (std::size_t i = 0; i < all.size(); ++i) answers[i] = kernel_impact(method, all[i].a, all[i].b);
  }};
  std::vector<double> passes;
  double spent = 0;
  while (passes.empty() || (spent < 1e6 && passes.size() < 9)) {
    passes.push_back(nanoseconds_a_query<Query>(loop, queries));
    spent += passes.back() * static_cast<double>(queries.size());
  }
  return median(passes);
}

template <class Query, class A, class B, class S>
ExtremeTally judged(const std::vector<Query>& queries, std::vector<Truth<A, B>>& truths,
                    const std::vector<Toi<S>>& answers) {
  ExtremeTally tally;
  std::vector<double> forward, backward, losses;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Toi<S>& toi = answers[i];
    const bool touches = truths[i].verdict() != oracle::Verdict::apart, gave_up = toi.status == ToiStatus::gave_up;
    const bool is_number = toi.time == toi.time && toi.status != ToiStatus::invalid;
    ++tally.queries;
    tally.touching += touches ? 1 : 0;
    tally.changed += touches != queries[i].meant_to_touch ? 1 : 0;
    tally.gave_up += gave_up ? 1 : 0;
    tally.invalid += is_number ? 0 : 1;
    if (!is_number || gave_up) continue;
    const AnswerErrors errors = truths[i].errors(toi);
    tally.wrong += errors.wrong ? 1 : 0;
    tally.far_wrong += errors.wrongness > break_verdict ? 1 : 0;
    tally.worst_wrong = std::max(tally.worst_wrong, errors.wrongness);
    if (!errors.time) continue;
    forward.push_back(errors.time->forward);
    backward.push_back(errors.time->backward);
    if (errors.time->loss) losses.push_back(*errors.time->loss);
  }
  tally.timed = std::ssize(forward);
  if (!forward.empty()) {
    tally.forward_median = quantile(forward, 0.5);
    tally.forward_max = quantile(forward, 1);
    tally.backward_median = quantile(backward, 0.5);
    tally.backward_max = quantile(backward, 1);
  }
  if (!losses.empty()) {
    const double squares = std::inner_product(losses.begin(), losses.end(), losses.begin(), 0.0);
    tally.loss_rms = std::sqrt(squares / static_cast<double>(losses.size()));
    tally.loss_max = quantile(losses, 1);
  }
  return tally;
}

/// The methods of a list that serve the pair and are asked for, each on the same queries.
template <template <class> class A, template <class> class B, class S, class List>
std::vector<ExtremeTally> ask_extreme(const ExtremeInquiry& inquiry) {
  const auto queries = rounded_queries<A, B, S>(inquiry);
  std::vector<Truth<A<S>, B<S>>> truths;
  for (const auto& q : queries) truths.emplace_back(q.a, q.b, kernel_impact(ClosedForm<S>{}, q.a, q.b));
  std::vector<ExtremeTally> tallies;
  std::vector<Toi<S>> answers(queries.size());
  for_each_type(List{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A<S>, B<S>>) {
      if (std::ranges::count(inquiry.methods, Method::name) == 0) return;
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
template <class S, class... Types> TypeList<Textbook<S>, Types...> after_the_foil(TypeList<Types...>);
template <class S> using EveryMethod = decltype(after_the_foil<S>(Methods<S>{}));
template <class S> using ClosedFormAlone = TypeList<Textbook<S>, ClosedForm<S>>;

template <template <class> class A, template <class> class B, template <class> class List, class... Scalars>
constexpr ExtremePair pair_of(std::string_view name, PairSet set) {
  constexpr bool has_box = requires(const B<double>& box) { box.half_extents; };
  return {name, set, has_box, {&ask_extreme<A, B, Scalars, List<Scalars>>...}};
}
template <template <class> class A, template <class> class B>
constexpr ExtremePair every_method(std::string_view name, PairSet set) {
  return pair_of<A, B, EveryMethod, float, double, long double, Digits50>(name, set);
}
template <template <class> class A, template <class> class B>
constexpr ExtremePair closed_form_alone(std::string_view name) {
  return pair_of<A, B, ClosedFormAlone, float, double>(name, PairSet::closed_form_alone);
}

}  // namespace

double unit_of(Precision precision) {
  constexpr std::array all = {digits<float>, digits<double>, digits<long double>, digits<Digits50>};
  return std::ldexp(1.0, -all[static_cast<std::size_t>(precision)]);
}

std::span<const ExtremePair> extreme_pairs() {
  static constexpr std::array list = {
      every_method<Sphere, Sphere>("sphere_sphere", PairSet::rounded),
      every_method<Sphere, Aabb>("sphere_aabb", PairSet::rounded),
      every_method<Sphere, Capsule>("sphere_capsule", PairSet::rounded),
      every_method<Obb, Obb>("obb_obb", PairSet::boxes),
      closed_form_alone<Aabb, Aabb>("aabb_aabb"),
      closed_form_alone<Sphere, Obb>("sphere_obb"),
      closed_form_alone<Aabb, Obb>("aabb_obb"),
      closed_form_alone<Sphere, Triangle>("sphere_triangle"),
      closed_form_alone<Capsule, Capsule>("capsule_capsule"),
      closed_form_alone<Capsule, Aabb>("capsule_aabb"),
      closed_form_alone<Capsule, Obb>("capsule_obb"),
      closed_form_alone<Capsule, Triangle>("capsule_triangle"),
  };
  return list;
}

std::vector<std::string_view> extreme_method_names() { return type_names(EveryMethod<double>{}); }

}  // namespace thinwall
