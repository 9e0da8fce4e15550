/// `thinwall advise` and others, as the user calls them.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/program.hpp>
#include <thinwall/experiments/program/run.hpp>
#include <thinwall_embedded.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "experiments/speed_run.hpp"
#include "support/program.hpp"
#include "support/toy.hpp"

namespace thinwall {

namespace {

struct AdviseProgram : ::testing::Test {
  TemporaryFolder folder;

  static Reply advise(const Words& more, const std::string& thickness = "0.01") {
    return ToyProgram::call(joined({"advise", "--speed", "10", "--radius", "0.02", "--thickness", thickness}, more));
  }

  /// `said`: what the one line must start with.
  static void expect_refusal(const Reply& reply, const std::string& said) {
    EXPECT_TRUE(refusal(reply).starts_with(said)) << reply.err;
  }
};

TEST_F(AdviseProgram, answers_in_json_and_writes_the_experiment) {
  const std::string file = folder / "check.toml";
  const Reply reply = advise({"--fps", "60", "--json", "--toml", file});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_TRUE(holds(reply.err, "thinwall run " + file));
  const nlohmann::json json = nlohmann::json::parse(reply.out);
  EXPECT_EQ(json["toml"], file);
  EXPECT_EQ(json["step_s"], 1.0 / 60);
  EXPECT_TRUE(json["method"].is_string());
  const std::string written = read_text(file);
  EXPECT_EQ(advise({"--step", "0.016666666666666666", "--toml", "-"}).out, written) << "fps and step are the same";
  EXPECT_TRUE(holds(written, "speed = [10]"));
  EXPECT_EQ(files_in(folder.path()).size(), 1U);
}

TEST_F(AdviseProgram, names_the_experiment_as_a_path) {
  for (const char* name : {"thin_wall", "-x.toml"}) {
    const ProcessResult said = run_process({THINWALL_PROGRAM, "advise", "--speed", "10", "--radius", "0.02",
                                            "--thickness", "0.01", "--fps", "60", std::string("--toml=") + name},
                                           folder.path());
    EXPECT_TRUE(holds(said.output, std::string("thinwall run ./") + name + " --out")) << said.output;
  }
}

TEST_F(AdviseProgram, replaces_an_experiment_of_its_own_and_nothing_else) {
  const std::string file = folder / "check.toml";
  write_text(file, "# mine\n");
  expect_refusal(advise({"--fps", "60", "--toml", file}), "--toml " + file + ": is there already");
  EXPECT_EQ(read_text(file), "# mine\n");
  write_text(file, advise({"--fps", "30", "--toml", "-"}).out);
  EXPECT_EQ(advise({"--fps", "60", "--json", "--toml", file}).status, 0);
  EXPECT_EQ(read_text(file), advise({"--fps", "60", "--toml", "-"}).out);
}

/// Where the page was not built, its command says what builds it.
TEST(ExploreProgram, writes_the_page_over_its_own_alone_or_says_what_is_missing) {
  const TemporaryFolder folder;
  const std::string file = folder / "wall.html";
  const auto explore = [&](const std::string& out) { return ToyProgram::call({"explore", "--no-open", "--out", out}); };
  if (embedded_explorer().empty()) {
    AdviseProgram::expect_refusal(explore(file), "explore: this program was built without the page; install clang-16");
    GTEST_SKIP() << "the page was not built";
  }
  EXPECT_EQ(explore(file).status, 0);
  const std::string page = read_text(file);
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_TRUE(holds(page, "@software{"));
  EXPECT_EQ(explore(file).status, 0) << "its own, again";
  write_text(file, "mine\n");
  AdviseProgram::expect_refusal(explore(file), "--out " + file + ": is there already, and not from explore");
  EXPECT_EQ(read_text(file), "mine\n");
  AdviseProgram::expect_refusal(explore(folder.path().string()), "--out " + folder.path().string() + ": is a folder");
  EXPECT_TRUE(explore("-").out.starts_with("<!doctype html>"));
  AdviseProgram::expect_refusal(explore(""), "--out: '' is not allowed");
  AdviseProgram::expect_refusal(explore(folder / "none/x.html"), "--out");
}

TEST_F(AdviseProgram, names_what_is_wrong) {
  expect_refusal(ToyProgram::call({"advise", "--radius", "1"}),
                 "--speed is missing; a number > 0 and <= 1000000000 [m/s]");
  expect_refusal(advise({}), "--step [s] or --fps [1/s] is missing");
  expect_refusal(advise({"--step", "0.1", "--fps", "10"}), "--step and --fps say the same thing twice");
  expect_refusal(advise({"--fps", "60"}, "-1"), "--thickness: '-1' is not allowed; a number >= 0");
  expect_refusal(advise({"--fps", "60"}, "1mm"), "--thickness: '1mm' is not allowed");
  expect_refusal(advise({"--fps", "60"}, ""), "--thickness: '' is not allowed");
  for (const std::string bad : {"0", "-1", "nan", "inf", "-inf", "1e999", "0x10"}) {
    expect_refusal(ToyProgram::call({"advise", "--speed", bad}), "--speed: '" + bad + "' is not allowed; a number > 0");
    expect_refusal(advise({"--step", bad}), "--step: '" + bad + "' is not allowed; a number > 0");
    expect_refusal(advise({"--fps", bad}), "--fps: '" + bad + "' is not allowed; a number >= 0.001");
  }
  const auto expect_no_value = [](const std::string& option, const std::string& bad, const std::string& allowed) {
    expect_refusal(advise({"--fps", "60", option, bad}),
                   option + ": '" + bad + "' is not allowed; a number " + allowed);
  };
  for (const char* bad : {"90", "89.95", "-10", "nan"}) expect_no_value("--angle", bad, ">= 0 and <= 89.9");
  for (const char* bad : {"1.01", "-0.1", "nan", "5%"}) expect_no_value("--miss", bad, ">= 0 and <= 1");
  expect_no_value("--late", "-1", ">= 0 [m]");
  expect_refusal(
      ToyProgram::call({"advise", "--speed", "1e-300", "--radius", "1", "--thickness", "1", "--step", "1e-5"}),
      "--speed 1e-300: in a step of 1e-05 s the ball moves 1e-305 m; at least 1e-30 m is needed");
  expect_refusal(advise({"--fps", "60", "--toml", ""}), "--toml: ''");
  expect_refusal(advise({"--fps", "60", "--toml", "-", "--json"}), "--toml - and --json");
  expect_refusal(advise({"--fps", "60", "--toml", folder.path().string()}),
                 "--toml " + folder.path().string() + ": is a folder");
  expect_refusal(advise({"--fps", "60", "--toml", folder / "no/where.toml"}),
                 "--toml " + (folder / "no/where.toml") + ": cannot be");
}

// ---- BibTeX on stdout: of the software, and of a result.

using CiteTest = ToyProgram;

TEST_F(CiteTest, cites_the_software_as_its_citation_file_does) {
  const Reply reply = call({"cite"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_TRUE(reply.out.starts_with("@software{thinwall,\n  author  = {{The thinwall authors}},\n")) << reply.out;
  EXPECT_TRUE(holds(reply.out, "  title   = {thinwall: continuous collision detection and tunneling research},\n"));
  EXPECT_TRUE(holds(reply.out, "  version = {" + this_software().version + "},\n"));
  EXPECT_EQ(std::ranges::count(reply.out, '{'), std::ranges::count(reply.out, '}'));
}

TEST_F(CiteTest, cites_a_result_as_its_folder_does) {
  ASSERT_EQ(run({"--seed", "3"}).status, 0);
  const Reply reply = call({"cite", out});
  EXPECT_EQ(call({"cite", "--", out}).out, reply.out);
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(reply.out, read_text(out + "/cite.bib"));
  const std::string run_id = manifest().at("run_id");
  EXPECT_TRUE(holds(reply.out, "@misc{thinwall_toy_" + run_id + ","));
  EXPECT_TRUE(holds(reply.out, "{What is a square?}"));
  EXPECT_TRUE(holds(reply.out, "run " + run_id + ", seed 3, commit "));
}

TEST_F(CiteTest, replies_in_json) {
  ASSERT_EQ(run({"--seed", "3"}).status, 0);
  const auto json = nlohmann::json::parse(call({"cite", out, "--json"}).out);
  expect_members(json.at("result"), {{"experiment", "toy"},
                                     {"title", "What is a square?"},
                                     {"run_id", manifest().at("run_id")},
                                     {"seed", 3},
                                     {"commit", manifest().at("program").at("commit")},
                                     {"date", manifest().at("finished").get<std::string>().substr(0, 10)}});
  EXPECT_FALSE(nlohmann::json::parse(call({"cite", "--json"}).out).contains("result"));
}

TEST_F(CiteTest, keeps_the_version_and_date_of_the_program_that_made_the_result) {
  ASSERT_EQ(run().status, 0);
  change_manifest("/program/version", "9.8.7");
  change_manifest("/program/release_date", "2031-02-03");
  EXPECT_TRUE(holds(call({"cite", out}).out, "  version = {9.8.7},\n  date    = {2031-02-03},\n  year    = {2031},\n"));
}

TEST_F(CiteTest, escapes_every_field) {
  const std::string entry = bibtex(ResultCitation{.experiment = "a_b",
                                                  .question = "100 %?",
                                                  .run_id = "1}",
                                                  .seed = 1,
                                                  .commit = "a}, note={",
                                                  .dirty = false,
                                                  .date = "2031}%"});
  for (const char* part : {"@misc{thinwall_a_b_1,", "100 \\%?", "run 1{\\textbraceright},",
                           "{2031{\\textbraceright}\\%}", "commit a{\\textbraceright}, note={\\textbraceleft}}"})
    EXPECT_TRUE(holds(entry, part)) << part << " in\n" << entry;
}

TEST_F(CiteTest, refuses_what_holds_no_result) {
  const auto expect_no_result = [this](const std::string& target, const std::string& why) {
    for (const char* command : {"cite", "report", "reproduce"})
      expect_refused({command, target}, {target + ": " + why});
  };
  expect_no_result(folder / "none", "there is no such folder");
  expect_no_result(folder / std::string(300, 'x'), "cannot be read: File name too long");
  expect_no_result(folder.path().string(), "holds no manifest.json");
  write_text(folder / "journal.tsv", "");
  expect_no_result(folder.path().string(), "holds a run that is not finished");
  write_text(folder / "manifest.json", "{\"thinwall_manifest\": 1}");
  EXPECT_EQ(call({"cite", folder.path().string()}).err, folder / "manifest.json: key 'program': missing\n");
  expect_no_result(folder / "manifest.json", "is not a folder");
  EXPECT_EQ(refusal(call({"cite", ""})), "cite: the folder of a result is empty; name one, or none\n");
}

// ---- The completion scripts, read by the shells they are for.

namespace fs = std::filesystem;

struct CompletionTest : ::testing::Test {
  TemporaryFolder folder;
  using Offers = std::set<std::string>;

  ProcessResult in_folder(const Words& words) const { return run_process(words, folder.path()); }

  std::string script(const std::string& shell) const {
    const ProcessResult reply = in_folder({THINWALL_PROGRAM, "completion", shell});
    EXPECT_EQ(reply.status, 0) << reply.output;
    return reply.output;
  }

  /// What bash offers for the last of the words.
  Offers completed(const Words& words) const {
    write_text(folder / ".completion", script("bash"));
    std::string line = "set -u; source .completion; COMP_WORDS=(";
    for (const std::string& word : words) line += "'" + word + "' ";
    line += "); COMP_CWORD=" + std::to_string(words.size() - 1) + "; _thinwall; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const ProcessResult reply = in_folder({"bash", "--norc", "-c", line});
    EXPECT_EQ(reply.status, 0) << reply.output;
    Offers out;
    std::istringstream lines(reply.output);
    for (std::string word; std::getline(lines, word);) {
      if (!word.empty()) out.insert(word);
    }
    return out;
  }
};

TEST_F(CompletionTest, bash_completes_commands_experiments_and_options) {
  EXPECT_EQ(completed({"thinwall", "ru"}), Offers{"run"});
  EXPECT_EQ(completed({"thinwall", "run", "thin_w"}), Offers{"thin_wall"});
  EXPECT_EQ(completed({"thinwall", "run", "--tr"}), (Offers{"--trials", "--trace"}));
  EXPECT_EQ(completed({"thinwall", "run", "thin_wall", "--plan", ""}), (Offers{"lean", "full"}));
  EXPECT_EQ(completed({"thinwall", "completion", "z"}), Offers{"zsh"});
  EXPECT_EQ(completed({"thinwall", "run", "--seed", ""}), Offers{}) << "a number";
  EXPECT_EQ(completed({"thinwall", "nothing", ""}), Offers{});
  const Offers commands_offered = completed({"thinwall", ""});
  for (const Command& command : commands()) EXPECT_TRUE(commands_offered.contains(command.name)) << command.name;
}

TEST_F(CompletionTest, bash_completes_files_and_folders_where_they_may_stand) {
  write_text(folder / "thin my.toml", "");
  write_text(folder / "thin.txt", "");
  fs::create_directory(folder / "things");
  EXPECT_EQ(completed({"thinwall", "run", "thin"}), (Offers{"thin_wall", "thin my.toml", "things"}));
  EXPECT_EQ(completed({"thinwall", "compare", "thi"}), (Offers{"thin my.toml", "things"}));
  EXPECT_EQ(completed({"thinwall", "run", "thin_wall", "--out", "th"}), Offers{"things"});
  EXPECT_EQ(completed({"thinwall", "reproduce", "th"}), Offers{"things"});
}

TEST_F(CompletionTest, other_shells_can_read_their_scripts) {
  for (const char* shell : {"zsh", "fish"}) {
    const std::string text = script(shell);
    for (const Command& command : commands()) EXPECT_TRUE(holds(text, command.name)) << command.name;
    write_text(folder / shell, text);
    const ProcessResult reply = in_folder({shell, "-n", folder / shell});
    if (!reply.found) {
      std::printf("%s is not installed: its script was not read by it\n", shell);
      continue;
    }
    EXPECT_EQ(reply.status, 0) << reply.output;
    EXPECT_EQ(reply.output, "");
  }
}

TEST_F(CompletionTest, knows_every_option_of_every_command_and_its_meaning) {
  for (const CompletedCommand& command : completed_commands({})) {
    EXPECT_FALSE(command.summary.empty()) << command.name;
    EXPECT_TRUE(std::ranges::any_of(command.options, [](const auto& option) { return option.name == "--json"; }))
        << command.name << " replies to no script";
    for (const CompletedOption& option : command.options)
      EXPECT_FALSE(option.meaning.empty()) << command.name << " " << option.name;
  }
}

// ---- How the program talks: one JSON value on stdout where it is asked for, everything else as text on stderr, no escape
// sequence where nobody watches, help that begins with an example, and exit codes as the documents say.

struct MannersTest : ToyProgram {
  std::string scene = folder / "scene.toml";

  MannersTest() { write_text(scene, bullet_text("policy = 'discrete'\n")); }
};

TEST_F(MannersTest, json_is_one_value_on_stdout_and_all_else_is_text_on_stderr) {
  const std::vector<Words> calls = {{"list"},
                                    {"run", "toy", "--out", out, "--threads", "1"},
                                    {"run", "toy", "--out", out},  // complete already
                                    {"run", "toy", "--dry-run"},
                                    {"run", "toy", "--list-cells"},
                                    {"run", scene, "--out", folder / "scene"},
                                    {"compare", scene, "--out", folder / "compare"},
                                    {"plan", scene},
                                    {"reproduce", out, "--out", folder / "there"},
                                    {"completion", "bash"}};
  for (const Words& words : calls) {
    const Reply reply = call(joined(words, {"--json"}));
    EXPECT_EQ(reply.status, 0) << words[0] << reply.err;
    EXPECT_TRUE(nlohmann::json::accept(reply.out)) << words[0] << ": " << reply.out;
    EXPECT_EQ(std::ranges::count(reply.out, '\n'), 1) << words[0];
    EXPECT_FALSE(nlohmann::json::accept(reply.err)) << words[0] << ": " << reply.err;
  }
}

TEST_F(MannersTest, with_json_bad_input_is_still_a_line_of_text_on_stderr) {
  const std::vector<Words> wrong = {{"run", "tyo"},        {"run", "toy", "--seed", "x"}, {"compare", "none.toml"},
                                    {"plan", "none.toml"}, {"reproduce", "none"},         {"validate", "none"},
                                    {"completion", "csh"}};
  for (const Words& words : wrong)
    EXPECT_FALSE(nlohmann::json::accept(refusal(call(joined(words, {"--json"}))))) << words[0];
}

TEST_F(MannersTest, never_writes_an_escape_sequence_where_there_is_no_terminal) {
  ::setenv("TERM", "xterm-256color", 1);
  ::setenv("CLICOLOR_FORCE", "1", 1);
  const std::vector<Words> said = {{"--help"},      {"list"},        {"run", "--help"},
                                   {"run", "none"}, {"plan", scene}, {"run", scene, "--out", folder / "escape"}};
  for (const Words& words : said) {
    const ProcessResult result = run_process(joined({THINWALL_PROGRAM}, words), folder.path());
    EXPECT_NE(result.output, "");
    EXPECT_EQ(result.output.find('\x1b'), std::string::npos) << words[0] << result.output;
    EXPECT_EQ(result.output.find('\r'), std::string::npos) << words[0] << result.output;
  }
}

TEST_F(MannersTest, every_command_has_a_help_that_begins_with_examples_of_itself) {
  for (const Command& command : commands()) {
    const Reply reply = call({command.name, "--help"});
    EXPECT_EQ(reply.status, 0);
    EXPECT_TRUE(reply.out.starts_with(std::string("Examples:\n  "))) << reply.out;
    EXPECT_TRUE(holds(reply.out, std::string("thinwall ") + command.name));
    EXPECT_LT(reply.out.find(std::string("thinwall ") + command.name), reply.out.find("Usage: thinwall ")) << reply.out;
    EXPECT_EQ(reply.err, "");
  }
  for (const char* help : {"--help", "-h"}) {
    const Reply reply = call({help});
    EXPECT_EQ(reply.status, 0);
    EXPECT_LT(reply.out.find("Examples:"), reply.out.find("Usage:")) << reply.out;
  }
  EXPECT_TRUE(call({"--version"}).out.starts_with("thinwall "));
}

TEST_F(MannersTest, lists_every_unit_and_writes_nothing) {
  const Reply reply = run({"--list-cells"});
  EXPECT_EQ(reply.status, 0);
  EXPECT_TRUE(reply.out.starts_with("          10  cell 0\n          10  cell 1\n")) << reply.out;
  EXPECT_EQ(std::ranges::count(reply.out, '\n'), 20);
  EXPECT_EQ(ToyControl::computed, 0);
  const auto json = nlohmann::json::parse(run({"--list-cells", "--json", "--trials", "7"}).out);
  expect_members(json, {{"units", 20}, {"trials", 140}});
  EXPECT_EQ(json.at("cells").size(), 20u);
  EXPECT_EQ(json.at("cells").at(19), nlohmann::json({{"key", "cell 19"}, {"trials", 7}}));
  EXPECT_EQ(ToyControl::computed, 0);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(MannersTest, notices_that_its_output_is_lost) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  for (const std::string lost : {">/dev/full", ">&-"}) {
    const ProcessResult result = run_process({"sh", "-c", "'" THINWALL_PROGRAM "' list " + lost}, folder.path());
    EXPECT_EQ(result.status, 1) << lost;
    EXPECT_EQ(result.output, "failed: stdout cannot be written\n") << lost;
  }
}

// ---- What the program says, as the user calls it, to what it cannot take: one line, exit code 2, and nothing written.

struct BadInputTest : ::testing::Test {
  TemporaryFolder folder;

  /// `said`: every part that the one line must have.
  void expect_refused(const Words& words, const Words& said) const {
    const ProcessResult result = run_process(joined({THINWALL_PROGRAM}, words), folder.path());
    expect_refusal({result.status, "", result.output}, said);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    EXPECT_FALSE(std::filesystem::exists(folder / "results"));
  }
};

TEST_F(BadInputTest, experiments_and_their_files) {
  expect_refused({"run", "thin_wal", "--out", "out"}, {"'thin_wal': unknown experiment; did you mean 'thin_wall'?"});
  write_text(folder / "my.toml", "experiment = \"thinwall\"\n");
  expect_refused({"run", "my.toml", "--out", "out"},
                 {"my.toml:1: key 'experiment': 'thinwall' is not allowed; did you mean 'thin_wall'?"});
  write_text(folder / "my.toml", "radius = [0.1]\n");
  expect_refused({"run", "my.toml", "--out", "out"}, {"my.toml:1: key 'experiment': missing"});
  expect_refused({"run", "none.toml", "--out", "out"}, {"none.toml: there is no such file"});
  expect_refused({"run", std::string(300, 'x') + ".toml", "--out", "out"},
                 {".toml: cannot be read: File name too long"});
  expect_refused({"run", ".", "--out", "out"}, {".: is not a file"});
}

TEST_F(BadInputTest, folders) {
  write_text(folder / "file", "");
  expect_refused({"run", "thin_wall", "--out", "file/below"},
                 {"--out file/below: cannot be written: Not a directory; name another folder"});
  expect_refused({"run", "thin_wall", "--out", "/proc/thinwall"}, {"--out /proc/thinwall: cannot be written: "});
  expect_refused({"run", "thin_wall", "--out", ""}, {"--out: '' is not allowed"});
}

TEST_F(BadInputTest, command_lines) {
  expect_refused({}, {"a command is missing"});
  expect_refused({"rnu"}, {"'rnu': unknown command; did you mean 'run'?"});
  expect_refused({"run"}, {"an experiment's name or a TOML file is missing"});
  expect_refused({"run", "thin_wall", "--sed", "1"}, {"'--sed': unknown option; did you mean '--seed'?"});
  expect_refused({"run", "thin_wall", "more"}, {"'more': one word too many"});
  expect_refused({"run", "thin_wall", "--seed", "-1"}, {"--seed: '-1' is not allowed; a whole number from 0 to "});
  expect_refused({"run", "thin_wall", "--trials", "0"}, {"--trials: '0' is not allowed; a whole number from 1 to "});
  expect_refused({"run", "thin_wall", "--threads", "0"}, {"--threads: '0' is not allowed; a whole number from 1 to "});
  expect_refused({"run", "thin_wall", "--trials"}, {"--trials: exactly one value is needed"});
  expect_refused({"run", "thin_wall", "--json=yes"}, {"--json: takes no value"});
}

Progress at(std::int64_t done, std::int64_t all, std::int64_t resumed = 0) {
  return {.units_done = 1, .units = 2, .trials_done = done, .trials = all, .trials_resumed = resumed};
}

TEST(ProgressLine, shows_share_count_the_rate_of_what_was_computed_now_and_time_left) {
  EXPECT_EQ(progress_line(at(0, 100), 0), "[                        ]   0 %  0 trials");
  EXPECT_EQ(progress_line(at(2500000, 10000000), 2),
            "[======                  ]  25 %  2.5 M trials  1.2 M/s  6 s left");
  EXPECT_EQ(progress_line(at(100, 100), 1), "[========================] 100 %  100 trials  100/s  0 s left");
  EXPECT_EQ(progress_line(at(900, 1000, 800), 1), "[=====================   ]  90 %  900 trials  100/s  1 s left");
  EXPECT_EQ(progress_line(at(800, 1000, 800), 1), "[===================     ]  80 %  800 trials");
  EXPECT_LE(progress_line(at(123456789012, 1234567890123), 0.001).size(), 79u);
  EXPECT_EQ(progress_line({}, 0), "[========================] 100 %  0 trials");
}

// ---- The programs that speed starts: those beside ours, or of a folder that the command line names; none that a file names, and
// none on a dry run.

struct BenchmarksTest : ::testing::Test {
  TemporaryFolder folder;
  std::string config = folder / "speed.toml", out = folder / "out";

  BenchmarksTest() {
    write_program(folder / "theirs", "pairs",
                  "touch " + folder / "started" + "\ncat >\"$out\" <<'END'\n" +
                      bench_json(bench_row("raycast/aabb/front_door", 30, 0, 0, 1e-15)) + "\nEND");
  }

  static Reply call(const Words& words) { return call_program(words, {speed_experiment(), toy_experiment()}); }

  bool started() const { return std::filesystem::remove(folder / "started"); }
};

TEST_F(BenchmarksTest, are_started_only_if_the_command_line_names_their_folder) {
  const std::string rest = "experiment = \"speed\"\nprograms = [\"pairs\"]\nrounds = 1\n";
  write_text(config, rest + "benchmarks = \"" + folder / "theirs" + "\"\n");
  for (const char* more : {"--json", "--dry-run"}) {
    EXPECT_EQ(refusal(call({"run", config, "--out", out, more})),
              config + ":4: key 'benchmarks': '" + folder / "theirs" +
                  "' is not allowed; \"\"; to start the programs of that folder, say so: --benchmarks DIR\n");
    EXPECT_FALSE(started());
  }
  const Reply dry = call({"run", config, "--benchmarks", folder / "theirs", "--dry-run"});
  EXPECT_EQ(dry.status, 0) << dry.err;
  EXPECT_FALSE(started()) << "on a dry run";
  EXPECT_EQ(call({"run", config, "--benchmarks", folder / "theirs", "--out", out}).status, 0);
  EXPECT_TRUE(started());
  EXPECT_EQ(call({"reproduce", out}).status, 2);
  EXPECT_FALSE(started());
  EXPECT_EQ(call({"reproduce", out, "--benchmarks", folder / "theirs"}).status, 0);
  EXPECT_TRUE(started());
  EXPECT_TRUE(refusal(call({"run", "speed", "--benchmarks", "none"}))
                  .starts_with("--benchmarks: 'none' is not allowed; a folder that holds at least one"));
  EXPECT_EQ(call({"run", "toy", "--benchmarks", folder / "theirs"}).err,
            "--benchmarks: only speed starts other programs\n");
}

}  // namespace

}  // namespace thinwall
