#pragma once
/// Which method to take. Nothing is measured or printed in here: costs come in, the advice goes out.

#include <optional>
#include <span>
#include <vector>

#include <thinwall/experiments/advise/candidates.hpp>
#include <thinwall/experiments/advise/cost.hpp>
#include <thinwall/experiments/advise/wish.hpp>

namespace thinwall {

struct AdviceRow {
  Candidate method;
  Theory theory;  ///< at the step of the wish
  StepCost cost;
  bool meets;                          ///< the wish
  std::optional<double> longest_step;  ///< [s] at which it would; nothing if it does at none
};

struct Advice {
  Wish wish;
  std::vector<AdviceRow> rows;  ///< those that meet the wish first: the advised one, then by cost; then the others

  const AdviceRow* advised() const { return !rows.empty() && rows.front().meets ? &rows.front() : nullptr; }
};

/// To rounding, which formulas computed in double need. False where theory has no number for what is wished for.
bool meets_wish(const Wish& wish, const Theory& theory);

/// [s] The longest allowed step at which it is met, all else as wished: the chance and the lateness grow with the step.
std::optional<double> longest_step(const Wish& wish, const std::function<Theory(const Cell&)>& theory);

/// Advised is the cheapest that meets the wish, by the dearer of its two kinds of steps. Of those whose cost cannot be told
/// from its cost, because the intervals overlap, it is the one that is least late.
Advice advise(const Wish& wish, std::span<const Candidate> candidates, std::span<const StepCost> costs);

}  // namespace thinwall
