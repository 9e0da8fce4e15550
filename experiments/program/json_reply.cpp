#include <thinwall/experiments/program/json_reply.hpp>

#include <nlohmann/json.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;

ordered_json size_of(const RunRecord& run, const std::string& out) {
  return {{"experiment", run.experiment}, {"out", out},       {"units", run.units},
          {"trials", run.total_trials},   {"seed", run.seed}, {"threads", run.threads}};
}

std::string line(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string list_reply(std::span<const Experiment> experiments) {
  ordered_json out = ordered_json::array();
  for (const Experiment& experiment : experiments) {
    out.push_back({{"name", experiment.name}, {"question", experiment.question}});
  }
  return line(out);
}

std::string dry_run_reply(const RunRecord& run, const std::string& out, double seconds, const RunEstimate& told) {
  ordered_json reply = size_of(run, out);
  reply["dry_run"] = true;
  reply["estimated_seconds"] = told.tried() > 0 ? ordered_json(seconds) : ordered_json();
  reply["units_left_out_of_estimate"] = told.unknown;
  reply["estimated_from"] = basis_text(told);
  return line(reply);
}

std::string list_cells_reply(const RunRecord& run, const std::string& out, std::span<const Unit> units) {
  ordered_json reply = size_of(run, out);
  reply["cells"] = ordered_json::array();
  for (const Unit& unit : units) reply["cells"].push_back({{"key", unit.key}, {"trials", unit.trials}});
  return line(reply);
}

std::string shard_json(const RunRecord& run, const std::string& out, const std::string& shard) {
  ordered_json reply = size_of(run, out);
  reply["shard"] = shard;
  reply["resumed_units"] = run.resumed_units;
  return line(reply);
}

std::string run_reply(const RunRecord& run, const std::string& out, const Outcome& outcome, const std::string& report) {
  ordered_json reply = size_of(run, out);
  reply["resumed_units"] = run.resumed_units;
  reply["answer"] = outcome.answer;
  reply["self_test_passed"] = outcome.self_test_passed;
  reply["report"] = report;
  return line(reply);
}

}  // namespace thinwall
