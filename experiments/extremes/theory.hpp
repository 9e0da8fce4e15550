#pragma once
/// The self-test: the textbook's loss against its theory, and the closed form against its contract.

#include <string>
#include <vector>

#include <thinwall/experiments/extremes/model.hpp>

namespace thinwall {

/// One thing that theory says, held against the cells of one precision.
struct LadderTest {
  std::string what;
  std::size_t precision;
  std::int64_t cells = 0;
  double measured = 0;  ///< the worst of the cells, in the unit of `allowed`
  double least = 0;     ///< what is allowed, from
  double most = 0;      ///< ... to
  std::string where{};  ///< the worst cell
  bool passed() const { return least <= measured && measured <= most; }
};

/// What the textbook's form for two balls should lose: `u k (d / R)^exponent / 2` of the radius, with k <= `most` whatever d / R.
struct LossTheory {
  double exponent = 2;
  double most = 16;   ///< [1] derived in docs/extremes.md
  double spread = 4;  ///< [1] the largest root mean square of k over the least, from decade to decade
};

std::vector<LadderTest> ladder_tests(const std::vector<ExtremeRow>& rows, const LossTheory& theory = {});

}  // namespace thinwall
