#pragma once
/// Does what was measured agree with theory? Derived in docs/stiff_contact.md.

#include <string>
#include <vector>

#include <thinwall/experiments/stiff_contact/line.hpp>

namespace thinwall {

/// One claim, over all lines it speaks of.
struct StiffTest {
  std::string claim;
  std::int64_t judged = 0;
  std::int64_t wrong = 0;
  bool passed() const { return wrong == 0; }
};

/// Every bounce came back, and none got past the middle of the wall.
bool is_clean(const StiffPlan& plan, const ContactLine& line);

/// [1] Of the incoming speed: what rounding may do to a bounce.
double rounding(const StiffPlan& plan, const PenaltyContact& contact);

/// [1] The share of bounces whose first pose in contact, if there is one, is past the middle of the wall.
double late_share(const StiffPlan& plan, const PenaltyContact& contact);

std::vector<StiffTest> stiff_tests(const StiffPlan& plan, const std::vector<LimitLine>& limits,
                                   const std::vector<ContactLine>& bounces);
bool all_passed(const std::vector<StiffTest>& tests);

/// The widest bracket, over its limit; 0 if there is none with two ends.
double widest_bracket(const std::vector<LimitLine>& limits);

}  // namespace thinwall
