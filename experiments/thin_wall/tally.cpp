#include <thinwall/experiments/thin_wall/tally.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

Tally& Tally::operator+=(const Tally& more) {
  shots += more.shots;
  tunneled += more.tunneled;
  undecided += more.undecided;
  queries += more.queries;
  evaluations += more.evaluations;
  lateness += more.lateness;
  wrong_side += more.wrong_side;
  behind += more.behind;
  latest = std::max(latest, more.latest);
  earliest = std::min(earliest, more.earliest);
  widest = std::max(widest, more.widest);
  return *this;
}

std::string to_line(const Tally& t) {
  return fmt::format("{} {} {} {} {} {} {} {} {:a} {:a} {:a}", t.shots, t.tunneled, t.undecided, t.queries,
                     t.evaluations, t.lateness, t.wrong_side, t.behind, t.latest, t.earliest, t.widest);
}

Tally tally_from_line(const std::string& line) {
  std::istringstream in(line);
  Tally t;
  std::string latest, earliest, widest;
  in >> t.shots >> t.tunneled >> t.undecided >> t.queries >> t.evaluations >> t.lateness >> t.wrong_side >> t.behind >>
      latest >> earliest >> widest;
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a tally: " + line);
  t.latest = std::strtod(latest.c_str(), nullptr);  // streams do not read hexadecimal or infinity
  t.earliest = std::strtod(earliest.c_str(), nullptr);
  t.widest = std::strtod(widest.c_str(), nullptr);
  return t;
}

}  // namespace thinwall
