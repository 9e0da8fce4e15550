#pragma once
/// Puts the queries of one place to every method in one precision, in its own kernels: not through the front door, which would
/// compute a float query in double.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/extremes/draw.hpp>
#include <thinwall/experiments/extremes/pairs.hpp>
#include <thinwall/experiments/extremes/textbook.hpp>
#include <thinwall/experiments/extremes/truth.hpp>
#include <thinwall/experiments/statistics.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

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

/// A query as a precision has it.
template <class A, class B> struct RoundedQuery {
  Moving<A> a;
  Moving<B> b;
  bool meant_to_touch;
};

template <class A, class B, class S> auto rounded_queries(const ExtremeInquiry& inquiry, std::int64_t count) {
  using Query = RoundedQuery<decltype(cast<S>(A{})), decltype(cast<S>(B{}))>;
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

/// The four pairs that every method is asked, in one precision.
template <class S> constexpr std::array<AskExtreme, 4> ask_in() {
  using Ball = Sphere<double>;
  using Box = Aabb<double>;
  using Turned = Obb<double>;
  return {&ask_every_method<Ball, Ball, S>, &ask_every_method<Ball, Box, S>,
          &ask_every_method<Ball, Capsule<double>, S>, &ask_every_method<Turned, Turned, S>};
}

}  // namespace thinwall
