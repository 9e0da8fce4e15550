#include <thinwall/experiments/run/temporary.hpp>

#include <sys/stat.h>

#include <cerrno>
#include <random>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".thinwall-";
constexpr std::size_t check_length = 16;

std::string checksum(std::string_view name) { return sha256(name).substr(0, check_length); }

}  // namespace

std::string temporary_name() {
  std::random_device random;  // of the system: no seed to guess
  std::string name(prefix);
  for (int word = 0; word < 4; ++word) name += fmt::format("{:08x}", random());
  return name + checksum(name);
}

bool is_temporary_name(std::string_view name) {
  if (!name.starts_with(prefix) || name.size() != prefix.size() + 32 + check_length) return false;
  const std::size_t end = name.size() - check_length;
  return name.substr(end) == checksum(name.substr(0, end));
}

void remove_leftovers(const fs::path& folder) {
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_temporary_name(entry.path().filename().string())) leftovers.push_back(entry.path());
  }
  for (const fs::path& leftover : leftovers) fs::remove_all(leftover);
}

Workshop::Workshop(const fs::path& folder) : path_(folder / temporary_name()) {
  if (::mkdir(path_.c_str(), 0700) != 0)  // fails if anything is there, be it a link
    throw std::system_error(errno, std::generic_category(), path_.string());
}

Workshop::~Workshop() {
  std::error_code none;
  fs::remove_all(path_, none);
}

}  // namespace thinwall
