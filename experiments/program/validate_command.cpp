#include <thinwall/experiments/program/command.hpp>

#include <algorithm>
#include <ostream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/validate/turning.hpp>
#include <thinwall/experiments/validate/validate.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view row_form = "{:<{}}  {:<11}  {:>8}  {:>8}  {:>8}  {:>8}  {:>7}  {:>7}\n";

std::string row_text(std::size_t width, std::string_view family, std::string_view primitives,
                     const QueryCounts& counts) {
  return fmt::format(row_form, family, width, primitives, grouped_text(counts.read), grouped_text(counts.all_skipped()),
                     grouped_text(counts.checked), grouped_text(counts.hits), grouped_text(counts.false_negatives),
                     grouped_text(counts.false_positives));
}

/// The key and the words of each `Skipped`.
struct SkippedWords {
  const char *key, *words;
};
constexpr std::array<SkippedWords, 3> reasons = {
    {{"skipped_not_rigid", "a primitive does not translate rigidly"},
     {"skipped_not_double", "a coordinate is not a double"},
     {"skipped_rounding_decides", "rounding a displacement to double would change the answer"}}};

std::string skipped_text(const QueryCounts& counts) {
  std::string out;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (counts.skipped[i] == 0) continue;
    out += fmt::format("skipped {:>8}: {}\n", grouped_text(counts.skipped[i]), reasons[i].words);
  }
  if (counts.rounded > 0) {
    out += fmt::format("rounded {:>8}: a displacement is not a double; the nearest one has the same exact answer\n",
                       grouped_text(counts.rounded));
  }
  return out;
}

std::string text_reply(const Validation& validation) {
  std::size_t width = std::string_view("family").size();
  for (const QueryFamily& family : validation.families) width = std::max(width, family.name.size());
  std::string out =
      fmt::format(row_form, "family", width, "primitives", "read", "skipped", "checked", "hits", "false -", "false +");
  for (const QueryFamily& family : validation.families) {
    out += row_text(width, family.name, name(family.primitives), family.counts);
  }
  const QueryCounts& total = validation.total;
  out += row_text(width, "total", "", total) + "\n" + skipped_text(total);
  out += fmt::format(
      "\n{} verdicts of ClosedForm checked against the file and exact arithmetic: {} false negatives, {} false positives",
      grouped_text(total.checked), total.false_negatives, total.false_positives);
  if (total.undecided > 0) out += fmt::format(", {} undecided", total.undecided);
  if (total.file_differs > 0) out += fmt::format("; the file is wrong {} times", total.file_differs);
  return out + fmt::format("\nmedian {} ns a query, called again and again\n", rounded_text(validation.median_ns, 3));
}

std::string json_reply(const Validation& validation) {
  const auto object = [](const QueryCounts& counts) {
    ordered_json out = json_of(counts);
    out["skipped"] = counts.all_skipped();
    for (std::size_t i = 0; i < reasons.size(); ++i) out[reasons[i].key] = counts.skipped[i];
    return out;
  };
  ordered_json reply = object(validation.total);
  reply["median_ns"] = validation.median_ns;
  reply["families"] = ordered_json::array();
  for (const QueryFamily& family : validation.families) {
    ordered_json entry{{"family", family.name}, {"primitives", name(family.primitives)}};
    entry.update(object(family.counts));
    reply["families"].push_back(entry);
  }
  return json_line(reply);
}

// ---- Of shapes that turn.

std::string text_reply(const TurningValidation& validation) {
  std::string out = fmt::format("{:<30} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>13} {:>8}\n", "method", "queries",
                                "touching", "late", "missed", "false", "near", "gave up", "largest error", "ns");
  for (std::size_t i = 0; i < validation.methods.size(); ++i) {
    const TurningCounts& counts = validation.total[i];
    out += fmt::format("{:<30} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>13} {:>8}\n", validation.methods[i].name,
                       grouped_text(counts.queries), grouped_text(counts.touching), grouped_text(counts.late),
                       grouped_text(counts.missed), grouped_text(counts.false_hits), grouped_text(counts.near),
                       grouped_text(counts.gave_up), rounded_text(counts.largest_error, 2),
                       rounded_text(validation.median_ns[i], 3));
  }
  return out +
         fmt::format(
             "\nfalse: hits of what stays apart; near: of those, nearer than the method's tolerance as far as the file "
             "proves.\nlargest error: of a step; ns: median of a first call.\n{}\n",
             validation.wrong == 0 ? "Every method keeps what it claims."
                                   : plural_text(validation.wrong, "answer") + " against what a method claims.");
}

std::string json_reply(const TurningValidation& validation) {
  const auto methods = [&](const std::vector<TurningCounts>& all) {
    ordered_json list = ordered_json::array();
    for (std::size_t i = 0; i < all.size(); ++i) {
      list.emplace_back(ordered_json{{"method", validation.methods[i].name}}).update(json_of(all[i]));
    }
    return list;
  };
  ordered_json reply{{"wrong", validation.wrong}, {"methods", methods(validation.total)}};
  for (std::size_t i = 0; i < validation.methods.size(); ++i) {
    reply["methods"][i]["never_late"] = validation.methods[i].never_late;
    reply["methods"][i]["hits_are_true"] = validation.methods[i].hits_are_true;
    reply["methods"][i]["median_ns"] = validation.median_ns[i];
  }
  reply["pairs"] = ordered_json::array();
  for (const TurningPairCounts& pair : validation.pairs)
    reply["pairs"].push_back({{"pair", pair.pair}, {"methods", methods(pair.counts)}});
  return json_line(reply);
}

constexpr const char* validate_examples =
    R"(  thinwall validate ccd-queries                 every CSV file below the folder
  thinwall validate ccd-queries/unit-tests --json
  thinwall validate --turning docs/data/turning  shapes that turn, with their exact times; a file or a folder
)";

constexpr const char* validate_footer =
    R"(A file has 8 rows a query and lies in a folder named vertex-face or edge-edge. Queries whose two primitives translate
rigidly are checked, the others counted. Files of --turning are described in docs/data/README.md; every method that turns
is held against them. Exit code 1: a verdict is wrong.
)";

struct ValidateText {
  std::string folder;
  OptionText turning;
  bool json = false;
};

/// Prints the reply, and what is wrong.
template <class V> int print_judged(const V& validation, std::int64_t wrong, bool json, const Call& call) {
  call.out << (json ? json_reply(validation) : text_reply(validation));
  call.out.flush();
  for (const std::string& line : validation.wrongs) call.err << line << "\n";
  return wrong == 0 ? exit_done : exit_failed;
}

int print_validation(const ValidateText& text, const Call& call) {
  if (text.turning) {
    if (!text.folder.empty()) throw UsageError("validate: --turning takes the place of the folder; give one of them");
    if (text.turning->empty()) throw UsageError("--turning: '' is not allowed; a CSV file, or a folder of them");
    const TurningValidation validation = validate_turning(*text.turning);
    return print_judged(validation, validation.wrong, text.json, call);
  }
  if (text.folder.empty()) {
    throw UsageError("validate: a folder of published queries is missing; see thinwall validate --help");
  }
  const Validation validation = validate(text.folder);
  return print_judged(validation, validation.total.wrong(), text.json, call);
}

void add_validate(CLI::App& self, ValidateText& text) {
  self.footer(validate_footer);
  add_target(self, "folder", text.folder, "Where the CSV files of queries are", "DIR");
  add_text(self, "--turning", text.turning, "Instead: queries of shapes that turn; a CSV file, or a folder of them",
           "FILE");
  add_json(self, text.json);
}

}  // namespace

Command validate_command() {
  return {"validate", "Check the verdicts of published queries against exact arithmetic", validate_examples,
          options(add_validate, print_validation)};
}

}  // namespace thinwall
