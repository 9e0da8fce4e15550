#pragma once
/// Puts a block of queries to one pair of shapes.

#include <thinwall/experiments/accuracy/judge.hpp>
#include <thinwall/experiments/accuracy/pairs.hpp>

namespace thinwall {

template <template <class> class A, template <class> class B>
AccuracyTally ask_pair(Inquiry inquiry, std::uint64_t seed, std::int64_t first, std::int64_t count) {
  const bool in_float = inquiry == Inquiry::in_float || inquiry == Inquiry::float_kernel;
  const std::array<double, 3> factors{double{A<double>::rank}, double{B<double>::rank},
                                      inquiry == Inquiry::verdicts ? 1.0 : 0.0};
  const RandomStream stream{seed, stream_of(factors)};
  AccuracyTally tally;
  for (std::int64_t i = first; i < first + count; ++i) {
    QueryNumbers numbers(stream, static_cast<std::uint64_t>(i));
    const auto query = draw_query<A<double>, B<double>>(numbers, in_float ? 3 : 8);
    if (inquiry == Inquiry::verdicts) {
      judge_verdict(query.a, query.b, tally);
    } else if (inquiry == Inquiry::in_double) {
      judge_answer(query.a, query.b, time_of_impact(query.a, query.b), tally);
    } else {
      const auto a = cast<float>(query.a);
      const auto b = cast<float>(query.b);
      judge_answer(a, b, inquiry == Inquiry::in_float ? time_of_impact(a, b) : kernel_impact(a, b), tally);
    }
  }
  return tally;
}

}  // namespace thinwall
