#pragma once
/// The program with the toy experiment alone, called as a user calls it, with a result folder of its own.

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/program/program.hpp>

#include "support/temporary_folder.hpp"
#include "support/toy_experiment.hpp"

namespace thinwall {

struct Reply {
  int status;
  std::string out, err;
};

struct ToyProgram : testing::Test {
  TemporaryFolder folder;
  std::string out = folder / "out";

  ToyProgram() {
    ToyControl::computed = ToyControl::interrupt_after = ToyControl::fail_at = 0;
    ToyControl::pass = true;
  }

  static Reply call(std::vector<std::string> words) {
    const std::vector<Experiment> experiments = {toy_experiment()};
    words.insert(words.begin(), "thinwall");
    std::ostringstream reply, notes;
    const int status = run_program(words, experiments, reply, notes);
    return {status, reply.str(), notes.str()};
  }

  Reply run(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"run", "toy", "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  }

  nlohmann::json manifest() const { return nlohmann::json::parse(read_text(out + "/manifest.json")); }
};

}  // namespace thinwall
