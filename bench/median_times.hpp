#pragma once
/// A reporter that prints as usual and keeps each time, for a closing table.

#include <map>
#include <string>
#include <vector>

#include "floors.hpp"

namespace thinwall::bench {

class MedianTimes : public FloorReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    FloorReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name != "median") continue;
      times_[run.run_name.function_name] = run.GetAdjustedCPUTime();
      if (const auto ratio = run.counters.find("to_floor"); ratio != run.counters.end())
        to_floor_[run.run_name.function_name] = ratio->second.value;
    }
  }

 protected:
  /// [ns] by benchmark name, the median if it was repeated; 0 if it was not run.
  double time(const std::string& name) const { return value(times_, name); }

  /// [1] its time over its floor, the same way.
  double to_floor(const std::string& name) const { return value(to_floor_, name); }

 private:
  using Values = std::map<std::string, double>;
  static double value(const Values& values, const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? 0 : found->second;
  }

  Values times_, to_floor_;
};

}  // namespace thinwall::bench
