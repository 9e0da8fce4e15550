#pragma once

#include <filesystem>
#include <string>

namespace thinwall {

/// The bytes of a file; none if no regular file is there. Throws std::system_error for one that cannot be read, lest it
/// be taken for an empty one.
std::string file_text(const std::filesystem::path& file);

}  // namespace thinwall
