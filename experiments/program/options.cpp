#include <thinwall/experiments/program/options.hpp>

#include <algorithm>
#include <charconv>
#include <limits>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/run/runner.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>
#include <thinwall/experiments/text/spelling.hpp>

namespace thinwall {
namespace {

constexpr int most_threads = 4096;

}  // namespace

void add_flag(CLI::App& command, const std::string& name, bool& flag, const std::string& meaning) {
  command.add_flag(name, flag, meaning)->disable_flag_override();
}

void add_text(CLI::App& command, const std::string& name, OptionText& text, const std::string& meaning,
              const std::string& form) {
  command.add_option(name, text, meaning)->option_text(form);
}

void add_json(CLI::App& command, bool& json) { add_flag(command, "--json", json, "Print one JSON value on stdout"); }

void add_seed(CLI::App& command, OptionText& seed) {
  add_text(command, "--seed", seed, "Chooses the random numbers (default: 0)", "N");
}

void add_threads(CLI::App& command, OptionText& threads) {
  add_text(command, "--threads", threads, "Threads to compute with (default: all cores)", "N");
}

void add_out(CLI::App& command, OptionText& out) {
  add_text(command, "--out", out, "The result folder (default: results/NAME)", "DIR");
}

void add_benchmarks(CLI::App& command, OptionText& folder) {
  add_text(command, "--benchmarks", folder, "Of speed: the folder of the programs to start (default: beside this one)",
           "DIR");
}

void add_target(CLI::App& command, const std::string& name, std::string& target, const std::string& meaning,
                const std::string& form) {
  command.add_option(name, target, meaning)->option_text(form);
}

std::uint64_t parse_seed(const OptionText& text) {
  if (!text) return 0;
  std::uint64_t seed = 0;
  const auto [stop, error] = std::from_chars(text->data(), text->data() + text->size(), seed);
  if (error != std::errc{} || stop != text->data() + text->size()) {
    throw UsageError(fmt::format("--seed: '{}' is not allowed; a whole number from 0 to {}", one_line(*text),
                                 std::numeric_limits<std::uint64_t>::max()));
  }
  return seed;
}

int parse_threads(const OptionText& text) {
  return text ? static_cast<int>(parse_positive("--threads", *text, most_threads)) : default_threads();
}

std::string parse_folder(const OptionText& text) {
  if (text && text->empty()) throw UsageError("--out: '' is not allowed; a folder");
  return text.value_or("");
}

std::int64_t parse_positive(std::string_view option, const std::string& text, std::int64_t most) {
  const auto count = parse_count(text);
  if (!count || *count < 1 || *count > most) {
    throw UsageError(fmt::format("{}: '{}' is not allowed; a whole number from 1 to {}", option, one_line(text), most));
  }
  return *count;
}

std::string parse_choice(std::string_view option, const OptionText& text, std::span<const std::string_view> allowed) {
  if (!text) return "";
  if (std::ranges::find(allowed, *text) == allowed.end()) {
    throw UsageError(
        fmt::format("{}: '{}' is not allowed; {}", option, one_line(*text), spelling_hint(*text, allowed)));
  }
  return *text;
}

}  // namespace thinwall
