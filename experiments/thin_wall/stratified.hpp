#pragma once
/// The second run: phases spread evenly over the step instead of drawn one by one. Chance is all but gone, so that the
/// count must be within one of n p: a far sharper test of the formula than any number of independent shots, and no test
/// of the random numbers at all. Only for infinite walls, where the phase is all there is to draw, and in double.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/table.hpp>
#include <thinwall/experiments/thin_wall/plan.hpp>

namespace thinwall {

/// Phases (i + c) / n, c random, common to a cell. A prime: it has no factor in common with a number of poses a step, so
/// that the phases are as evenly spread over the gap between two poses as they are over the step.
inline constexpr std::int64_t stratified_shots = 1009;

/// What the stratified run fires: the cells with an infinite wall, at every method in double.
struct StratifiedPlan {
  std::vector<Cell> cells;
  std::vector<Detector> detectors;
};
StratifiedPlan stratified_plan(const ShotPlan& plan);

/// The number that tunneled, by detector, as one line of text.
std::string stratified_counts(const Cell& cell, const std::vector<Detector>& detectors, std::uint64_t seed);

/// The verdict on one method.
struct StratifiedTest {
  std::string method;
  std::int64_t cells = 0;        ///< with a theory
  double largest_deviation = 0;  ///< [1] of |k - n p| over those cells
  bool passed() const { return largest_deviation <= 1; }
};

/// `lines[i]` is what stratified_counts returned for cell i.
std::vector<StratifiedTest> stratified_test(const StratifiedPlan& plan, const std::vector<std::string>& lines);

Table stratified_table(const std::vector<StratifiedTest>& tests);

}  // namespace thinwall
