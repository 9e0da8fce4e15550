#pragma once
/// The lines of the results, and how a unit of the run hands them on as text.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/stiff_contact/growth.hpp>
#include <thinwall/experiments/stiff_contact/plan.hpp>
#include <thinwall/experiments/stiff_contact/tally.hpp>

namespace thinwall {

/// One spring that holds both ways: where stable ends, and what each step of the map does.
struct LimitLine {
  LimitCell cell;
  std::optional<double> theory;        ///< [1/omega] the limit; nothing: there is none
  LimitBracket bracket;                ///< [1/omega] measured
  std::vector<std::int64_t> blow_ups;  ///< for each step of the map, after how many steps it blew up; 0: it did not

  bool holds_theory() const;  ///< the bracket does
};

enum class Verdict { stable, undecided, unstable };
std::string_view name(Verdict verdict);

/// What was measured at step `i` of the map: undecided inside the bracket.
Verdict verdict_of(const StiffPlan& plan, const LimitLine& line, std::size_t i);

/// One wall that only pushes, at one step, over all phases.
struct ContactLine {
  PenaltyContact contact;
  ContactTally tally;
};

std::string limit_result(const StiffPlan& plan, const LimitCell& cell);
LimitLine limit_line(const StiffPlan& plan, const LimitCell& cell, const std::string& result);

std::string bounce_result(const StiffPlan& plan, const BounceSeries& series);
std::vector<ContactLine> bounce_lines(const StiffPlan& plan, const BounceSeries& series, const std::string& result);

/// The one of the same wall and step with the other detection, or nothing.
const ContactLine* twin_of(const std::vector<ContactLine>& lines, const ContactLine& line);

}  // namespace thinwall
