#include <thinwall/experiments/extremes/tally.hpp>

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// Streams do not read hexadecimal or infinity.
double read_number(std::istream& in) {
  std::string word;
  in >> word;
  return std::strtod(word.c_str(), nullptr);
}

ExtremeTally tally_from(const std::string& text) {
  ExtremeTally t;
  std::istringstream in(text);
  in >> t.method >> t.queries >> t.touching >> t.changed >> t.wrong >> t.far_wrong >> t.gave_up >> t.invalid >> t.timed;
  for (double* number : {&t.worst_wrong, &t.forward_median, &t.forward_max, &t.backward_median, &t.backward_max,
                         &t.loss_rms, &t.loss_max, &t.nanoseconds}) {
    *number = read_number(in);
  }
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a tally: " + text);
  return t;
}

}  // namespace

std::string to_line(const std::vector<ExtremeTally>& tallies) {
  std::string line;
  for (const ExtremeTally& t : tallies) {
    line += fmt::format("{}{} {} {} {} {} {} {} {} {} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a}", line.empty() ? "" : ";",
                        t.method, t.queries, t.touching, t.changed, t.wrong, t.far_wrong, t.gave_up, t.invalid, t.timed,
                        t.worst_wrong, t.forward_median, t.forward_max, t.backward_median, t.backward_max, t.loss_rms,
                        t.loss_max, t.nanoseconds);
  }
  return line;
}

std::vector<ExtremeTally> extreme_tallies_from_line(const std::string& line) {
  std::vector<ExtremeTally> tallies;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(';', at), line.size());
    tallies.push_back(tally_from(line.substr(at, end - at)));
    at = end + 1;
  }
  return tallies;
}

}  // namespace thinwall
