#pragma once
/// One line of the results: a cell, an engine in a mode, what was counted and what theory expects of looking at poses.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/engines/plan.hpp>
#include <thinwall/experiments/self_test.hpp>
#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

struct EngineLine {
  const EngineCell* cell;
  const EngineSetup* setup;
  EngineTally tally;
  std::vector<double> nanoseconds;  ///< a step, one of each volley
  std::optional<double> theory;     ///< [1] chance of going through, where only poses are looked at
};

/// The units' results in the order of engine_units(). `plan` must outlive the lines.
std::vector<EngineLine> engine_lines(const EnginePlan& plan, const std::vector<std::string>& results);

/// Every setup at every cell that it can do, volley by volley, so that engines take turns.
std::vector<Unit> engine_units(const EnginePlan& plan);

double tunneled_share(const EngineLine& line);              ///< [1]
Interval tunneled_interval(const EngineLine& line);         ///< 95 % Wilson
std::optional<double> mean_late(const EngineLine& line);    ///< [steps] of the turned, if any
std::optional<double> mean_energy(const EngineLine& line);  ///< [1] of the turned, if any
std::int64_t wrong_shots(const EngineLine& line);           ///< by the oracle, which sees each of them hit the wall

/// Of the lines at one wall, those at the path that is nearest to a meter: what is told first.
double told_path(const std::vector<EngineLine>& lines);
std::vector<EngineLine> lines_at(const std::vector<EngineLine>& lines, double path, double wall_size);
std::vector<EngineLine> lines_of(const std::vector<EngineLine>& lines, const std::string& label, double wall_size);
std::vector<double> wall_sizes(const std::vector<EngineLine>& lines);
std::vector<std::string> labels_of(const std::vector<EngineLine>& lines);  ///< in the order of the plan

/// [m] The longest path of those asked, at the wall, up to and with which no shot was wrong; 0 if that is none.
double safe_up_to(const std::vector<EngineLine>& lines, const std::string& label, double wall_size);

/// What ours must do: let none through where it sweeps, and what theory says where it looks at poses. Of the latter only the
/// first wall counts: all walls get the same shots, and a test wants independent ones.
std::vector<CellCount> own_counts(const std::vector<EngineLine>& lines);

/// How an engine of others that looks at poses stands to the same theory, at the first wall: told, and held against nobody.
struct EngineAgreement {
  std::string label;
  std::int64_t cells = 0, covered = 0;  ///< those whose 95 % interval holds the theory
  double largest_excess = 0;            ///< [1] of measured over theory, the one farthest from 0
  double at_path = 0;                   ///< [m] where that is
};
std::vector<EngineAgreement> peer_agreement(const std::vector<EngineLine>& lines);

}  // namespace thinwall
