/// The program as it is, with its headline experiment in small: the same bytes for any thread count, and after any end; and every
/// command of the README, run as it stands there.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <random>
#include <regex>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/manifest.hpp>

#include "support/program.hpp"
#include "support/thorough.hpp"
#include "support/toy.hpp"

namespace thinwall {

namespace {

// ---- The whole way of a run, from the command line to the files, with an experiment made for it.

using ToyRunTest = ToyProgram;

TEST_F(ToyRunTest, leaves_a_whole_result_folder) {
  const Reply reply = run({"--threads", "2", "--seed", "3"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(reply.out, "cells: 20\n\nThe squares & <their> sum.\n\nreport: " + out + "/report.html\n");
  const auto files = files_in(out);
  for (const char* name :
       {"cite.bib", "data/cells.csv", "data/timings.csv", "datapackage.json", "manifest.json", "plots/squares.dat",
        "plots/squares.gp", "report.html", "resolved.toml", "tables/cells.md", "tables/cells.tex"})
    EXPECT_TRUE(files.contains(name)) << name;
  for (const auto& [name, text] : files) EXPECT_TRUE(name.find("journal") == name.npos && name[0] != '.') << name;
  EXPECT_TRUE(holds(files.at("report.html"), "The squares &amp; &lt;their&gt; sum."));
  EXPECT_TRUE(holds(files.at("report.html"), "<p>First.</p>\n<p>Second.</p>"));
  EXPECT_TRUE(files.at("data/cells.csv").starts_with("cell,square,name,root,even\n0,3,\"a, \"\"b\"\"\",,true\n1,4,"));
}

TEST_F(ToyRunTest, hashes_every_file_but_timings_their_figures_report_and_manifest) {
  ASSERT_EQ(run().status, 0);
  auto files = files_in(out);
  for (const char* name :
       {"data/timings.csv", "plots/cost.gp", "plots/cost.dat", "plots/cost.json", "report.html", "manifest.json"}) {
    EXPECT_EQ(files.erase(name), 1u);
  }
  files.erase("plots/cost.svg");  // there only if gnuplot is
  std::map<std::string, std::string> hashes;
  for (const auto& [name, text] : files) hashes[name] = sha256(text);
  EXPECT_EQ(manifest().at("files").get<decltype(hashes)>(), hashes);
}

TEST_F(ToyRunTest, says_in_its_manifest_where_it_came_from) {
  ASSERT_EQ(run({"--seed", "9007199254740993", "--trials", "7", "--threads", "1"}).status, 0);
  const auto json = manifest();
  expect_members(json, {{"experiment", "toy"},
                        {"seed", 9007199254740993u},
                        {"trials", 7},
                        {"total_trials", 140},
                        {"threads", 1},
                        {"reproduce", "thinwall run toy --seed 9007199254740993 --trials 7 --out again"}});
  EXPECT_EQ(json.at("config").at("speed"), nlohmann::json::parse("[1,10]"));
  EXPECT_EQ(json.at("argv").at(0), "thinwall");
  for (const char* key : {"version", "commit", "dirty", "compiler", "flags", "build_type", "sha256", "libraries"}) {
    EXPECT_TRUE(json.at("program").contains(key)) << key;
  }
  EXPECT_FALSE(json.at("machine").at("cpu").get<std::string>().empty());
  EXPECT_LE(json.at("started").get<std::string>(), json.at("finished").get<std::string>());
  EXPECT_EQ(json.at("started").get<std::string>().size(), std::string("2026-11-21T12:34:56Z").size());
}

TEST_F(ToyRunTest, reports_a_failed_self_test) {
  ToyControl::pass = false;
  expect_reply(run(), 1, {"the self-test failed"});
  EXPECT_TRUE(holds(read_text(out + "/report.html"), "The self-test failed"));
  EXPECT_EQ(run().status, 1) << "and still does when asked again";
  EXPECT_EQ(call({"report", out, "--check"}).out, out + ": whole, but its self-test failed: do not cite its numbers\n");
  EXPECT_EQ(nlohmann::json::parse(call({"report", out, "--check", "--json"}).out).at("self_test_passed"), false);
  expect_reply(call({"cite", out}), 0, {"its self-test failed: do not cite its numbers\n"});
}

TEST_F(ToyRunTest, draws_no_figure_where_gnuplot_is_absent_or_is_killed_and_says_which) {
  const std::string path = std::getenv("PATH");
  const auto expect_undrawn = [&](const std::string& why) {
    ::setenv("PATH", folder.path().c_str(), 1);
    const Reply reply = run();
    ::setenv("PATH", path.c_str(), 1);
    expect_reply(reply, 0, {"figures were not drawn: " + why + "\n"});
  };
  expect_undrawn("gnuplot is not installed");
  EXPECT_TRUE(holds(read_text(out + "/report.html"), "gnuplot is not installed"));
  EXPECT_TRUE(std::filesystem::exists(out + "/plots/squares.gp"));
  write_script(folder / "gnuplot", "kill -9 $$");
  out = folder / "killed";
  expect_undrawn("gnuplot was ended by a signal");
}

TEST_F(ToyRunTest, does_not_say_that_a_folder_deleted_meanwhile_keeps_anything) {
  ToyControl::removes = out;
  const Reply reply = run({"--threads", "1"});
  EXPECT_EQ(reply.status, 1);
  EXPECT_TRUE(reply.err.ends_with("/out: was removed, or moved away, while the run was at work\n")) << reply.err;
}

TEST_F(ToyRunTest, writes_nothing_on_a_dry_run) {
  const Reply reply = run({"--dry-run", "--threads", "1"});
  EXPECT_EQ(reply.status, 0);
  EXPECT_TRUE(reply.out.starts_with("toy: 20 units, 200 trials on 1 thread\nabout ")) << reply.out;
  EXPECT_TRUE(holds(reply.out, " s on an idle machine (16 units tried with "));
  EXPECT_EQ(ToyControl::computed, 0);
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto json = nlohmann::json::parse(run({"--dry-run", "--json"}).out);
  EXPECT_EQ(json.at("trials"), 200);
  EXPECT_GE(json.at("estimated_seconds"), 0);
  EXPECT_EQ(json.at("units_left_out_of_estimate"), 0);
}

TEST_F(ToyRunTest, replies_in_json) {
  expect_members(nlohmann::json::parse(run({"--json"}).out), {{"experiment", "toy"},
                                                              {"out", out},
                                                              {"units", 20},
                                                              {"trials", 200},
                                                              {"answer", "The squares & <their> sum."},
                                                              {"self_test_passed", true},
                                                              {"report", out + "/report.html"}});
  EXPECT_EQ(nlohmann::json::parse(call({"list", "--json"}).out).at(0).at("name"), "toy");
}

// ---- Killed at any moment, from before its first unit until the last file has its place, a run goes on by the same command
// and ends with the same bytes.

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct RealRunTest : ::testing::Test {
  TemporaryFolder folder;

  RealRunTest() { write_text(folder / "my.toml", small_wall); }

  Words words(const std::string& out, const std::string& threads = "2") const {
    return {THINWALL_PROGRAM, "run", folder / "my.toml", "--out", folder / out, "--threads", threads, "--seed", "11"};
  }

  std::string notes() const { return read_text(folder / "notes"); }

  std::uintmax_t journal_size(const std::string& out) const {
    std::error_code none;
    const auto size = fs::file_size(folder / out + "/journal.tsv", none);
    return none ? 0 : size;
  }

  /// True while a file of the result waits for its place.
  bool is_staged(const std::string& out, const std::string& name) const {
    std::error_code none;
    for (fs::directory_iterator entry(folder / out, none), end; !none && entry != end; entry.increment(none)) {
      if (is_temporary_name(entry->path().filename().string()) && fs::exists(entry->path() / name, none)) return true;
    }
    return false;
  }

  void run_to_the_end(const std::string& out) const {
    ASSERT_EQ(ProgramProcess(words(out), folder / "notes").wait(), 0) << notes();
  }
};
using KilledRunTest = RealRunTest;

TEST_F(RealRunTest, gives_the_same_bytes_for_1_2_and_3_threads) {
  const std::string trials = testing::slow_build ? "600" : "6000";  // a cell is more than one unit
  for (const char* threads : {"1", "2", "3"}) {
    const ProcessResult result = run_process(joined(words(threads, threads), {"--trials", trials}), folder.path());
    ASSERT_EQ(result.status, 0) << result.output;
  }
  EXPECT_EQ(lasting_files(folder / "1"), lasting_files(folder / "2"));
  EXPECT_EQ(lasting_files(folder / "1"), lasting_files(folder / "3"));
  EXPECT_TRUE(
      read_text(folder / "1/data/cells.csv").starts_with("method,scalar,speed,step,radius,thickness,angle_deg,"));
}

TEST_F(KilledRunTest, ends_with_the_same_bytes_after_twenty_kills) {
  const int kills = static_cast<int>(testing::thorough(testing::slow_build ? 5 : 20));
  constexpr int moments = 4;
  std::uintmax_t largest_journal = 0;
  const auto start = Clock::now();
  {
    ProgramProcess whole(words("whole"), folder / "notes");
    while (whole.running()) {
      largest_journal = std::max(largest_journal, journal_size("whole"));
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    ASSERT_EQ(whole.wait(), 0) << notes();
  }
  const auto whole_time = Clock::now() - start;
  const auto expected = lasting_files(folder / "whole");
  ASSERT_GT(largest_journal, 0u);
  std::vector<std::string> names;
  for (const auto& [name, text] : files_in(folder / "whole")) names.push_back(name);

  std::mt19937_64 random(20261122);
  const auto below = [&](auto count) {
    return static_cast<decltype(count)>(random() % static_cast<std::uint64_t>(count));
  };
  std::array<int, moments> killed{};
  int done = 0, folders = 0;
  std::string out = "0";
  for (int attempt = 0; done < kills; ++attempt) {
    ASSERT_LT(attempt, 20 * kills) << "too few runs live long enough to be killed";
    const int kind = below(moments);
    const auto when = Clock::now() + below(whole_time.count()) * Clock::duration(1);
    const auto size = below(largest_journal);
    const std::string name = names[below(names.size())];
    const auto moment = [&] {
      switch (kind) {
        case 0: return Clock::now() >= when;
        case 1: return journal_size(out) > size;
        case 2: return is_staged(out, name);
        default: return fs::exists(folder / out + "/" + name);
      }
    };
    ProgramProcess run(words(out), folder / "notes");
    const bool reached = run.wait_until(moment, std::chrono::microseconds(kind < 2 ? 100 : 0));
    const int status = reached ? run.end_with(SIGKILL) : run.wait();
    if (status < 0) {
      ++done;
      ++killed[static_cast<std::size_t>(kind)];
      const bool complete = fs::exists(folder / out + "/manifest.json");
      for (const auto& [file, text] : expected) {  // whatever has its own name is whole; with a manifest, all is there
        const fs::path there = folder / out + "/" + file;
        ASSERT_TRUE(!complete || fs::exists(there)) << file;
        if (file == "cite.bib" || !fs::exists(there)) continue;
        ASSERT_EQ(read_text(there), text) << file;
      }
      if (kind < 2) continue;
      run_to_the_end(out);
    } else {
      ASSERT_EQ(status, 0) << notes();
    }
    ASSERT_EQ(lasting_files(folder / out), expected);
    out = std::to_string(++folders);
  }
  run_to_the_end(out);
  EXPECT_EQ(lasting_files(folder / out), expected);
  std::printf(
      "killed %d times by the clock, %d in the units, %d before and %d after files had their place; %d folders\n",
      killed[0], killed[1], killed[2], killed[3], folders + 1);
  EXPECT_GT(*std::ranges::min_element(killed), 0);
}

TEST_F(KilledRunTest, clears_up_after_a_kill_between_the_manifest_and_the_end) {
  run_to_the_end("out");
  const auto expected = lasting_files(folder / "out");
  const Manifest left = parse_manifest(read_text(folder / "out/manifest.json"), "manifest.json");
  Journal(folder / "out/journal.tsv", identity_text(left.run));
  fs::create_directories(folder / "out/" + temporary_name() + "/data");
  run_to_the_end("out");
  EXPECT_TRUE(holds(notes(), "complete already"));
  EXPECT_EQ(lasting_files(folder / "out"), expected);
}

TEST_F(KilledRunTest, forgets_no_file_of_a_result_that_it_was_replacing) {
  run_to_the_end("out");
  const auto expected = lasting_files(folder / "out");
  std::string manifest = read_text(folder / "out/manifest.json");
  manifest.insert(manifest.find("\"files\": {") + 10, "\"data/gone.csv\": \"" + sha256("old\n") + "\", ");
  fs::remove(folder / "out/manifest.json");  // killed after its first moves, replacing a result with one file more
  write_text(folder / "out/manifest.old.json", manifest);
  write_text(folder / "out/data/gone.csv", "old\n");
  run_to_the_end("out");
  EXPECT_TRUE(holds(notes(), "an earlier result was being replaced here"));
  EXPECT_EQ(lasting_files(folder / "out"), expected);
}

TEST_F(KilledRunTest, heeds_an_interrupt_at_once_in_the_midst_of_a_long_unit) {
  write_text(
      folder / "my.toml",
      "experiment = \"thin_wall\"\nshots = 4194304\nspeed = [10]\nstep = [0.016666666666666666]\nradius = [0.02]\n"
      "thickness = [0.01]\nangle_deg = [0]\nwall = [\"infinite\"]\nmethod = [\"inclusion\"]\nscalar = [\"double\"]\n");
  ProgramProcess run(words("long"), folder / "notes");
  ASSERT_TRUE(
      run.wait_until([&] { return notes().find("units, ") != std::string::npos; }, std::chrono::milliseconds(5)))
      << notes();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the units are under way
  const int status = run.end_with(SIGINT);
  const std::string journal = read_text(folder / "long/journal.tsv");
  EXPECT_LE(std::ranges::count(journal, '\n'), 2) << "the long unit was waited for";  // the other has 1009 shots
  EXPECT_EQ(status, 130);
  EXPECT_TRUE(holds(notes(), "to continue:\n"));
}

TEST_F(KilledRunTest, leaves_no_half_of_a_result_where_it_is_stopped_while_it_draws) {
  run_to_the_end("whole");
  write_script(folder / "bin/gnuplot", "sleep 3");
  const std::string path = "PATH=" + (folder / "bin") + ":" + std::getenv("PATH");
  ProgramProcess slow(joined({"/usr/bin/env", path}, words("slow")), folder / "notes");
  ASSERT_TRUE(slow.wait_until([&] { return is_staged("slow", "plots"); }, std::chrono::milliseconds(1))) << notes();
  EXPECT_EQ(slow.end_with(SIGTERM), 130);
  EXPECT_FALSE(fs::exists(folder / "slow/manifest.json"));
  EXPECT_TRUE(fs::exists(folder / "slow/journal.tsv"));
  run_to_the_end("slow");
  EXPECT_EQ(lasting_files(folder / "slow"), lasting_files(folder / "whole"));
}

TEST_F(KilledRunTest, goes_on_where_whoever_started_it_ignores_interrupts) {
  const Words ignoring = {"/bin/sh", "-c", "trap '' INT; exec \"$@\"", "sh"};
  ProgramProcess run(joined(ignoring, words("out")), folder / "notes");
  ASSERT_TRUE(run.wait_until([&] { return journal_size("out") > 0; }, std::chrono::microseconds(200))) << notes();
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 0) << notes();
}

TEST_F(RealRunTest, names_the_file_that_may_not_grow) {
  const ProcessResult end =
      run_process({"sh", "-c", "ulimit -f 4; '" THINWALL_PROGRAM "' run my.toml --out out; echo $?"}, folder.path());
  EXPECT_TRUE(holds(end.output, "failed: out/journal.tsv: File too large; what was finished is kept")) << end.output;
  EXPECT_TRUE(end.output.ends_with("\n1\n")) << end.output;
}

// ---- A disk that is full, and a folder that cannot be written: named, nothing lost, and the same command goes on.
// The disk is a small tmpfs in a mount namespace of its own, which ends with the shell that made it.

struct FullDiskTest : RealRunTest {
  FullDiskTest() { fs::create_directory(folder / "disk"); }

  ProcessResult in_namespace(const std::string& script) const {
    const char* const how = ::geteuid() == 0 ? "-m" : "-rm";
    return run_process({"unshare", how, "sh", "-c", script}, folder.path());
  }

  /// Why there can be no disk; empty if there can.
  std::string trouble() const {
    const ProcessResult probe = in_namespace("mount -t tmpfs -o size=64k none disk");
    return probe.status == 0 ? "" : "a tmpfs cannot be mounted here: " + probe.output;
  }

  /// Runs into a disk with those `limits` until it ends, twice; then writes nothing to it, then makes room and runs again.
  /// Leaves what each said in 1, 2, read_only and 3, and the result in `result`.
  std::string fill(const std::string& limits) const {
    const std::string run =
        std::string("'") + THINWALL_PROGRAM + "' run my.toml --out disk/out --threads 2 --seed 11 >/dev/null 2>";
    const ProcessResult end = in_namespace("mount -t tmpfs -o " + limits + " none disk\n" +         //
                                           run + "1; echo $? >status\n" +                           //
                                           "cp disk/out/journal.tsv kept\n" +                       //
                                           run + "2; echo $? >>status\n" +                          //
                                           "mount -o remount,ro disk\n" +                           //
                                           run + "read_only; echo $? >>status\n" +                  //
                                           "mount -o remount,rw,size=64m,nr_inodes=10000 disk\n" +  //
                                           run + "3; echo $? >>status\n" +                          //
                                           "cp -r disk/out result\n");
    EXPECT_EQ(end.status, 0) << end.output;
    return read_text(folder / "status");
  }

  std::string last_line(const std::string& file) const {
    const std::string text = read_text(folder / file);
    return text.substr(text.rfind('\n', text.size() - 2) + 1);
  }

  void expect_survival(const std::string& limits, const std::string& where) {
    SCOPED_TRACE(limits);
    EXPECT_EQ(fill(limits), "1\n1\n2\n0\n") << read_text(folder / "1") << read_text(folder / "2");
    EXPECT_TRUE(last_line("1").starts_with("failed: disk/out/" + where)) << last_line("1");
    EXPECT_TRUE(holds(last_line("1"), ": No space left on device; what was finished is kept"));
    EXPECT_TRUE(holds(last_line("2"), ": No space left on device"));
    EXPECT_EQ(read_text(folder / "read_only"),
              "--out disk/out: cannot be written: Read-only file system; name another folder\n");
    const std::string journal = read_text(folder / "kept");
    const bool publishing = journal.find("\n\t") != journal.npos;          // a row without a key
    const auto rows = std::ranges::count(journal, '\n') - 1 - publishing;  // a torn one has no end
    EXPECT_GT(rows, 0);
    EXPECT_GE(units_read(read_text(folder / "3")), rows);
    EXPECT_EQ(lasting_files(folder / "result"), expected_);
    fs::remove_all(folder / "result");
  }

  std::map<std::string, std::string> expected_;
};

TEST_F(FullDiskTest, is_named_and_loses_nothing_wherever_it_fills) {
  if (const std::string why = trouble(); !why.empty()) GTEST_SKIP() << why;
  run_to_the_end("whole");
  expected_ = lasting_files(folder / "whole");
  expect_survival("size=16k", "journal.tsv");
  expect_survival("size=300k", ".thinwall-");
  const auto entries =
      std::distance(fs::recursive_directory_iterator(folder / "whole"), fs::recursive_directory_iterator());
  // Room for the root, the result folder, the journal, the folder for staging and all it holds; none for a folder beside it.
  expect_survival("nr_inodes=" + std::to_string(4 + entries), "data");
}

TEST_F(FullDiskTest, is_no_bad_input_when_there_is_no_room_for_the_first_row) {
  if (const std::string why = trouble(); !why.empty()) GTEST_SKIP() << why;
  const ProcessResult end = in_namespace(
      "mount -t tmpfs -o nr_inodes=2 none disk\n"
      "'" THINWALL_PROGRAM "' run my.toml --out disk/out; echo $?; ls -A disk/out");
  EXPECT_EQ(end.output, "failed: --out disk/out: cannot be written: No space left on device\n1\n");
}

// ---- The commands of a document and what they print, as a reader would type and see them.
//
//     ```console
//     $ build/release/thinwall list
//     thin_wall  How often ...
//     ```
//
// A line of output that is `...` stands for any lines, and `...` within a line for any text. A fenced TOML block whose first line
// is `# NAME.toml` is a file that the commands find.

struct ConsoleCommand {
  std::string line, output;  ///< without the prompt; what the document shows of what it prints
};

struct Document {
  std::vector<ConsoleCommand> commands;
  std::map<std::string, std::string> files;  ///< text by name
};

Document read_document(const std::string& markdown) {
  Document out;
  std::string fence, file;
  std::istringstream in(markdown);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      fence = fence.empty() ? line.substr(3) : "";
      file.clear();
    } else if (fence == "console") {
      if (line.starts_with("$ ")) {
        out.commands.push_back({line.substr(2), {}});
      } else if (!out.commands.empty()) {
        out.commands.back().output += line + "\n";
      }
    } else if (fence == "toml") {
      if (file.empty() && line.starts_with("# ") && line.ends_with(".toml")) file = line.substr(2);
      if (!file.empty()) out.files[file] += line + "\n";
    }
  }
  return out;
}

/// True if `printed` is what a document shows as `shown`.
bool is_shown(const std::string& shown, const std::string& printed) {
  const auto with = [](const std::string& text, const char* from, const char* to) {
    return std::regex_replace(text, std::regex(from, std::regex::multiline), to);
  };
  const std::string literal = with(shown, R"([.*+?^$|()\[\]{}\\])", "\\$&");
  const std::string pattern = with(with(literal, R"(^\\\.\\\.\\\.\n)", "(.*\n)*"), R"(\\\.\\\.\\\.)", ".*");
  return std::regex_match(printed, std::regex(pattern));
}

TEST(Console, finds_commands_output_and_files) {
  const Document document =
      read_document("text\n```console\n$ a b\nx\n...\n$ c\n```\n```toml\n# my.toml\nk = 1\n```\n");
  ASSERT_EQ(document.commands.size(), 2u);
  EXPECT_EQ(document.commands[0].line, "a b");
  EXPECT_EQ(document.commands[0].output, "x\n...\n");
  EXPECT_TRUE(document.commands[1].output.empty());
  EXPECT_EQ(document.files.at("my.toml"), "# my.toml\nk = 1\n");
}

TEST(Console, three_points_stand_for_any_text) {
  EXPECT_TRUE(is_shown("a ... c\n", "a b c\n"));
  EXPECT_TRUE(is_shown("a...\n", "a\n"));
  EXPECT_FALSE(is_shown("a ... c\n", "a b d\n"));
  EXPECT_FALSE(is_shown("a ... c\n", "a\nb c\n"));
  EXPECT_FALSE(is_shown("a\n", "a b\n"));
  EXPECT_FALSE(is_shown("[a-z]+ (.)\n", "a b\n"));
  EXPECT_TRUE(is_shown("x\n...\nz\n", "x\ny\ny\nz\n"));
  EXPECT_TRUE(is_shown("...\nz\n", "z\n"));
  EXPECT_FALSE(is_shown("x\n...\nz\n", "x\ny\n"));
  EXPECT_FALSE(is_shown("x\n", "x\ny\n"));
}

TEST(Readme, every_command_prints_what_is_shown) {
  if (testing::slow_build)
    GTEST_SKIP() << "the commands take minutes under the sanitizers; the release build runs them";
  const std::filesystem::path root = THINWALL_SOURCE;
  const Document readme = read_document(read_text(root / "README.md"));
  ASSERT_GE(readme.commands.size(), 10u);
  TemporaryFolder folder;  // as a fresh clone looks to the commands, after the build
  for (const char* name : {"experiments", "docs"})
    std::filesystem::create_directory_symlink(root / name, folder / name);
  std::filesystem::create_directories(folder / "build/release");
  std::filesystem::create_symlink(THINWALL_PROGRAM, folder / "build/release/thinwall");
  for (const auto& [name, text] : readme.files) write_text(folder / name, text);

  for (const auto& [line, output] : readme.commands) {
    SCOPED_TRACE(line);
    if (line.starts_with("./") || line.starts_with("git ")) {
      std::cout << "not run here but by ./check itself, or before it: " << line << "\n";
      continue;
    }
    const ProcessResult result = run_process({"sh", "-c", line + " 2>/dev/null"}, folder.path());
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(output.empty() || is_shown(output, result.output)) << "the README shows\n"
                                                                   << output << "but it prints\n"
                                                                   << result.output;
  }
}

}  // namespace

}  // namespace thinwall
