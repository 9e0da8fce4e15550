#pragma once
/// What makes two runs the same run: only then do their results go together.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace thinwall {

class JsonReader;

struct RunIdentity {
  std::string experiment;
  std::string config;  ///< canonical JSON
  std::uint64_t seed = 0;
  std::optional<std::int64_t> trials;  ///< as given on the command line
  std::string program;                 ///< SHA-256 of the program, which knows its commit
  std::string shard = {};              ///< as in `2/4`; empty: the whole run
};

/// One line of canonical JSON.
std::string identity_text(const RunIdentity& identity);

/// The run that the keys experiment, config, seed and trials of an object name, but for its program. Throws UsageError.
RunIdentity read_identity(const JsonReader& object);

/// The identity that `identity_text` wrote; nothing if `text` is none.
std::optional<RunIdentity> parse_identity(std::string_view text);

/// How the run whose `identity_text` was `theirs` differs from ours: `seed 1, not 2`. Empty if it does not, or only in
/// the program that computed it.
std::string identity_difference(std::string_view theirs, const RunIdentity& ours);

/// True if the run whose `identity_text` was `theirs` was computed by this very program.
bool same_program(std::string_view theirs, const RunIdentity& ours);

}  // namespace thinwall
