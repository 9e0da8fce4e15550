/// The commands about one thin wall: `thinwall advise` and `thinwall explore`.
#include <thinwall/experiments/program/command.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/program/run.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

constexpr const char* advise_examples = R"(  thinwall advise --speed 10 --radius 0.02 --thickness 0.01 --fps 60
  thinwall advise --speed 900 --radius 0.004 --thickness 0.02 --angle 30 --step 0.001 --miss 0.01 --late 0.05
  thinwall advise --speed 20 --radius 0.02 --length 0.6 --spin 1800 --thickness 0.01 --fps 60
  thinwall advise --speed 10 --radius 0.02 --thickness 0.01 --fps 60 --toml check.toml
  thinwall run check.toml --out results/check              fires the shots that put the advice to the test
)";

constexpr const char* advise_footer =
    R"(Chances and lateness are computed by formula, for one infinite wall and straight flight, of a ball without rotation, or of a
rod that tumbles about its middle: its axis lies in the plane of the wall. Costs are measured, in about a second.
--toml - prints the configuration instead of the advice. More: docs/advise.md.
)";

/// Writes `text`, whole or not at all. An earlier file of the same first line is replaced, anything else that lies there is not.
/// Throws UsageError, which calls the file what `option` was given, and `command` what should have written an earlier one.
void write_own_file(std::string_view option, const fs::path& file, std::string_view text, std::string_view command) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("{} {}: {}", option, one_line(file.string()), why));
  };
  if (file.empty()) throw UsageError(fmt::format("{}: '' is not allowed; a file is needed", option));
  std::error_code error;
  const auto status = fs::status(file, error);
  if (fs::is_directory(status)) refuse("is a folder; a file is needed");
  if (fs::exists(status) && !fs::is_regular_file(status)) refuse("is not a file");
  if (fs::exists(status)) {
    std::string first;
    std::ifstream in(file);
    std::getline(in, first);
    if (first != text.substr(0, text.find('\n')))
      refuse(fmt::format("is there already, and not from {}; another name is needed", command));
  }
  const fs::path fresh = file.string() + ".new";
  if (fs::exists(fresh, error)) refuse("needs the name " + one_line(fresh.string()) + ", which is taken");
  try {
    write_file(fresh, text);
    fs::rename(fresh, file);
  } catch (const std::system_error& why) {
    fs::remove(fresh, error);
    refuse("cannot be written: " + why.code().message());
  }
}

struct AdviseText {
  WishWords words;
  OptionText toml;
  bool json = false;
};

/// A name alone may be that of an experiment, and what begins with - an option: a path is neither.
std::string next_step(const std::string& program, std::string file) {
  if (!looks_like_a_file(file) || file.starts_with('-')) file.insert(0, "./");
  const std::string out = "results/" + fs::path(file).stem().string();
  return "to put it to the test: " + shell_line({program, "run", file, "--out", out}) + "\n";
}

int print_advice(const AdviseText& text, const Call& call) {
  const bool to_file = text.toml && *text.toml != "-";
  if (text.toml && text.toml->empty()) throw UsageError("--toml: '' is not allowed; a file, or - for the terminal");
  if (text.toml && !to_file && text.json) throw UsageError("--toml - and --json both want to be all that is printed");
  const Wish wish = read_wish(text.words);
  if (text.toml) {
    const std::string config = check_config(wish, candidates(wish));
    if (!to_file) {
      call.out << config;
      return exit_done;
    }
    write_own_file("--toml", *text.toml, config, "advise");
  }
  const Advice advice = advise(wish);
  if (text.json) {
    nlohmann::ordered_json reply = advice_json(advice);
    if (to_file) reply["toml"] = *text.toml;
    call.out << json_line(reply);
  } else {
    call.out << advice_text(advice);
  }
  call.out.flush();
  if (to_file) call.err << next_step(call.argv.front(), *text.toml);
  return exit_done;
}

void add_advise(CLI::App& self, AdviseText& text) {
  self.footer(advise_footer);
  add_text(self, "--speed", text.words.speed, "How fast the ball flies, seen from the wall", "M/S");
  add_text(self, "--radius", text.words.radius, "Of the ball or the rod; 0 is a point", "M");
  add_text(self, "--length", text.words.length, "Of a rod in place of the ball, end to end (default: a ball)", "M");
  add_text(self, "--spin", text.words.spin, "Of the rod, degrees a second (default: 0)", "DEG/S");
  add_text(self, "--thickness", text.words.thickness, "Of the wall; 0 is a sheet", "M");
  add_text(self, "--angle", text.words.angle, "Between the flight and the wall's normal (default: 0, head-on)", "DEG");
  add_text(self, "--step", text.words.step, "How long a step is", "S");
  add_text(self, "--fps", text.words.fps, "Or: how many steps there are a second", "N");
  add_text(self, "--miss", text.words.miss, "The largest acceptable chance that a shot tunnels (default: 0)", "P");
  add_text(self, "--late", text.words.late, "How far past first contact a ball may be when seen (default: any)", "M");
  add_json(self, text.json);
  add_text(self, "--toml", text.toml, "Write the experiment that puts the advice to the test; - prints it", "FILE");
}

constexpr const char* explore_examples =
    R"(  thinwall explore                                    writes explore.html and opens it
  thinwall explore --out pages/wall.html --no-open
)";

struct ExploreText {
  OptionText out;
  bool no_open = false, json = false;
};

/// The page with what there is to cite in it.
std::string page_of_this_program() {
  std::string page(embedded_explorer());
  if (page.empty()) {
    throw UsageError(
        "explore: this program was built without the page; install clang-16 lld-16 libc++-16-dev-wasm32 libc++abi-16-dev-wasm32 "
        "libclang-rt-16-dev-wasm32 wasi-libc, and build it with -DTHINWALL_BUILD_EXPLORER=ON");
  }
  constexpr std::string_view place = R"("/*citation*/")";
  const std::string citation = nlohmann::json(bibtex(this_software())).dump();
  return page.replace(page.find(place), place.size(), replaced(citation, {{'<', "\\u003c"}}));
}

/// True if a browser was told to. Where there is no screen none is looked for.
bool opened(const std::string& file) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
  const std::string command = "xdg-open " + shell_line({file}) + " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;  // NOLINT(cert-env33-c): the name is quoted
}

int explore(const ExploreText& text, const Call& call) {
  const std::string file = text.out.value_or("explore.html");
  const std::string page = page_of_this_program();
  if (file == "-") {
    if (text.json)
      throw UsageError("--out -: prints the page, and --json prints what became of a file; give one of them");
    call.out << page;
    return exit_done;
  }
  write_own_file("--out", file, page, "explore");
  const bool shown = !text.no_open && opened(file);
  call.out << (text.json ? json_line({{"page", file}, {"opened", shown}})
                         : one_line(file) + ": the thin wall, to play with\n");
  call.out.flush();
  if (!text.no_open && !shown) call.err << "open it in a browser; it needs nothing else\n";
  return exit_done;
}

void add_explore(CLI::App& self, ExploreText& text) {
  self.footer("One file, which works from a disk and without a network. More: docs/explorer.md.\n");
  add_text(self, "--out", text.out,
           "Where the page goes (default: explore.html); an earlier one is replaced, and - prints it", "FILE");
  add_flag(self, "--no-open", text.no_open, "Open no browser");
  add_json(self, text.json);
}

}  // namespace

std::vector<Command> thin_wall_commands() {
  return {{"advise", "Name the cheapest method that is good enough for a speed, a wall and a step", advise_examples,
           options(add_advise, print_advice)},
          {"explore", "Write a page to play with: shots at a thin wall, beside theory, in a browser", explore_examples,
           options(add_explore, explore)}};
}

}  // namespace thinwall
