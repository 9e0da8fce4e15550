/// `thinwall report`: what a result says, what is wrong with its folder, and its figures for print.

#include <gtest/gtest.h>

#include <algorithm>

#include <thinwall/experiments/check/check.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/table_text.hpp>

#include "support/toy.hpp"

namespace thinwall {
namespace {

struct ReportTest : ToyProgram {
  void SetUp() override {
    if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed: a folder without its figures is not whole";
    ASSERT_EQ(run({"--seed", "3"}).status, 0);
  }

  /// Changes a file of the result from `from` to `to`, and the manifest's hash with it if `rehash`.
  void change(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = read_text(out + "/" + file);
    const auto at = text.find(from);
    ASSERT_NE(at, text.npos) << file << " does not hold " << from;
    write_text(out + "/" + file, text.replace(at, from.size(), to));
  }

  void expect_fault(const std::string& fault) const {
    std::string all;
    for (const std::string& line : check_result(out)) all += line + "\n";
    EXPECT_TRUE(holds(all, fault));
  }

  struct Change {
    std::string from, to, fault;
  };
  /// Each change to `file` has its fault; it is then taken back.
  void expect_faults(const std::string& file, const std::vector<Change>& changes) const {
    const std::string good = read_text(out + "/" + file);
    for (const Change& c : changes) {
      change(file, c.from, c.to);
      expect_fault(c.fault);
      write_text(out + "/" + file, good);
    }
  }
};

TEST_F(ReportTest, prints_question_answer_and_summary) {
  const Reply reply = call({"report", out});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(reply.out,
            "What is a square?\n\nThe squares & <their> sum.\n\ncells: 20\n\nreport: " + out + "/report.html\n");
  const auto json = nlohmann::json::parse(call({"report", out, "--json"}).out);
  EXPECT_EQ(json.at("question"), "What is a square?");
  EXPECT_EQ(json.at("run_id"), manifest().at("run_id"));
  EXPECT_EQ(json.at("drawn"), nlohmann::json::array());
}

TEST_F(ReportTest, breaks_a_long_answer_between_words) {
  const std::string words = "squares squares squares squares ";
  change("manifest.json", "The squares", words + words + words + words);
  EXPECT_TRUE(holds(call({"report", out}).out, words + words + words.substr(0, 31) + "\nsquares"));
}

TEST_F(ReportTest, counts_a_single_thread_as_one) {
  for (const std::string count : {"1 thread", "2 threads"}) {
    ASSERT_EQ(call({"run", "toy", "--threads", count.substr(0, 1), "--out", out + count}).status, 0);
    EXPECT_TRUE(holds(read_text(out + count + "/report.html"), ", " + count + "</dd>"));
  }
}

TEST_F(ReportTest, finds_a_fresh_folder_whole) {
  const Reply reply = call({"report", out, "--check"});
  EXPECT_EQ(reply.status, 0);
  EXPECT_EQ(reply.out, out + ": whole: no fault was found\n");
  EXPECT_EQ(nlohmann::json::parse(call({"report", out, "--check", "--json"}).out).at("whole"), true);
}

TEST_F(ReportTest, names_every_fault_and_exits_with_1) {
  std::filesystem::remove(out + "/data/cells.csv");
  write_text(out + "/data/mine.csv", "a\n");
  expect_reply(
      call({"report", out, "--check"}), 1,
      {"data/cells.csv: missing; datapackage.json describes it\n", "data/cells.csv: missing; the manifest names it\n",
       "report.html: links to 'data/cells.csv', which is not there\n", "data/mine.csv: the manifest does not name it\n",
       out + ": 4 faults\n"});
  EXPECT_EQ(nlohmann::json::parse(call({"report", out, "--check", "--json"}).out).at("faults").size(), 4u);
}

TEST_F(ReportTest, sees_what_became_of_the_manifest) {
  write_text(out + "/journal.tsv", "");
  expect_fault("journal.tsv: a run is at work here, or was interrupted");
  std::filesystem::remove(out + "/data/timings.csv");
  expect_fault("data/timings.csv: missing; the manifest names it");
  write_text(out + "/manifest.json", "{}");
  expect_fault("manifest.json: key 'thinwall_manifest': missing");
  std::filesystem::remove(out + "/manifest.json");
  const std::string said = "holds a run that is not finished; the run's own command continues it\n";
  EXPECT_EQ(refusal(call({"report", out})), out + ": " + said);
  expect_reply(call({"report", out, "--check"}), 1,
               {"manifest.json: missing; the folder " + said + out + ": 1 fault\n"});
  std::filesystem::remove(out + "/journal.tsv");
  expect_fault("manifest.json: missing; without one a folder is not complete");
}

TEST_F(ReportTest, sees_a_manifest_that_was_edited) {
  expect_faults("manifest.json",
                {{"\"seed\": 3", "\"seed\": 4", "manifest.json: run_id is '"},
                 {"\"trials\": null", "\"trials\": 7", "manifest.json: run_id is '"},
                 {"\"cells\": 20", "\"cells\": 21", "manifest.json: run_id is '"},
                 {"\"cells\": 20", "\"cells\": 21", "resolved.toml: is not the configuration"},
                 {"run toy --seed", "run toy  --seed", "resolved.toml: does not give the manifest's line"},
                 {"\"self_test_passed\": true", "\"self_test_passed\": false",
                  "report.html: does not give the manifest's verdict"}});
}

TEST_F(ReportTest, recomputes_a_run_id_however_json_spells_the_numbers) {
  write_text(folder / "small.toml", "experiment = \"toy\"\nspeed = [0.0001, 1e20]\n");  // 1e-04 where numbers are short
  ASSERT_EQ(call({"run", folder / "small.toml", "--out", out + "2"}).status, 0);
  EXPECT_EQ(check_result(out + "2"), std::vector<std::string>{});
}

TEST_F(ReportTest, sees_what_is_no_file_of_the_result) {
  const auto expect_stray = [&](const std::string& name, const std::string& fault) {
    expect_fault(name + ": " + fault);
    std::filesystem::remove(out + "/" + name);
  };
  std::filesystem::create_directory(out + "/empty");
  expect_stray("empty", "an empty folder that the manifest does not name");
  std::filesystem::create_symlink("manifest.json", out + "/link");
  expect_stray("link", "a link that the manifest does not name");
  std::filesystem::create_directory_symlink("data", out + "/linked");
  expect_stray("linked", "a link that the manifest does not name");
  for (const char* journal : {"journal.old.tsv", "journal.rank-12.tsv"}) {
    write_text(out + "/" + journal, "");
    expect_stray(journal, "a run is at work here");
  }
  for (const char* mine : {"journal.txt", "journal.rank-.tsv", "journal.rank-x.tsv"}) {
    write_text(out + "/" + mine, "");
    expect_stray(mine, "the manifest does not name it");
  }
  EXPECT_EQ(check_result(out), std::vector<std::string>{});
}

TEST_F(ReportTest, names_a_folder_that_stands_where_a_file_should) {
  for (const char* file : {"data/cells.csv", "data/timings.csv", "datapackage.json", "resolved.toml", "cite.bib",
                           "plots/squares.svg", "plots/squares.gp", "report.html", "manifest.json"}) {
    std::filesystem::remove(out + "/" + file);
    std::filesystem::create_directory(out + "/" + file);
    expect_fault(file + std::string(": is not a file"));
  }
  for (const char* command : {"report", "cite"})
    EXPECT_EQ(refusal(call({command, out})), out + ": its manifest.json is not a file\n");
}

TEST_F(ReportTest, says_of_a_shard_that_it_is_one) {
  const std::string shard = folder / "shard";
  ASSERT_EQ(call({"run", "toy", "--shard", "1/3", "--out", shard}).status, 0);
  const std::string said = "is shard 1/3 of a run; thinwall merge makes a result of all of them\n";
  for (const char* command : {"report", "cite"}) EXPECT_EQ(refusal(call({command, shard})), shard + ": " + said);
  const Reply reply = call({"report", shard, "--check"});
  EXPECT_EQ(reply.status, 1);
  EXPECT_EQ(reply.out, "manifest.json: missing; the folder " + said + shard + ": 1 fault\n");
}

TEST_F(ReportTest, prints_a_folders_name_on_one_line_that_drives_no_terminal) {
  const std::string awkward = folder / "a\x1b[31m\nb", shown = folder / "a\\x1b[31m\\x0ab";
  std::filesystem::rename(out, awkward);
  EXPECT_TRUE(call({"report", awkward}).out.ends_with("report: " + shown + "/report.html\n"));
  EXPECT_EQ(call({"report", awkward, "--check"}).out, shown + ": whole: no fault was found\n");
  const Reply drawn = call({"report", awkward, "--figures", "pdf"});
  EXPECT_TRUE(holds(drawn.out, "drawn: " + shown + "/plots/cost.pdf\n")) << drawn.out << drawn.err;
}

TEST_F(ReportTest, holds_each_table_against_its_description) {
  expect_faults("data/cells.csv",
                {{"cell,square", "square,cell", "data/cells.csv:1: its columns are not those of datapackage.json"},
                 {"\n1,4,", "\n1.5,4,", "data/cells.csv:3: column 'cell': '1.5' is no integer"},
                 {"0.3333333333333333,false", "nan,false", "data/cells.csv:3: column 'root': 'nan' is no number"},
                 {"0.3333333333333333,false", "0.3,no", "data/cells.csv:3: column 'even': 'no' is no boolean"},
                 {"\n1,4,", "\n4,", "data/cells.csv:3: 4 fields, not 5"},
                 {"\n1,4,\"a", "\n1,4,\"a\"x\"", "data/cells.csv:3: text behind a closing quote"},
                 {"\n1,4,", "\n1,5,", "data/cells.csv: its SHA-256 is not that of datapackage.json"},
                 {"\n1,4,", "\n1,5,", "data/cells.csv: was changed since the run wrote it"}});
}

TEST_F(ReportTest, holds_the_datapackage_against_its_rules) {
  expect_faults(
      "datapackage.json",
      {{"tabular-data-package", "package", "datapackage.json: the package: 'profile' is 'package'"},
       {"thinwall-toy", "Thinwall toy", "datapackage.json: the package: the name 'Thinwall toy' has a letter beyond"},
       {"\"integer\"", "\"whole\"", "datapackage.json: resource 'cells', field 'cell': the type 'whole' is unknown"},
       {"\"unit\": \"m^2\"", "\"unit\": \"\"", "datapackage.json: resource 'cells', field 'square': 'unit' is missing"},
       {"\"name\": \"square\"", "\"name\": \"cell\"", "datapackage.json: resource 'cells', field 'cell': a second one"},
       {"data/cells.csv", "../cells.csv",
        "datapackage.json: resource 'cells': the path '../cells.csv' leaves the folder"},
       {"{", "", "datapackage.json: not JSON, or no object"}});
}

TEST_F(ReportTest, wants_a_page_that_stands_alone_and_is_complete) {
  const std::string good = read_text(out + "/report.html");
  expect_faults(
      "report.html",
      {{"<main>", "<main><script>1</script>", "report.html: '<script' in a page that stands alone"},
       {"<main>", "<main><img src=\"https://a.org/x.png\">", "report.html: asks for 'https://a.org/x.png'"},
       {"<main>", "<main><a href='//a.org'>x</a>", "report.html: asks for '//a.org'"},
       {"</style>", "p { background: url(http://a.org) }</style>", "report.html: 'url(http:/...'"},
       {"<h2>Limits</h2>", "<h2>No</h2>", "report.html: has no section 'Limits'"},
       {"The squares &amp; &lt;their", "The circles &amp; &lt;their",
        "report.html: does not give the manifest's answer"},
       {"</html>", "", "report.html: not a whole page"},
       {"<main>", "<main><a href=http://a.org>x</a>", "report.html: asks for 'http://a.org'"},
       {"<main>", "<main><a HREF = \"http://a.org\">x</a>", "report.html: asks for 'http://a.org'"},
       {"<main>", "<main><a href=\"/etc\">x</a>", "report.html: asks for '/etc'"},
       {"<main>", "<main><a href=\"data/none.csv\">x</a>", "report.html: links to 'data/none.csv', which is not there"},
       {"<main>", "<main><img src=//a.org/x>", "report.html: asks for '//a.org/x'"},
       {"<main>", "<main><Video poster='//a.org/x'>", "report.html: '<video' in a page"},
       {"<main>", "<main><Video poster='//a.org/x'>", "report.html: asks for '//a.org/x'"},
       {"<head>", "<head><meta http-equiv=refresh content=1>", "report.html: attribute 'http-equiv' in a page"},
       {"<body>", "<body OnLoad=a()>", "report.html: attribute 'onload' in a page"},
       {"<body>", "<body class=\"x\"onload = a()>", "report.html: attribute 'onload' in a page"},
       {"<main>", "<main><svg/onload=a()>", "report.html: attribute 'onload' in a page"},
       {"<main>", "<main><p title='>' onclick=a()>", "report.html: attribute 'onclick' in a page"},
       {"</style>", "@Import 'a.css';</style>", "report.html: '@import' in a page"},
       {"The self-test passed.", "", "report.html: does not give the manifest's verdict"},
       {"<td class=\"n\">6.333</td>", "<td class=\"n\">6.334</td>", "report.html: does not show the rows"},
       {"Squares, and the seed.", "Cubes.", "report.html: does not show the rows and the caption of tables/cells.md"}});
  for (const char* figure : {"squares", "cost"}) {
    const auto first = figure == std::string("squares") ? good.find("<svg") : good.rfind("<svg");
    std::string cut = good;
    write_text(out + "/report.html", cut.erase(first, good.find("</svg>", first) - first));
    expect_fault(std::string("report.html: does not show plots/") + figure + ".svg");
    write_text(out + "/report.html", good);
  }
  std::filesystem::remove(out + "/report.html");
  expect_fault("report.html: missing or empty");
}

TEST_F(ReportTest, wants_figures_with_words_and_texts_that_can_be_read) {
  expect_faults("plots/squares.svg", {{"x [m]", "x [m]]]>", "plots/squares.svg: not well-formed: line "},
                                      {"x [m]", "x", "plots/squares.svg: does not show 'x [m]'"},
                                      {"</svg>", "", "plots/squares.svg: not a whole SVG"}});
  expect_faults("resolved.toml", {{"cells = 20", "cells = = 20", "not TOML"}});
  expect_faults("cite.bib", {{"What is a", "What} is {a", "cite.bib: its braces are not balanced"},
                             {"@misc{", "@misc{{", "cite.bib: its braces are not balanced"},
                             {"@misc{", "@misc{{", "cite.bib: does not cite the result as its manifest says"}});
  std::filesystem::remove(out + "/plots/squares.svg");
  expect_fault("plots/squares.svg: was not drawn");
  std::filesystem::remove(out + "/plots/squares.dat");
  expect_fault("plots/squares.dat: missing; the script reads it");
}

TEST_F(ReportTest, draws_figures_for_print_that_are_no_part_of_the_result) {
  const Reply reply = call({"report", out, "--figures", "pdf,tex"});
  for (const char* file :
       {"plots/squares.pdf", "plots/squares-latex.tex", "plots/squares-latex.pdf", "plots/cost.pdf"}) {
    expect_reply(reply, 0, {"drawn: " + out + "/" + file + "\n"});
    EXPECT_FALSE(read_text(out + "/" + file).empty()) << file;
  }
  EXPECT_TRUE(read_text(out + "/plots/squares.pdf").starts_with("%PDF-"));
  EXPECT_TRUE(holds(read_text(out + "/plots/squares-latex.tex"), "{squares-latex}"));
  EXPECT_EQ(call({"report", out, "--check"}).status, 0);
  EXPECT_TRUE(holds(run({"--seed", "3"}).err, "complete already")) << "the result is still complete";
  EXPECT_EQ(ToyControl::computed, 0);
}

TEST_F(ReportTest, runs_no_script_that_lies_in_the_folder) {
  const std::string script = read_text(out + "/plots/squares.gp") + "\nsystem('touch " + folder / "run" + "')\n";
  for (const char* figure : {"squares", "cost", "mine"})
    write_text(out + "/plots/" + std::string(figure) + ".gp", script);
  std::string said = read_text(out + "/plots/squares.json");
  said.replace(said.find("y [m^2]"), 7, "`touch run` '.system('touch " + folder / "run" + "').'");
  write_text(out + "/plots/squares.json", said);
  EXPECT_EQ(call({"report", out, "--figures", "pdf"}).status, 0);
  EXPECT_TRUE(read_text(out + "/plots/squares.pdf").starts_with("%PDF-"));
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  EXPECT_EQ(read_text(out + "/plots/squares.gp"), script);
}

TEST_F(ReportTest, names_what_is_wrong_with_the_data_of_a_figure) {
  const std::string good = read_text(out + "/plots/squares.json");
  const auto expect_trouble = [&](const std::string& from, const std::string& to, const std::string& trouble) {
    change("plots/squares.json", from, to);
    expect_reply(call({"report", out, "--figures", "pdf"}), 1, {"squares was not drawn as pdf: " + trouble});
    write_text(out + "/plots/squares.json", good);
  };
  expect_trouble("\"color\":\"\"", "\"color\":\"red'\"",
                 "plots/squares.json: key 'panels[0].series[0].color': \"red'\" is");
  expect_trouble("\"mark\":\"points\"", "\"mark\":1",
                 "plots/squares.json: key 'panels[0].series[0].mark': 1 is not allowed");
  expect_trouble("\"name\":\"squares\"", "\"name\":\"cost\"", "plots/squares.json is of another figure");
  expect_trouble("\"y\":[", "\"y\":[0,", "figure 'squares', series 'squares': lists of different length");
  std::filesystem::remove(out + "/plots/squares.json");
  EXPECT_TRUE(holds(call({"report", out, "--figures", "pdf"}).err, "plots/squares.json is missing"));
}

TEST_F(ReportTest, draws_beside_others_who_draw) {
  const Workshop theirs(out);  // of a process that is not done
  write_text(theirs.path() / "squares.gp", "theirs");
  FolderLock lock;
  ASSERT_TRUE(lock.take(out, true));
  EXPECT_EQ(call({"report", out, "--figures", "pdf"}).status, 0);
  EXPECT_EQ(read_text(theirs.path() / "squares.gp"), "theirs");
}

TEST_F(ReportTest, does_not_draw_what_a_run_is_replacing) {
  FolderLock lock;
  ASSERT_TRUE(lock.take(out));
  EXPECT_EQ(call({"report", out, "--figures", "pdf"}).err, out + ": a run is at work here; wait for it\n");
}

TEST_F(ReportTest, prints_no_control_character_of_a_manifest) {
  const char* const summary = "cells:\t20\x7f";
  change_manifest("/question", "What\x1b]0;is\x07 a square\xc2\x9b?");
  change_manifest("/summary", summary);
  const std::string said = call({"report", out}).out;
  EXPECT_TRUE(said.starts_with("What\\x1b]0;is\\x07 a square\\u009b?\n")) << said;
  EXPECT_TRUE(holds(said, "cells:\t20\\u007f\n"));
  const std::string reply = call({"report", out, "--json"}).out;
  EXPECT_TRUE(std::ranges::none_of(reply, [](char letter) { return letter == 0x7f || letter == 0x1b; }));
  EXPECT_EQ(nlohmann::json::parse(reply).at("summary"), summary);
}

TEST_F(ReportTest, sees_a_link_where_a_file_should_be) {
  for (const char* file : {"data/cells.csv", "report.html", "plots/squares.gp"}) {
    std::filesystem::rename(out + "/" + file, folder / "elsewhere");
    std::filesystem::create_symlink(folder / "elsewhere", out + "/" + file);
    expect_fault(std::string(file) + ": is a link, not the file that the run wrote");
    std::filesystem::rename(folder / "elsewhere", out + "/" + file);
  }
  EXPECT_EQ(check_result(out), std::vector<std::string>{});
}

TEST_F(ReportTest, draws_them_at_the_end_of_a_run_too) {
  EXPECT_EQ(run({"--seed", "3", "--figures", "pdf"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/plots/squares.pdf"));
  EXPECT_FALSE(std::filesystem::exists(out + "/plots/squares-latex.tex"));
}

TEST_F(ReportTest, removes_them_when_the_result_is_computed_again) {
  ASSERT_EQ(call({"report", out, "--figures", "pdf,tex"}).status, 0);
  std::filesystem::remove(out + "/data/cells.csv");
  ASSERT_EQ(run({"--seed", "3"}).status, 0);
  for (const char* file : {"plots/squares.pdf", "plots/squares-latex.tex", "plots/squares-latex.pdf"})
    EXPECT_FALSE(std::filesystem::exists(out + "/" + file)) << file << " is of the old data";
}

TEST_F(ReportTest, refuses_what_it_cannot_take) {
  expect_refusal(call({"report"}), {"report: the folder of a result is missing"});
  expect_refusal(call({"report", out, "--figures", "png"}), {"--figures: 'png' is not allowed; allowed: pdf, tex"});
  expect_refusal(call({"report", out, "--figures", "pdf,"}), {"--figures: '' is not allowed"});
  expect_refusal(call({"report", out + "x", "--check"}), {out + "x: there is no such folder"});
  const std::string far = out + std::string(300, 'x');
  expect_refusal(call({"report", far, "--check"}), {far + ": cannot be read: File name too long"});
}

TEST(CsvReader, reads_what_rfc_4180_allows_and_names_the_line_of_what_it_does_not) {
  const auto rows = read_csv("a,b\n\"x\n\"\"y\"\"\",\n1,2\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].fields, (std::vector<std::string>{"x\n\"y\"", ""}));
  EXPECT_EQ(rows[2].line, 4u);
  for (const char* text : {"a\nb\"c\n", "a\n\"b\"c\n", "a\n\"b\n", "a\nb"}) {  // the last was cut
    try {
      read_csv(text);
      ADD_FAILURE() << text;
    } catch (const CsvError& error) {
      EXPECT_EQ(error.line, 2u) << text;
    }
  }
}

}  // namespace
}  // namespace thinwall
