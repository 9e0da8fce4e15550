#include <thinwall/experiments/lab/files.hpp>

#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_prefix = ".thinwall-";
constexpr std::size_t check_length = 16;

std::string checksum(std::string_view name) { return sha256(name).substr(0, check_length); }

[[noreturn]] void fail(const fs::path& path, int error) {
  throw std::system_error(error, std::generic_category(), path.string());
}

}  // namespace

std::string file_text(const fs::path& file) {
  std::error_code trouble;
  const auto status = fs::status(file, trouble);
  if (trouble && fs::status_known(status) && !fs::exists(status)) return {};
  if (trouble) throw std::system_error(trouble, file.string());
  if (!fs::is_regular_file(status)) return {};
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, errno != 0 ? errno : EIO);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const fs::path& file, std::string_view text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) fail(file, errno != 0 ? errno : EIO);
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("OpenSSL computes no SHA-256 here");
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

std::string sha256_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return in && !content.bad() ? sha256(content.view()) : std::string();
}

void flush_to_disk(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);  // EINVAL: it keeps nothing
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!done) fail(path, error);
}

std::string temporary_name() {
  std::random_device random;  // of the system: no seed to guess
  std::string name(temporary_prefix);
  for (int word = 0; word < 4; ++word) name += fmt::format("{:08x}", random());
  return name + checksum(name);
}

bool is_temporary_name(std::string_view name) {
  if (!name.starts_with(temporary_prefix) || name.size() != temporary_prefix.size() + 32 + check_length) return false;
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
  if (::mkdir(path_.c_str(), 0700) != 0) fail(folder, errno);  // also if anything is there, be it a link
}

Workshop::~Workshop() {
  std::error_code none;
  fs::remove_all(path_, none);
}

}  // namespace thinwall
