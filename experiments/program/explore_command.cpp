#include <cstdlib>
#include <memory>
#include <ostream>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/program/command.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {
namespace {

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
  write_own_file("--out", file, page, "explore");
  const bool shown = !text.no_open && opened(file);
  if (text.json) {
    const nlohmann::ordered_json reply = {{"page", file}, {"opened", shown}};
    call.out << json_line(reply);
  } else {
    call.out << one_line(file) << ": the thin wall, to play with\n";
  }
  call.out.flush();
  if (!text.no_open && !shown) call.err << "open it in a browser; it needs nothing else\n";
  return exit_done;
}

Action declare_explore(CLI::App& self) {
  const auto text = std::make_shared<ExploreText>();
  self.footer("One file, which works from a disk and without a network. More: docs/explorer.md.\n");
  add_text(self, "--out", text->out, "Where the page goes (default: explore.html); an earlier one is replaced", "FILE");
  add_flag(self, "--no-open", text->no_open, "Open no browser");
  add_json(self, text->json);
  return [text](const Call& call) { return explore(*text, call); };
}

}  // namespace

Command explore_command() {
  return {"explore", "Write a page to play with: shots at a thin wall, beside theory, in a browser", explore_examples,
          declare_explore};
}

}  // namespace thinwall
