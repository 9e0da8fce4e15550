#pragma once
/// Files: read and written whole, their SHA-256, what brings them to the disk, and temporary ones that nobody can foresee.

#include <filesystem>
#include <string>
#include <string_view>

#include <boost/core/noncopyable.hpp>

namespace thinwall {

/// The bytes of a file; none if no regular file is there. Throws std::system_error for one that cannot be read, lest it
/// be taken for an empty one.
std::string file_text(const std::filesystem::path& file);

/// In the place of what was there. Throws std::system_error.
void write_file(const std::filesystem::path& file, std::string_view text);

// ---- SHA-256 (FIPS 180-4), as 64 lowercase hexadecimal digits.

std::string sha256(std::string_view bytes);

/// Of a file's content; empty if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

// ---- What was written, on the disk: so that a power failure finds either the old or the new.

/// Returns when the content of a file, or the names in a folder, are on the disk. Throws std::system_error, also where a
/// file system finds only now that there is no space.
void flush_to_disk(const std::filesystem::path& path);

// ---- Names for what lasts only while a process works in a folder. Nobody can foresee one, so nothing of a user's is in its place;
// and a name shows that it is one, so what a killed process left can be told from what a user put there.

/// A name of letters and digits behind `.thinwall-`, at random; its end is a checksum of the rest.
std::string temporary_name();

bool is_temporary_name(std::string_view name);

/// Removes what processes that were killed left in `folder`. Nobody else may be at work there.
void remove_leftovers(const std::filesystem::path& folder);

/// A new folder for ourselves alone in `folder`, gone with this. Throws std::system_error.
class Workshop : boost::noncopyable {
 public:
  explicit Workshop(const std::filesystem::path& folder);
  ~Workshop();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace thinwall
