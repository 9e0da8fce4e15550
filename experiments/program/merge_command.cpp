#include <thinwall/experiments/program/merge_command.hpp>

#include <memory>

#include <CLI/CLI.hpp>

#include <thinwall/experiments/program/options.hpp>
#include <thinwall/experiments/program/perform_run.hpp>
#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/settings.hpp>

namespace thinwall {
namespace {

constexpr const char* merge_examples = R"(  thinwall run thin_wall --shard 1/2 --out part1
  thinwall run thin_wall --shard 2/2 --out part2     on another machine
  thinwall merge part1 part2 --out results/mine
)";

constexpr const char* merge_footer =
    R"(The result is that of one run, to the byte, but for times. Every shard must be there once, whole, of the same
configuration, seed and --trials, by the same build of the program as this one.
)";

struct MergeText {
  std::vector<std::string> folders;
  OptionText out;
  bool json = false;
};

int merge(const MergeText& text, const Call& call) {
  if (text.folders.empty()) throw UsageError("merge: the folders of the shards are missing; see thinwall merge --help");
  RunWish wish;
  wish.out = parse_folder(text.out);
  wish.json = text.json;
  wish.launch = Launch{};
  wish.merged = read_shards(text.folders, this_program_sha256());
  return perform_run(wish, call);
}

Action declare_merge(CLI::App& self) {
  const auto text = std::make_shared<MergeText>();
  self.footer(merge_footer);
  self.add_option("shards", text->folders, "The folders that thinwall run --shard left, in any order")
      ->option_text("SHARD...");
  add_out(self, text->out);
  add_json(self, text->json);
  return [text](const Call& call) { return merge(*text, call); };
}

}  // namespace

Command merge_command() { return {"merge", "Make one result of the shards of a run", merge_examples, declare_merge}; }

}  // namespace thinwall
