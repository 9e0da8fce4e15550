#pragma once
/// A reporter that prints as usual and keeps each time, for a closing table.

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace thinwall::bench {

class MedianTimes : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name != "median") continue;
      times_[run.run_name.function_name] = run.GetAdjustedCPUTime();
    }
  }

 protected:
  /// [ns] by benchmark name, the median if it was repeated; 0 if it was not run.
  double time(const std::string& name) const {
    const auto found = times_.find(name);
    return found == times_.end() ? 0 : found->second;
  }

 private:
  std::map<std::string, double> times_;
};

}  // namespace thinwall::bench
