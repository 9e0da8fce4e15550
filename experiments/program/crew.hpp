#pragma once
/// The ranks that compute one run together. Rank 0 holds the folder, tells the others what is left to do, gathers what
/// they did into its journal, and goes on alone. Each keeps what it has finished in a journal of its own until then, so that
/// a killed run loses no more than any other.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/results/result_folder.hpp>
#include <thinwall/experiments/run/ranks.hpp>
#include <thinwall/experiments/run/runner.hpp>

namespace thinwall {

class Crew {
 public:
  /// A crew of one needs no MPI. Throws UsageError as Ranks does.
  Crew(const Launch& launch, std::span<const Unit> units);
  ~Crew();  ///< sends home ranks that still wait for rank 0
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  bool leads() const { return ranks_.rank() == 0; }
  int count() const { return ranks_.count(); }

  /// Of the leader: what `compute_units` returns, by all ranks.
  UnitResults compute(ResultFolder& folder, const std::string& identity, const RunnerOptions& options);

  /// Of the others: computes what the leader says, into a journal in `folder`. Returns the exit code.
  int assist(const std::filesystem::path& folder, const std::string& identity, const RunnerOptions& options);

 private:
  std::vector<Unit> share_of(const std::vector<std::uint8_t>& open) const;  // this rank's

  Ranks ranks_;
  std::span<const Unit> units_;
  bool told_ = false;  // the others know what to do
};

}  // namespace thinwall
