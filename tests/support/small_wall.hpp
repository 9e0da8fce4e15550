#pragma once
/// The headline experiment in small, for tests of the program as it is: many units, every kind of file, in half a second.

#include <map>
#include <string>

#include "support/temporary_folder.hpp"

namespace thinwall {

inline constexpr const char* small_wall = R"(experiment = "thin_wall"
shots = 600
speed = [10, 200]
step = [0.016666666666666666]
radius = [0.001, 0.02]
thickness = [0.01]
angle_deg = [0, 60]
)";

/// Everything in a result folder that must not differ from run to run: the date in cite.bib may.
inline std::map<std::string, std::string> lasting_files(const std::filesystem::path& folder) {
  auto files = files_in(folder);
  for (const char* name : {"data/timings.csv", "report.html", "manifest.json"})
    EXPECT_EQ(files.erase(name), 1u) << name;
  const std::string& cite = files["cite.bib"];
  EXPECT_NE(cite.find("@misc{"), std::string::npos) << cite;
  files["cite.bib"] = cite.substr(0, cite.find("  date   = ", cite.find("@misc{")));
  return files;
}

}  // namespace thinwall
