// Certified answers: whole, the same both ways round, right by the oracle, and not contradicted by plain ones.

#include <thinwall/swept/certified.hpp>

#include "fuzz/finding.hpp"

namespace thinwall::fuzz {
namespace {

std::string text(const CertifiedToi& toi) {
  constexpr std::string_view stages[] = {"guard", "filter", "certificate", "exact"};
  return fuzz::text(toi.verdict) + " in [" + fuzz::text(toi.lower) + ", " + fuzz::text(toi.upper) + "] by " +
         std::string(stages[static_cast<int>(toi.decided_by)]);
}

const char* what_is_torn(const CertifiedToi& toi, bool is_question) {
  if (!is_question) {
    const bool refused = toi.verdict == ToiStatus::invalid && toi.decided_by == DecidedBy::guard;
    return refused && toi.lower != toi.lower && toi.upper != toi.upper ? nullptr : "bad input is not invalid";
  }
  switch (toi.verdict) {
    case ToiStatus::apart: return toi.lower == 1 && toi.upper == 1 ? nullptr : "apart with a bracket";
    case ToiStatus::overlapping: return toi.lower == 0 && toi.upper == 0 ? nullptr : "overlapping with a bracket";
    case ToiStatus::hit:
      return toi.lower >= 0 && toi.lower <= toi.upper && toi.upper <= 1 ? nullptr : "the bracket is out of order";
    default: return "good input has no verdict";
  }
}

template <class A, class B>
Judgment judge_pair(const Exhibit& exhibit, const A& a, const B& b, ToiStatus plain, double time, bool judged) {
  constexpr int quick = 200;  // of exponents: beyond, the bracket of a hit takes seconds of integers of 10^5 bits
  const Moving first{a, exhibit.displacement_a};
  const Moving second{b, exhibit.displacement_b};
  const bool is_quick = is_moderate(first, quick) && is_moderate(second, quick);
  if (valid(first) && valid(second) && !is_quick) return {};
  const CertifiedToi toi = certified_time_of_impact(first, second), back = certified_time_of_impact(second, first);
  const auto fault = [&](const std::string& property, const std::string& details) {
    return Fault{"certified: " + property, text(toi) + "; " + details};
  };
  if (!(toi == back) && toi.lower == toi.lower) return fault("the other way round differs", text(back));
  if (const char* torn = what_is_torn(toi, valid(first) && valid(second))) return fault(torn, "");
  if (!judged || toi.verdict == ToiStatus::invalid) return {};  // axes that are orthonormal to float only
  const auto found = [&](const Judgment& judgment) { return fault(judgment->property, judgment->details); };
  if (const Judgment wrong = judge_bracket(exhibit, toi.verdict, toi.lower, toi.upper)) return found(wrong);
  if (plain == ToiStatus::gave_up || plain == ToiStatus::invalid) return {};
  if (plain != toi.verdict) {
    const Judgment wrong = judge_impact(exhibit, plain, time, 4);
    return wrong ? Judgment(fault("the plain verdict is far off", wrong->property + ", " + wrong->details)) : wrong;
  }
  if (plain != ToiStatus::hit) return {};
  const Judgment outside = judge_time(exhibit, time, toi.lower, toi.upper, 4);
  return outside ? found(outside) : outside;
}

}  // namespace

Judgment judge_certified(const Exhibit& exhibit, ToiStatus plain, double time, bool judged) {
  return std::visit(
      [&]<class A, class B>(const A& a, const B& b) -> Judgment {
        if constexpr (certifies<A, B> && A::rank >= B::rank) {
          return judge_pair(exhibit, a, b, plain, time, judged);
        } else {
          return {};
        }
      },
      exhibit.a, exhibit.b);
}

}  // namespace thinwall::fuzz
