#include <thinwall/experiments/engines/tally.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

EngineTally& EngineTally::operator+=(const EngineTally& more) {
  shots += more.shots;
  tunneled += more.tunneled;
  unseen += more.unseen;
  stuck += more.stuck;
  lost += more.lost;
  turned += more.turned;
  lateness += more.lateness;
  energy += more.energy;
  latest = std::max(latest, more.latest);
  earliest = std::min(earliest, more.earliest);
  most_energy = std::max(most_energy, more.most_energy);
  least_energy = std::min(least_energy, more.least_energy);
  deepest = std::max(deepest, more.deepest);
  seconds += more.seconds;
  return *this;
}

std::string to_line(const EngineTally& t) {
  return fmt::format("{} {} {} {} {} {} {} {} {:a} {:a} {:a} {:a} {:a} {:a}", t.shots, t.tunneled, t.unseen, t.stuck,
                     t.lost, t.turned, t.lateness, t.energy, t.latest, t.earliest, t.most_energy, t.least_energy,
                     t.deepest, t.seconds);
}

EngineTally engine_tally_from_line(const std::string& line) {
  std::istringstream in(line);
  EngineTally t;
  in >> t.shots >> t.tunneled >> t.unseen >> t.stuck >> t.lost >> t.turned >> t.lateness >> t.energy;
  for (double* field : {&t.latest, &t.earliest, &t.most_energy, &t.least_energy, &t.deepest, &t.seconds}) {
    std::string text;  // streams do not read hexadecimal or infinity
    in >> text;
    *field = std::strtod(text.c_str(), nullptr);
  }
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a tally of an engine: " + line);
  return t;
}

}  // namespace thinwall
