#pragma once
/// The tables, pictures and words of the experiment speed.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/speed/timed_way.hpp>

namespace thinwall {

struct SpeedResult {
  std::vector<BenchOutput> outputs;  ///< of every program and round
  std::vector<TimedWay> ways;
};

/// What each gets wrong: the same in every run of the same build.
Table speed_errors_table(const SpeedResult& result);
/// Time, floor and errors of all that find a time of impact, for the report.
Table speed_race_table(const SpeedResult& result);
/// Every row of every program.
Table speed_timings_table(const SpeedResult& result);
/// What the machine can do at best, as each program measured it.
Table speed_floors_table(const SpeedResult& result);
/// Which programs and libraries took part.
Table speed_programs_table(const SpeedResult& result);

std::vector<Figure> speed_figures(const SpeedResult& result);
/// What a row of a batch takes, by pair, scalar and width of vector; without panels where no batch was timed.
Figure batch_figure(const std::vector<TimedWay>& all);
/// A sentence on batches, after a space; empty where none was timed.
std::string batch_text(const std::vector<TimedWay>& all);

std::string speed_answer(const SpeedResult& result);
std::string speed_summary(const SpeedResult& result);
std::vector<Section> speed_sections(const SpeedResult& result);

/// The same errors in every round, and none of our own verdicts wrong.
bool speed_self_test(const SpeedResult& result);

}  // namespace thinwall
