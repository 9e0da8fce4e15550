#pragma once
/// The program called in this process, as a user calls it, and what it says.

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/program/program.hpp>

#include "support/said.hpp"

namespace thinwall {

using Words = std::vector<std::string>;

inline Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Reply {
  int status;
  std::string out, err;
};

/// `words` behind the program's name.
inline Reply call_program(const Words& words, const std::vector<Experiment>& experiments = {}) {
  std::ostringstream out, err;
  const int status = run_program(joined({"thinwall"}, words), experiments, out, err);
  return {status, out.str(), err.str()};
}

/// It ended so, and of what it said each part of `said` stands on stdout or on stderr.
inline void expect_reply(const Reply& reply, int status, const Words& said) {
  EXPECT_EQ(reply.status, status) << reply.err;
  for (const std::string& part : said) EXPECT_TRUE(holds(reply.out, part) || holds(reply.err, part)) << reply.err;
}

/// The one line on stderr, with its end, of what is refused: exit code 2, and nothing on stdout.
inline const std::string& refusal(const Reply& reply) {
  EXPECT_EQ(reply.status, 2) << reply.err;
  EXPECT_EQ(reply.out, "");
  EXPECT_EQ(std::ranges::count(reply.err, '\n'), 1) << reply.err;
  return reply.err;
}
/// `object` has every member that `some` has, and with the same value.
inline void expect_members(const nlohmann::json& object, const nlohmann::json& some) {
  for (const auto& [name, value] : some.items()) EXPECT_EQ(object.value(name, nlohmann::json()), value) << name;
}

/// It holds every part of `said`.
inline void expect_refusal(const Reply& reply, const Words& said) {
  const std::string& line = refusal(reply);
  for (const std::string& part : said) EXPECT_TRUE(holds(line, part));
}

}  // namespace thinwall
