#include <thinwall/experiments/work_precision/racer.hpp>

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

namespace {

std::string spread_text(const ErrorSpread& s) { return fmt::format("{:a} {:a} {:a}", s.median, s.p99, s.max); }

/// Streams do not read hexadecimal or infinity.
double read_number(std::istream& in) {
  std::string word;
  in >> word;
  return std::strtod(word.c_str(), nullptr);
}

ErrorSpread read_spread(std::istream& in) {
  ErrorSpread spread;
  spread.median = read_number(in);
  spread.p99 = read_number(in);
  spread.max = read_number(in);
  return spread;
}

Racer racer_from(const std::string& text) {
  const std::size_t first = text.find('|'), second = text.find('|', first + 1);
  if (second == std::string::npos) throw std::runtime_error("not a racer: " + text);
  Racer r;
  r.method = text.substr(0, first);
  r.setting = text.substr(first + 1, second - first - 1);
  std::istringstream in(text.substr(second + 1));
  in >> r.queries >> r.touching >> r.missed >> r.false_hits >> r.gave_up >> r.most_evaluations;
  r.time = read_spread(in);
  r.length = read_spread(in);
  r.latest = read_number(in);
  r.earliest = read_number(in);
  r.forward = read_number(in);
  r.evaluations = read_number(in);
  std::size_t rounds = 0;
  int has_option = 0;
  in >> has_option;
  if (has_option != 0) r.option = read_number(in);
  in >> rounds;
  for (std::size_t i = 0; i < rounds && in; ++i) r.nanoseconds.push_back(read_number(in));
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a racer: " + text);
  return r;
}

}  // namespace

std::string to_line(const std::vector<Racer>& racers) {
  std::string line;
  for (const Racer& r : racers) {
    if (!line.empty()) line += ';';
    line += fmt::format("{}|{}|{} {} {} {} {} {} {} {} {:a} {:a} {:a} {:a}", r.method, r.setting, r.queries, r.touching,
                        r.missed, r.false_hits, r.gave_up, r.most_evaluations, spread_text(r.time),
                        spread_text(r.length), r.latest, r.earliest, r.forward, r.evaluations);
    line += r.option ? fmt::format(" 1 {:a}", *r.option) : std::string(" 0");
    line += fmt::format(" {}", r.nanoseconds.size());
    for (const double t : r.nanoseconds) line += fmt::format(" {:a}", t);
  }
  return line;
}

std::vector<Racer> racers_from_line(const std::string& line) {
  std::vector<Racer> racers;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(';', at), line.size());
    racers.push_back(racer_from(line.substr(at, end - at)));
    at = end + 1;
  }
  return racers;
}

}  // namespace thinwall
