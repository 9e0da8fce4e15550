#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

void write_own_file(std::string_view option, const std::filesystem::path& file, std::string_view text,
                    std::string_view command) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("{} {}: {}", option, one_line(file.string()), why));
  };
  if (file.empty()) throw UsageError(fmt::format("{}: '' is not allowed; a file is needed", option));
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) refuse("is a folder; a file is needed");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) refuse("is not a file");
  if (std::filesystem::exists(status)) {
    std::string first;
    std::ifstream in(file);
    std::getline(in, first);
    if (first != text.substr(0, text.find('\n')))
      refuse(fmt::format("is there already, and not from {}; another name is needed", command));
  }
  const std::filesystem::path fresh = file.string() + ".new";
  if (std::filesystem::exists(fresh, error)) refuse("needs the name " + one_line(fresh.string()) + ", which is taken");
  try {
    write_file(fresh, text);
    std::filesystem::rename(fresh, file);
  } catch (const std::system_error& why) {
    std::filesystem::remove(fresh, error);
    refuse("cannot be written: " + why.code().message());
  }
}

}  // namespace thinwall
