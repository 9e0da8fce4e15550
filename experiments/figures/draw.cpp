#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <thinwall/experiments/figures/plot.hpp>
#include <thinwall/experiments/figures/subprocess.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>

namespace thinwall {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

std::set<std::string> ids_in(const std::string& svg) {
  std::set<std::string> ids;
  for (auto at = svg.find(" id="); at != std::string::npos; at = svg.find(" id=", at)) {
    const char quote = svg[at + 4];
    at += 5;
    ids.insert(svg.substr(at, svg.find(quote, at) - at));
  }
  return ids;
}

/// gnuplot does not always notice that the disk is full.
bool ends_as_it_should(const std::filesystem::path& file) {
  const std::string text = file_text(file);
  const std::string_view end = file.extension() == ".svg" ? "</svg>" : file.extension() == ".pdf" ? "%%EOF" : "\n";
  return text.find(end, text.size() - std::min<std::size_t>(text.size(), 16)) != std::string::npos;
}

}  // namespace

std::vector<std::string> drawn_files(const std::string& name, const std::string& format) {
  if (format == "tex") return {name + "-latex.tex", name + "-latex.pdf"};
  return {name + "." + format};
}

std::string draw(const std::filesystem::path& folder, const std::string& name, const std::string& format) {
  const ProcessResult gnuplot =
      run_process({"gnuplot", "--default-settings", "-e", "format='" + format + "'", name + ".gp"}, folder);
  if (!gnuplot.found) return "gnuplot is not installed";
  const auto is_whole = [&](const std::string& file) { return ends_as_it_should(folder / file); };
  if (gnuplot.status == 0 && std::ranges::all_of(drawn_files(name, format), is_whole)) return {};
  const std::string first = gnuplot.output.substr(0, gnuplot.output.find_last_not_of(" \n") + 1);
  return fmt::format("gnuplot ended with {}: {}", gnuplot.status, one_line(first));
}

std::string inline_svg(std::string svg, const std::string& name, const std::string& label) {
  svg.erase(0, std::min(svg.find("<svg"), svg.size()));
  for (const std::string& id : ids_in(svg)) {
    const std::string own = id.starts_with(name + "_") ? id : name + "_" + id;
    for (const char* form : {" id='{}'", " id=\"{}\"", "'#{}'", "\"#{}\"", "url(#{})"}) {
      replace_all(svg, fmt::format(fmt::runtime(form), id), fmt::format(fmt::runtime(form), own));
    }
  }
  if (const auto begin = svg.find("<title>"), end = svg.find("</title>"); end != std::string::npos && begin < end) {
    svg.replace(begin, end - begin, "<title>" + html_escaped(label));
  }
  return svg.insert(svg.find("<svg") + 4, " role=\"img\" aria-label=\"" + html_escaped(label) + "\"");
}

}  // namespace thinwall
