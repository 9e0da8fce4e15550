#pragma once
/// Options that several commands share: one spelling, one meaning, one complaint.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace thinwall {

/// The text of an option, if it was given at all.
using OptionText = std::optional<std::string>;

void add_flag(CLI::App& command, const std::string& name, bool& flag, const std::string& meaning);
void add_text(CLI::App& command, const std::string& name, OptionText& text, const std::string& meaning,
              const std::string& form);

void add_json(CLI::App& command, bool& json);
void add_seed(CLI::App& command, OptionText& seed);
void add_threads(CLI::App& command, OptionText& threads);
void add_out(CLI::App& command, OptionText& out);
void add_benchmarks(CLI::App& command, OptionText& folder);

/// The word after the command: the help calls it `name` and gives its `form`. Empty if it is missing.
void add_target(CLI::App& command, const std::string& name, std::string& target, const std::string& meaning,
                const std::string& form);

// All throw UsageError, naming the option and what is allowed.
std::uint64_t parse_seed(const OptionText& text);  ///< 0 if not given
int parse_threads(const OptionText& text);         ///< every core if not given
std::string parse_folder(const OptionText& text);  ///< empty if not given
std::int64_t parse_positive(std::string_view option, const std::string& text, std::int64_t most);
std::string parse_choice(std::string_view option, const OptionText& text,
                         std::span<const std::string_view> allowed);  ///< empty if not given

}  // namespace thinwall
