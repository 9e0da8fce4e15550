#include <thinwall/experiments/crossing_bullets/tally.hpp>

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

std::string to_line(const CrossingTally& t) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {:a} {:a} {:a} {:a}", t.shots, t.touching, t.missed,
                     t.false_hits, t.undecided, t.evaluations, t.timed, t.lateness, t.causes.inside, t.causes.too_early,
                     t.causes.too_late, t.causes.beside, t.latest, t.earliest, t.widest, t.deepest);
}

CrossingTally crossing_tally_from_line(const std::string& line) {
  std::istringstream in(line);
  CrossingTally t;
  std::string latest, earliest, widest, deepest;
  in >> t.shots >> t.touching >> t.missed >> t.false_hits >> t.undecided >> t.evaluations >> t.timed >> t.lateness >>
      t.causes.inside >> t.causes.too_early >> t.causes.too_late >> t.causes.beside >> latest >> earliest >> widest >>
      deepest;
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a tally of encounters: " + line);
  t.latest = std::strtod(latest.c_str(), nullptr);  // streams do not read hexadecimal or infinity
  t.earliest = std::strtod(earliest.c_str(), nullptr);
  t.widest = std::strtod(widest.c_str(), nullptr);
  t.deepest = std::strtod(deepest.c_str(), nullptr);
  return t;
}

}  // namespace thinwall
