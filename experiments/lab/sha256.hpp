#pragma once
/// SHA-256 (FIPS 180-4), as 64 lowercase hexadecimal digits.

#include <filesystem>
#include <string>
#include <string_view>

namespace thinwall {

std::string sha256(std::string_view bytes);

/// Of a file's content; empty if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace thinwall
