#include <thinwall/experiments/hitscan/tally.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

namespace {

constexpr int bits = 30;

std::string text(const HitscanSpread& s) { return fmt::format("{} {} {:a} {:a}", s.count, s.sum, s.least, s.most); }

HitscanSpread read_spread(std::istream& in) {
  HitscanSpread s;
  std::string least, most;
  in >> s.count >> s.sum >> least >> most;
  s.least = std::strtod(least.c_str(), nullptr);  // streams do not read hexadecimal or infinity
  s.most = std::strtod(most.c_str(), nullptr);
  return s;
}

}  // namespace

void add(HitscanSpread& spread, double x, double unit) {
  ++spread.count;
  spread.sum += std::llround(std::ldexp(x / unit, bits));
  spread.least = std::min(spread.least, x);
  spread.most = std::max(spread.most, x);
}

double mean(const HitscanSpread& spread, double unit) {
  return std::ldexp(static_cast<double>(spread.sum), -bits) * unit / static_cast<double>(spread.count);
}

std::string to_line(const HitscanTally& t) {
  return fmt::format("{} {} {} {} {} {} {}", t.shots, t.touching, t.missed, t.false_hits, text(t.lateness),
                     text(t.point_error), text(t.path_error));
}

HitscanTally hitscan_tally_from_line(const std::string& line) {
  std::istringstream in(line);
  HitscanTally t;
  in >> t.shots >> t.touching >> t.missed >> t.false_hits;
  t.lateness = read_spread(in);
  t.point_error = read_spread(in);
  t.path_error = read_spread(in);
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a tally of shots: " + line);
  return t;
}

}  // namespace thinwall
