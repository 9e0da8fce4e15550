#include <thinwall/experiments/swept_bounds/tally.hpp>

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

std::string to_line(const SweepTally& t) {
  return fmt::format("{} {} {} {} {} {}", t.shots, t.touching, t.reported, t.false_hits, t.grazing, t.missed);
}

SweepTally sweep_tally_from_line(const std::string& line) {
  std::istringstream in(line);
  SweepTally t;
  in >> t.shots >> t.touching >> t.reported >> t.false_hits >> t.grazing >> t.missed;
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a tally of balls: " + line);
  return t;
}

}  // namespace thinwall
