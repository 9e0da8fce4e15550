#include <gtest/gtest.h>

#include <limits>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/table_text.hpp>

#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

TEST(Sha256, gives_the_examples_of_the_standard) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(
      sha256("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrst"
             "nopqrstu"),
      "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// At 55 to 64 bytes what is padded grows from one block to two.
TEST(Sha256, pads_at_every_length) {
  EXPECT_EQ(sha256(std::string(55, 'a')), "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  EXPECT_EQ(sha256(std::string(56, 'a')), "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a");
  EXPECT_EQ(sha256(std::string(64, 'a')), "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
}

TEST(Sha256, of_a_file_is_of_its_content) {
  const TemporaryFolder folder;
  write_text(folder / "abc", "abc");
  EXPECT_EQ(sha256_of_file(folder / "abc"), sha256("abc"));
  EXPECT_EQ(sha256_of_file(folder / "none"), "");
}

Table small_table() {
  Table table{.name = "cells", .description = "A & B.", .columns = {}, .rows = {}};
  table.columns = {{"method", ColumnType::text, "", "How."},
                   {"angle_deg", ColumnType::number, "deg", "Where."},
                   {"shots", ColumnType::integer, "1", "Count."},
                   {"passed", ColumnType::boolean, "", "If so."}};
  table.rows = {{std::string("end_of_step"), 0.1, std::int64_t{12000}, true},
                {std::string("a,b\"c\"\nd"), -1.5e-7, std::int64_t{12000}, Value{}}};
  return table;
}

TEST(Csv, quotes_as_rfc_4180_says) {
  EXPECT_EQ(csv_text(small_table()),
            "method,angle_deg,shots,passed\nend_of_step,0.1,12000,true\n\"a,b\"\"c\"\"\nd\",-1.5e-07,12000,\n");
}

TEST(Csv, keeps_a_spreadsheet_from_computing_a_text) {
  Table table{.name = "words", .description = "", .columns = {}, .rows = {}};
  table.columns = {{"word", ColumnType::text, "", "Any."}, {"size", ColumnType::number, "1", "Any."}};
  for (const char* word : {"=1+1", "@a", "+1", "-1", "\ta", "\ra", "'a", "'", "-", "a=b", ""})
    table.rows.push_back({std::string(word), -1.5});
  EXPECT_EQ(
      csv_text(table),
      "word,size\n'=1+1,-1.5\n'@a,-1.5\n'+1,-1.5\n'-1,-1.5\n'\ta,-1.5\n\"'\ra\",-1.5\n''a,-1.5\n'',-1.5\n-,-1.5\na=b,-1.5\n,-1.5\n");
}

TEST(Csv, spells_what_is_no_finite_number) {
  EXPECT_EQ(exact_text(Value{std::numeric_limits<double>::quiet_NaN()}), "");
  EXPECT_EQ(exact_text(Value{std::numeric_limits<double>::infinity()}), "INF");
  EXPECT_EQ(exact_text(Value{-std::numeric_limits<double>::infinity()}), "-INF");
  EXPECT_EQ(exact_text(Value{}), "");
}

TEST(Csv, refuses_rows_that_do_not_fit_the_columns) {
  Table table = small_table();
  table.rows[1].pop_back();
  EXPECT_THROW(csv_text(table), std::logic_error);
  table = small_table();
  table.rows[0][2] = 1.5;
  EXPECT_THROW(csv_text(table), std::logic_error);
}

TEST(Datapackage, describes_every_column) {
  Table timings = small_table();
  timings.name = "timings";
  timings.is_timing = true;
  const std::vector<Table> tables = {small_table(), timings};
  const auto json = nlohmann::json::parse(datapackage_text({"thinwall-toy", "title", "text", "1.0"}, tables));
  EXPECT_EQ(json.at("profile"), "tabular-data-package");
  EXPECT_EQ(json.at("name"), "thinwall-toy");
  const auto& cells = json.at("resources").at(0);
  EXPECT_EQ(cells.at("path"), "data/cells.csv");
  EXPECT_EQ(cells.at("hash"), "sha256:" + sha256(csv_text(tables[0])));
  EXPECT_EQ(cells.at("bytes"), csv_text(tables[0]).size());
  EXPECT_EQ(cells.at("schema").at("missingValues"), nlohmann::json::array({""}));
  const auto& angle = cells.at("schema").at("fields").at(1);
  EXPECT_EQ(angle.at("name"), "angle_deg");
  EXPECT_EQ(angle.at("type"), "number");
  EXPECT_EQ(angle.at("unit"), "deg");
  EXPECT_EQ(angle.at("description"), "Where.");
  EXPECT_FALSE(json.at("resources").at(1).contains("hash")) << "timings differ from run to run";
}

TEST(ShownTable, tells_a_constant_column_in_words) {
  const std::string markdown = markdown_table(small_table());
  EXPECT_EQ(markdown,
            "A & B. In every row: shots 12,000.\n\n| method | angle [deg] | passed |\n| :--- | ---: | :--- |\n"
            "| end\\_of\\_step | 0.1 | yes |\n| a,b\"c\" d | -1.5e-07 | \u2013 |\n");
}

TEST(ShownTable, has_no_markup_of_its_words_in_markdown) {
  Table table = small_table();
  table.description = "<b>*a*</b> ![b](http://c) `d` [e, f]";
  EXPECT_TRUE(markdown_table(table).starts_with("&lt;b>\\*a\\*&lt;/b> ![b]\\(http://c) \\`d\\` [e, f] In every row"))
      << markdown_table(table);
}

TEST(ShownTable, is_what_latex_and_html_expect) {
  const std::string latex = latex_table(small_table());
  EXPECT_NE(latex.find("\\begin{tabular}{lrl}\n  \\toprule\n  method & angle [deg] & passed \\\\\n  \\midrule\n"
                       "  end\\_of\\_step & $0.1$ & yes \\\\\n"),
            std::string::npos)
      << latex;
  EXPECT_NE(latex.find("$-1.5\\times 10^{-7}$ & --"), std::string::npos) << latex;
  const std::string html = html_table(small_table());
  EXPECT_NE(html.find("A &amp; B."), std::string::npos);
  EXPECT_NE(html.find("<td class=\"n\">&minus;1.5&times;10<sup>&minus;7</sup></td>"), std::string::npos) << html;
}

Table table_with_intervals() {
  Table table{.name = "cells", .description = "Shares.", .columns = {}, .rows = {}};
  table.columns = {{"method", ColumnType::text, "", "How."},
                   {"share_percent", ColumnType::number, "percent", "Missed.", "lower", "upper"},
                   {"lower", ColumnType::number, "percent", "Lower end of its 95 % Wilson interval."},
                   {"upper", ColumnType::number, "percent", "Upper end of it."}};
  table.rows = {{std::string("a"), 28.723, 28.591, 28.851},
                {std::string("b"), Value{}, Value{}, Value{}},
                {std::string("c"), 1.5, Value{}, Value{}}};
  return table;
}

TEST(ShownTable, shows_a_value_and_its_interval_in_one_cell) {
  EXPECT_EQ(markdown_table(table_with_intervals()),
            "Shares. Brackets hold its 95 % Wilson interval.\n\n| method | share [percent] |\n| :--- | ---: |\n"
            "| a | 28.72 [28.59, 28.85] |\n| b | \u2013 |\n| c | 1.5 |\n");
  EXPECT_NE(latex_table(table_with_intervals()).find("  a & $28.72$ $[28.59, 28.85]$ \\\\\n"), std::string::npos);
  EXPECT_NE(html_table(table_with_intervals()).find("28.72 <span class=\"i\">[28.59, 28.85]</span></td>"),
            std::string::npos);
  EXPECT_TRUE(
      csv_text(table_with_intervals()).starts_with("method,share_percent,lower,upper\na,28.723,28.591,28.851\n"));
}

TEST(ShownTable, refuses_an_interval_whose_end_is_no_column) {
  Table table = table_with_intervals();
  table.columns[1].upper = "most";
  EXPECT_THROW(markdown_table(table), std::logic_error);
}

TEST(ResolvedToml, resolves_to_itself) {
  RunRecord run;
  run.experiment = "toy";
  run.config =
      R"({"experiment":"toy","list":[1,0.1,1e-9],"text":"a \"b\" \\","wall":{"deep":{"x":true},"thickness":2}})";
  const std::string toml = resolved_toml(run);
  EXPECT_EQ(Settings("", "", toml).resolved_json(), Settings(toml, "resolved.toml", toml).resolved_json());
  EXPECT_EQ(nlohmann::json::parse(Settings("", "", toml).resolved_json()), nlohmann::json::parse(run.config));
}

}  // namespace
}  // namespace thinwall
