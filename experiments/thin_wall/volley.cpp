#include <thinwall/experiments/thin_wall/volley.hpp>

#include <algorithm>

namespace thinwall {

std::vector<Volley> volleys_of(std::int64_t shots, std::int64_t most) {
  most = std::max(most, (shots + most_volleys - 1) / most_volleys);
  std::vector<Volley> volleys;
  for (std::int64_t first = 0; first < shots; first += most) volleys.push_back({first, std::min(most, shots - first)});
  return volleys;
}

Tally fire(const Cell& cell, const Detector& detector, const Volley& volley, std::uint64_t seed) {
  const Target aimed = target(cell);
  const RandomStream stream = random_stream(cell, seed);
  Tally tally;
  for (std::int64_t i = volley.first; i < volley.first + volley.shots; ++i) {
    detector.fire(aimed, random_start(aimed, stream, static_cast<std::uint64_t>(i)), tally);
  }
  return tally;
}

}  // namespace thinwall
