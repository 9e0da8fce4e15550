#include <thinwall/experiments/stiff_contact/line.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include <thinwall/experiments/stiff_contact/theory.hpp>

namespace thinwall {

namespace {

PenaltyContact contact_of(const BounceSeries& s, double step) {
  return {s.scheme, s.detection, s.stiffness, s.ratio, step};
}

void check_ended(std::istream& in, const std::string& result) {
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a result of stiff_contact: " + result);
}

}  // namespace

bool LimitLine::holds_theory() const {
  if (!theory) return std::isinf(bracket.unstable);
  return bracket.stable <= *theory && *theory <= bracket.unstable;
}

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::stable: return "stable";
    case Verdict::undecided: return "undecided";
    case Verdict::unstable: return "unstable";
  }
  return "";
}

Verdict verdict_of(const StiffPlan& plan, const LimitLine& line, std::size_t i) {
  const double step = plan.steps[i];
  if (line.bracket.stable < step && step < line.bracket.unstable) return Verdict::undecided;
  return line.blow_ups[i] > 0 ? Verdict::unstable : Verdict::stable;
}

std::string limit_result(const StiffPlan& plan, const LimitCell& cell) {
  const LimitBracket bracket = measured_limit(cell.scheme, plan.approach.mass, cell.stiffness, cell.ratio);
  const Spring spring = spring_of(plan.approach.mass, cell.stiffness, cell.ratio);
  std::string result = fmt::format("{:a} {:a}", bracket.stable, bracket.unstable);
  for (const double step : plan.steps) {
    result += fmt::format(" {}", blow_up_step(cell.scheme, spring, step / frequency(spring)));
  }
  return result;
}

LimitLine limit_line(const StiffPlan& plan, const LimitCell& cell, const std::string& result) {
  std::istringstream in(result);
  LimitLine line = {cell, step_limit(cell.scheme, cell.ratio), {0, 0}, {}};
  line.bracket.stable = read_number(in);
  line.bracket.unstable = read_number(in);
  line.blow_ups.resize(plan.steps.size());
  for (std::int64_t& steps : line.blow_ups) in >> steps;
  check_ended(in, result);
  return line;
}

std::string bounce_result(const StiffPlan& plan, const BounceSeries& series) {
  std::string result;
  for (const double step : plan.bounce_steps) {
    result += to_line(bounce_all(plan.approach, contact_of(series, step), plan.seed, plan.bounces)) + " ";
  }
  return result;
}

std::vector<ContactLine> bounce_lines(const StiffPlan& plan, const BounceSeries& series, const std::string& result) {
  std::istringstream in(result);
  std::vector<ContactLine> lines;
  for (const double step : plan.bounce_steps) lines.push_back({contact_of(series, step), bounce_tally_from(in)});
  check_ended(in, result);
  return lines;
}

const ContactLine* twin_of(const std::vector<ContactLine>& lines, const ContactLine& line) {
  for (const ContactLine& other : lines) {
    const PenaltyContact &a = other.contact, &b = line.contact;
    if (a.detection != b.detection && a.scheme == b.scheme && a.stiffness == b.stiffness && a.step == b.step &&
        a.damping_ratio == b.damping_ratio) {
      return &other;
    }
  }
  return nullptr;
}

}  // namespace thinwall
