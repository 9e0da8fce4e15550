#include <thinwall/experiments/advise/advice.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>

#include <thinwall/experiments/thin_wall/model.hpp>

namespace thinwall {

namespace {

double lateness(const AdviceRow& row) {
  return row.theory.largest_lateness().value_or(std::numeric_limits<double>::infinity());
}

/// Of the first `meeting` rows, which are sorted by cost, the advised one comes first.
void put_advised_first(std::vector<AdviceRow>& rows, std::ptrdiff_t meeting) {
  if (meeting == 0) return;
  const double noise = rows.front().cost.dearer().spread.upper;
  const auto tied = std::find_if(rows.begin(), rows.begin() + meeting,
                                 [&](const AdviceRow& row) { return row.cost.dearer().spread.lower > noise; });
  const auto least_late = std::min_element(
      rows.begin(), tied, [](const AdviceRow& a, const AdviceRow& b) { return lateness(a) < lateness(b); });
  std::rotate(rows.begin(), least_late, least_late + 1);
}

}  // namespace

bool meets_wish(const Wish& wish, const Theory& theory) {
  if (!theory.probability || *theory.probability > wish.miss + no_chance) return false;
  const std::optional<double> latest = theory.largest_lateness();
  return !wish.late || (latest && *latest <= *wish.late * (1 + no_chance));
}

std::optional<double> longest_step(const Wish& wish, const std::function<Theory(const Cell&)>& theory) {
  const auto met = [&](double step) {
    Cell cell = wish.cell;
    cell.step = step;
    return meets_wish(wish, theory(cell));
  };
  constexpr double shortest = 1e-30;
  if (met(allowed_step.upper)) return allowed_step.upper;
  if (!met(shortest)) return std::nullopt;
  auto good = std::bit_cast<std::uint64_t>(shortest), bad = std::bit_cast<std::uint64_t>(allowed_step.upper);
  while (bad - good > 1) {  // positive doubles are in the order of their bits
    const std::uint64_t middle = good + (bad - good) / 2;
    (met(std::bit_cast<double>(middle)) ? good : bad) = middle;
  }
  return std::bit_cast<double>(good);
}

Advice advise(const Wish& wish, std::span<const Candidate> candidates, std::span<const StepCost> costs) {
  Advice advice = {wish, {}};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Theory theory = candidates[i].theory(wish.cell);
    advice.rows.push_back(
        {candidates[i], theory, costs[i], meets_wish(wish, theory), longest_step(wish, candidates[i].theory)});
  }
  std::stable_sort(advice.rows.begin(), advice.rows.end(), [](const AdviceRow& a, const AdviceRow& b) {
    return std::tuple(!a.meets, a.cost.dearer().median) < std::tuple(!b.meets, b.cost.dearer().median);
  });
  put_advised_first(advice.rows, std::count_if(advice.rows.begin(), advice.rows.end(),
                                               [](const AdviceRow& row) { return row.meets; }));
  return advice;
}

}  // namespace thinwall
