#pragma once
/// What was written, on the disk: so that a power failure finds either the old or the new.

#include <filesystem>

namespace thinwall {

/// Returns when the content of a file, or the names in a folder, are on the disk. Throws std::system_error, also where a
/// file system finds only now that there is no space.
void flush_to_disk(const std::filesystem::path& path);

}  // namespace thinwall
