#include <stdexcept>

#include <thinwall/experiments/bouncing/scenarios.hpp>

namespace thinwall {

namespace {

/// The parts between the marks; texts of scenarios hold neither.
std::vector<std::string> parts(const std::string& text, char mark) {
  std::vector<std::string> list;
  std::size_t at = 0;
  for (std::size_t end = text.find(mark); end != std::string::npos; end = text.find(mark, at)) {
    list.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  list.push_back(text.substr(at));
  return list;
}

}  // namespace

std::string to_line(const std::vector<BounceScenario>& scenarios) {
  std::string line;
  for (const BounceScenario& s : scenarios) {
    if (!line.empty()) line += '|';
    line += s.name + '~' + s.must + '~' + s.happened + '~' + (s.passed ? "pass" : "fail");
  }
  return line;
}

std::vector<BounceScenario> bounce_scenarios_from_line(const std::string& line) {
  std::vector<BounceScenario> scenarios;
  for (const std::string& text : parts(line, '|')) {
    const std::vector<std::string> fields = parts(text, '~');
    if (fields.size() != 4 || (fields[3] != "pass" && fields[3] != "fail")) {
      throw std::runtime_error("not a list of scenarios: " + line);
    }
    scenarios.push_back({fields[0], fields[1], fields[2], fields[3] == "pass"});
  }
  return scenarios;
}

}  // namespace thinwall
