#include <thinwall/experiments/results/drawn_figures.hpp>

#include <cerrno>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

#include <thinwall/experiments/figures/figure_json.hpp>
#include <thinwall/experiments/figures/plot.hpp>
#include <thinwall/experiments/run/temporary.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {
namespace {

namespace fs = std::filesystem;

/// Of the figures that a manifest names.
std::set<std::string> figure_names(const Manifest& manifest) {
  std::set<std::string> out;
  const auto add = [&](const fs::path& file) {
    if (file.parent_path() == "plots" && file.extension() == ".gp") out.insert(file.stem().string());
  };
  for (const auto& [file, hash] : manifest.hashes) add(file);
  for (const std::string& file : manifest.unhashed) add(file);
  return out;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::system_error(errno ? errno : EIO, std::generic_category(), file.string());
}

/// Writes the script and the data of a figure into `workshop`, from what the folder says of it. Returns what went wrong.
std::string prepare(const fs::path& folder, const std::string& name, const fs::path& workshop) try {
  const std::string file = "plots/" + name + ".json";
  if (!holds_file(folder, file)) return file + " is missing";
  const Figure figure = parse_figure(file_text(folder / file), file);
  if (figure.name != name) return file + " is of another figure";
  write(workshop / (name + ".gp"), plot_script(figure));
  write(workshop / (name + ".dat"), plot_data(figure));
  return {};
} catch (const std::logic_error& error) {
  return error.what();
} catch (const UsageError& error) {
  return error.what();
}

}  // namespace

DrawnFigures draw_figures(const fs::path& folder, const std::vector<std::string>& formats) {
  DrawnFigures out;
  if (formats.empty()) return out;
  const std::string manifest = (folder / manifest_name).string();
  const Workshop workshop(folder);  // so that plots/ never holds half a file
  for (const std::string& name : figure_names(parse_manifest(file_text(manifest), manifest))) {
    const std::string unprepared = prepare(folder, name, workshop.path());
    for (const std::string& format : formats) {
      const std::string trouble = unprepared.empty() ? draw(workshop.path(), name, format) : unprepared;
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

void remove_drawn_figures(const fs::path& folder, const Manifest& manifest) {
  for (const std::string& name : figure_names(manifest)) {
    for (const char* format : {"pdf", "tex"}) {
      for (const std::string& file : drawn_files(name, format)) fs::remove(folder / "plots" / file);
    }
  }
}

}  // namespace thinwall
