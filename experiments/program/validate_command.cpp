#include <thinwall/experiments/program/command.hpp>

#include <algorithm>
#include <memory>
#include <ostream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/validate/validate.hpp>

namespace thinwall {
namespace {

std::string row_text(std::size_t width, std::string_view family, std::string_view primitives,
                     const QueryCounts& counts) {
  return fmt::format("{:<{}}  {:<11}  {:>8}  {:>8}  {:>8}  {:>8}  {:>7}  {:>7}\n", family, width, primitives,
                     grouped_text(counts.read), grouped_text(counts.all_skipped()), grouped_text(counts.checked),
                     grouped_text(counts.hits), grouped_text(counts.false_negatives),
                     grouped_text(counts.false_positives));
}

std::string skipped_text(const QueryCounts& counts) {
  constexpr std::array<std::string_view, 3> reasons = {"a primitive does not translate rigidly",
                                                       "a coordinate is not a double",
                                                       "rounding a displacement to double would change the answer"};
  std::string out;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (counts.skipped[i] > 0) out += fmt::format("skipped {:>8}: {}\n", grouped_text(counts.skipped[i]), reasons[i]);
  }
  if (counts.rounded > 0) {
    out += fmt::format("rounded {:>8}: a displacement is not a double; the nearest one has the same exact answer\n",
                       grouped_text(counts.rounded));
  }
  return out;
}

std::string text_reply(const Validation& validation) {
  std::size_t width = 6;
  for (const QueryFamily& family : validation.families) width = std::max(width, family.name.size());
  std::string out = fmt::format("{:<{}}  {:<11}  {:>8}  {:>8}  {:>8}  {:>8}  {:>7}  {:>7}\n", "family", width,
                                "primitives", "read", "skipped", "checked", "hits", "false -", "false +");
  for (const QueryFamily& family : validation.families) {
    out += row_text(width, family.name, name(family.primitives), family.counts);
  }
  const QueryCounts& total = validation.total;
  out += row_text(width, "total", "", total) + "\n" + skipped_text(total);
  out += fmt::format("\n{} verdicts of ClosedForm checked against the file and exact arithmetic: ",
                     grouped_text(total.checked));
  out += fmt::format("{} false negatives, {} false positives", total.false_negatives, total.false_positives);
  if (total.undecided > 0) out += fmt::format(", {} undecided", total.undecided);
  if (total.file_differs > 0) out += fmt::format("; the file is wrong {} times", total.file_differs);
  return out + fmt::format("\nmedian {} ns a query, called again and again\n", rounded_text(validation.median_ns, 3));
}

std::string json_reply(const Validation& validation) {
  using nlohmann::ordered_json;
  const auto object = [](const QueryCounts& counts) {
    return ordered_json{
        {"read", counts.read},
        {"checked", counts.checked},
        {"hits", counts.hits},
        {"skipped", counts.all_skipped()},
        {"skipped_not_rigid", counts.skipped[static_cast<std::size_t>(Skipped::not_rigid)]},
        {"skipped_not_double", counts.skipped[static_cast<std::size_t>(Skipped::not_double)]},
        {"skipped_rounding_decides", counts.skipped[static_cast<std::size_t>(Skipped::rounding_decides)]},
        {"rounded", counts.rounded},
        {"false_negatives", counts.false_negatives},
        {"false_positives", counts.false_positives},
        {"undecided", counts.undecided},
        {"file_differs", counts.file_differs}};
  };
  ordered_json reply = object(validation.total);
  reply["median_ns"] = validation.median_ns;
  reply["families"] = ordered_json::array();
  for (const QueryFamily& family : validation.families) {
    ordered_json entry{{"family", family.name}, {"primitives", name(family.primitives)}};
    entry.update(object(family.counts));
    reply["families"].push_back(entry);
  }
  return reply.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

constexpr const char* validate_examples =
    R"(  thinwall validate ccd-queries                 every CSV file below the folder
  thinwall validate ccd-queries/unit-tests --json
)";

constexpr const char* validate_footer =
    R"(A file has 8 rows a query and lies in a folder named vertex-face or edge-edge. Queries whose two primitives translate
rigidly are checked, the others counted. Exit code 1: a verdict is wrong.
)";

struct ValidateText {
  std::string folder;
  bool json = false;
};

int print_validation(const ValidateText& text, const Call& call) {
  if (text.folder.empty()) {
    throw UsageError("validate: a folder of published queries is missing; see thinwall validate --help");
  }
  const Validation validation = validate(text.folder);
  call.out << (text.json ? json_reply(validation) : text_reply(validation));
  call.out.flush();
  for (const std::string& wrong : validation.wrongs) call.err << wrong << "\n";
  return validation.total.wrong() == 0 ? exit_done : exit_failed;
}

Action declare_validate(CLI::App& self) {
  const auto text = std::make_shared<ValidateText>();
  self.footer(validate_footer);
  add_target(self, "folder", text->folder, "Where the CSV files of queries are", "DIR");
  add_json(self, text->json);
  return [text](const Call& call) { return print_validation(*text, call); };
}

}  // namespace

Command validate_command() {
  return {"validate", "Check the verdicts of published queries against exact arithmetic", validate_examples,
          declare_validate};
}

}  // namespace thinwall
