#pragma once
/// What the benchmark of batches says: the picture of it, and a sentence.

#include <string>
#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/speed/model.hpp>

namespace thinwall {

/// What a row of a batch takes, by pair, scalar and width of vector; without panels where no batch was timed.
Figure batch_figure(const std::vector<TimedWay>& all);

/// A sentence on batches, after a space; empty where none was timed.
std::string batch_text(const std::vector<TimedWay>& all);

}  // namespace thinwall
