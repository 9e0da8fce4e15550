#include <thinwall/experiments/bouncing/bounce_tally.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

void BounceTally::add(double error) {
  ++trials;
  const double distance = error - mean;
  mean += distance / static_cast<double>(trials);
  squares += distance * (error - mean);
  least = std::min(least, error);
  most = std::max(most, error);
}

std::string to_line(const BounceTally& t) {
  return fmt::format("{} {:a} {:a} {:a} {:a}", t.trials, t.mean, t.squares, t.least, t.most);
}

BounceTally bounce_tally_from_line(const std::string& s) {
  std::istringstream in(s);
  BounceTally t;
  in >> t.trials;
  for (double* number : {&t.mean, &t.squares, &t.least, &t.most}) {
    std::string word;  // streams do not read hexadecimal or infinity
    in >> word;
    *number = std::strtod(word.c_str(), nullptr);
  }
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a tally of bounces: " + s);
  return t;
}

}  // namespace thinwall
