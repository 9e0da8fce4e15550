#include <thinwall/experiments/lab/draw.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/settings.hpp>

namespace thinwall {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> marks = {"points", "line", "dashes", "cells"};  // of a Mark

/// The lists of a series, by name.
constexpr std::array<std::pair<const char*, std::vector<double> Series::*>, 6> lists_of_series = {
    {{"x", &Series::x},
     {"y", &Series::y},
     {"lower", &Series::lower},
     {"upper", &Series::upper},
     {"x_lower", &Series::x_lower},
     {"x_upper", &Series::x_upper}}};

/// The named tics of a panel, by name.
constexpr std::array<std::pair<const char*, std::vector<Tic> Panel::*>, 3> named_tics = {
    {{"x_tics", &Panel::x_tics}, {"y_tics", &Panel::y_tics}, {"x_groups", &Panel::x_groups}}};

ordered_json json_of(const Series& series) {
  const std::string_view mark = marks.at(static_cast<std::size_t>(series.mark));
  ordered_json out = {{"label", series.label}, {"mark", mark}, {"color", series.color}};
  for (const auto& [name, list] : lists_of_series) {
    out[name] = ordered_json::array();
    for (const double value : series.*list) out[name].push_back(std::isfinite(value) ? ordered_json(value) : nullptr);
  }
  return out;
}

ordered_json json_of(const Panel& panel) {
  ordered_json out = {{"x_label", panel.x_label}, {"y_label", panel.y_label}, {"log_x", panel.log_x},
                      {"log_y", panel.log_y},     {"height", panel.height},   {"series", ordered_json::array()}};
  for (const Series& series : panel.series) out["series"].push_back(json_of(series));
  for (const auto& [name, list] : named_tics) {
    out[name] = ordered_json::array();
    for (const Tic& tic : panel.*list) out[name].push_back({{"at", tic.at}, {"label", tic.label}});
  }
  return out;
}

bool is_mark(std::string_view text) { return std::ranges::find(marks, text) != marks.end(); }

/// Also the letters that gnuplot is told without quotes of its own: none of them may end the quotes.
bool is_color(std::string_view text) {
  return text.empty() || (text.size() == 7 && text[0] == '#' &&
                          text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos);
}

Series series_of(const JsonReader& in) {
  Series out;
  out.label = in.text("label");
  const std::string mark = in.text("mark", is_mark, "points, line, dashes or cells");
  out.mark = static_cast<Mark>(std::ranges::find(marks, mark) - marks.begin());
  out.color = in.text("color", is_color, "#rrggbb, or nothing");
  for (const auto& [name, list] : lists_of_series) out.*list = in.numbers(name);
  return out;
}

Panel panel_of(const JsonReader& in) {
  Panel out;
  out.x_label = in.text("x_label");
  out.y_label = in.text("y_label");
  out.log_x = in.flag("log_x");
  out.log_y = in.flag("log_y");
  out.height = in.number("height");
  if (!(out.height > 0 && out.height <= 100)) in.complain("height", "a number > 0 and <= 100");
  for (const JsonReader& series : in.objects("series")) out.series.push_back(series_of(series));
  for (const auto& [name, list] : named_tics) {
    for (const JsonReader& tic : in.objects(name)) (out.*list).push_back({tic.number("at"), tic.text("label")});
  }
  return out;
}

/// The figure that `figure_json` wrote, but for its caption. Throws UsageError in one line, which names `file`.
Figure parse_figure(const std::string& text, const std::string& file) {
  const JsonReader in(text, file);
  Figure out;
  out.name = in.text("name");
  out.title = in.text("title");
  for (const JsonReader& panel : in.objects("panels")) out.panels.push_back(panel_of(panel));
  if (in.has("roster")) out.roster = in.texts("roster");
  return out;
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

constexpr int no_such_program = 127;  // as a shell says it

/// The child's part: only calls that are safe between fork and exec in a program with threads.
[[noreturn]] void become(char* const* words, const char* folder, int output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // if we are killed, it must not write into the folder of the next run
  ::setpgid(0, 0);                     // Ctrl-C on the terminal is for us: we wait for the child
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  if (::chdir(folder) == 0) ::execvp(words[0], words);
  ::_exit(errno == ENOENT ? no_such_program : 126);
}

std::string read_all(int descriptor) {
  std::string out;
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return out;
    out.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// Of the figures that a manifest names.
std::set<std::string> figure_names(const Manifest& manifest) {
  std::set<std::string> out;
  for (const fs::path file : manifest.files()) {
    if (file.parent_path() == "plots" && file.extension() == ".gp") out.insert(file.stem().string());
  }
  return out;
}

/// Writes the script and the data of a figure into `workshop`, from what the folder says of it. Returns what went wrong.
std::string prepare(const fs::path& folder, const std::string& name, const fs::path& workshop) try {
  const std::string file = "plots/" + name + ".json";
  if (!holds_file(folder, file)) return file + " is missing";
  const Figure figure = parse_figure(file_text(folder / file), file);
  if (figure.name != name) return file + " is of another figure";
  write_file(workshop / (name + ".gp"), plot_script(figure));
  write_file(workshop / (name + ".dat"), plot_data(figure));
  return {};
} catch (const std::logic_error& error) {
  return error.what();
} catch (const UsageError& error) {
  return error.what();
}

/// The files that NAME.gp writes in a format: svg, pdf or tex.
std::vector<std::string> drawn_files(const std::string& name, const std::string& format) {
  if (format == "tex") return {name + "-latex.tex", name + "-latex.pdf"};
  return {name + "." + format};
}

}  // namespace

std::string figure_json(const Figure& figure) {
  ordered_json out = {{"name", figure.name}, {"title", figure.title}, {"panels", ordered_json::array()}};
  for (const Panel& panel : figure.panels) out["panels"].push_back(json_of(panel));
  if (!figure.roster.empty()) out["roster"] = figure.roster;
  return json_line(out);
}

std::string draw(const std::filesystem::path& folder, const std::string& name, const std::string& format) {
  const ProcessResult gnuplot =
      run_process({"gnuplot", "--default-settings", "-e", "format='" + format + "'", name + ".gp"}, folder);
  if (!gnuplot.found) return "gnuplot is not installed";
  const auto is_whole = [&](const std::string& file) { return ends_as_it_should(folder / file); };
  if (gnuplot.status == 0 && std::ranges::all_of(drawn_files(name, format), is_whole)) return {};
  if (gnuplot.status == -1) return "gnuplot was ended by a signal";
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

ProcessResult run_process(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  std::vector<std::string> copies = words;
  std::vector<char*> pointers;
  for (std::string& word : copies) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) become(pointers.data(), folder.c_str(), pipe[1]);
  ::close(pipe[1]);
  ProcessResult out;
  out.output = read_all(pipe[0]);
  ::close(pipe[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  out.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  out.found = out.status != no_such_program;
  return out;
}

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
