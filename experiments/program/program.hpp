#pragma once
/// The `thinwall` program without its `main`, so that a test can call it with experiments of its own.

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

/// Returns the exit code: 0 done, 1 a run or its self-test failed or a verdict is wrong, 2 bad input, 130 interrupted.
int run_program(const std::vector<std::string>& argv, std::span<const Experiment> experiments, std::ostream& out,
                std::ostream& err);

}  // namespace thinwall
