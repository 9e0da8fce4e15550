#include <thinwall/experiments/text/file_text.hpp>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace thinwall {

std::string file_text(const std::filesystem::path& file) {
  std::error_code trouble;
  const auto status = std::filesystem::status(file, trouble);
  if (trouble && std::filesystem::status_known(status) && !std::filesystem::exists(status)) return {};
  if (trouble) throw std::system_error(trouble, file.string());
  if (!std::filesystem::is_regular_file(status)) return {};
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace thinwall
