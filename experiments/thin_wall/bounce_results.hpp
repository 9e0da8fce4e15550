#pragma once
/// What `response = "bounce"` adds to the results: who went through the wall, unseen or pushed out on the wrong side.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/self_test.hpp>
#include <thinwall/experiments/table.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>

namespace thinwall {

/// The shots that went through: tunneled, or pushed out on the wrong side.
std::int64_t went_through(const Tally& tally);

/// Every cell that theory has a chance of going through for, to be held against the counts.
std::vector<CellCount> through_counts(const std::vector<Line>& lines);

/// Each method at each scalar over all of its cells.
Table bounce_table(const std::vector<Line>& lines);

/// Measurement against theory, as self_test_table() says it.
Table bounce_self_test_table(const std::vector<SelfTest>& tests);

/// In an infinite wall a ball ends behind it if and only if it went through. True if all counts say so.
bool ends_agree(const std::vector<Line>& lines);

/// What the bullet did, method by method, for the terminal.
std::string bounce_text(const std::vector<Line>& lines, const std::vector<SelfTest>& tests);

/// The answer in a sentence or two.
std::string bounce_answer(const std::vector<Line>& lines);

Section bounce_section(const std::vector<SelfTest>& tests);

}  // namespace thinwall
