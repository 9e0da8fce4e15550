#include <thinwall/experiments/results/drawn_figures.hpp>

#include <algorithm>

#include <thinwall/experiments/figures/plot.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> script_names(const fs::path& plots) {
  std::vector<std::string> out;
  if (!fs::is_directory(plots)) return out;
  for (const auto& entry : fs::directory_iterator(plots)) {
    if (entry.path().extension() == ".gp") out.push_back(entry.path().stem().string());
  }
  std::ranges::sort(out);
  return out;
}

constexpr const char* workshop_name = ".drawing";

/// Where gnuplot works, so that plots/ never holds half a file.
class Workshop {
 public:
  explicit Workshop(const fs::path& folder) : path_(folder / workshop_name) {
    fs::remove_all(path_);
    fs::create_directory(path_);
  }
  ~Workshop() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

DrawnFigures draw_figures(const fs::path& folder, const std::vector<std::string>& formats) {
  DrawnFigures out;
  if (formats.empty()) return out;
  const Workshop workshop(folder);
  for (const std::string& name : script_names(folder / "plots")) {
    for (const char* kind : {".gp", ".dat"}) {
      const fs::path from = folder / "plots" / (name + kind);
      if (fs::exists(from)) fs::copy_file(from, workshop.path() / (name + kind));
    }
    for (const std::string& format : formats) {
      const std::string trouble = draw(workshop.path(), name, format);
      if (!trouble.empty()) out.troubles.push_back(name + " was not drawn as " + format + ": " + trouble);
      for (const std::string& file : drawn_files(name, format)) {
        if (!trouble.empty()) continue;
        fs::rename(workshop.path() / file, folder / "plots" / file);
        out.files.push_back("plots/" + file);
      }
    }
  }
  return out;
}

void remove_half_drawn_figures(const fs::path& folder) { fs::remove_all(folder / workshop_name); }

void remove_drawn_figures(const fs::path& folder) {
  for (const std::string& name : script_names(folder / "plots")) {
    for (const char* format : {"pdf", "tex"}) {
      for (const std::string& file : drawn_files(name, format)) fs::remove(folder / "plots" / file);
    }
  }
}

}  // namespace thinwall
