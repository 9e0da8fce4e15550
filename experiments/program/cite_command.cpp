#include <thinwall/experiments/program/cite_command.hpp>

#include <memory>
#include <optional>
#include <ostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/program/options.hpp>
#include <thinwall/experiments/results/kept_result.hpp>
#include <thinwall/experiments/settings.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;

constexpr const char* cite_examples = R"(  thinwall cite                      the software
  thinwall cite results/thin_wall    the software, and that result
)";

std::string json_reply(const SoftwareCitation& software, const std::optional<ResultCitation>& result) {
  ordered_json reply = {{"software",
                         {{"title", software.title},
                          {"authors", software.authors},
                          {"version", software.version},
                          {"date", software.date},
                          {"license", software.license},
                          {"bibtex", bibtex(software)}}}};
  if (result) {
    reply["result"] = {{"experiment", result->experiment},
                       {"title", result->question},
                       {"run_id", result->run_id},
                       {"seed", result->seed},
                       {"commit", result->commit},
                       {"dirty", result->dirty},
                       {"date", result->date},
                       {"bibtex", bibtex(*result)}};
  }
  return reply.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

struct CiteText {
  std::string target;
  bool given = false;  ///< the target, be it empty
  bool json = false;
};

int cite(const CiteText& text, std::ostream& out) {
  SoftwareCitation software = this_software();
  std::optional<ResultCitation> result;
  if (text.given && text.target.empty()) throw UsageError("cite: the folder of a result is empty; name one, or none");
  if (text.given) {
    const KeptResult kept = read_result(text.target);
    software = kept.software;
    result = kept.citation;
  }
  if (text.json) {
    out << json_reply(software, result);
  } else {
    out << (result ? bibtex(software, *result) : bibtex(software));
  }
  return exit_done;
}

Action declare_cite(CLI::App& self) {
  const auto text = std::make_shared<CiteText>();
  add_target(self, "result", text->target, "The folder of a result; without one the software alone is cited", "RESULT");
  self.get_option("result")->each([text](const std::string&) { text->given = true; });
  add_json(self, text->json);
  return [text](const Call& call) { return cite(*text, call.out); };
}

}  // namespace

Command cite_command() {
  return {"cite", "Print BibTeX for the software, and for a result", cite_examples, declare_cite};
}

}  // namespace thinwall
