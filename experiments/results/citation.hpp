#pragma once
/// BibTeX entries of the software and of one result.

#include <string>

#include <thinwall/experiments/results/record.hpp>

namespace thinwall {

std::string bibtex(const RunRecord& run);

}  // namespace thinwall
