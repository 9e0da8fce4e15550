#include <thinwall/experiments/bouncing/long_run.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

std::vector<LongRunPoint> long_run(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed,
                                   std::int64_t runs, std::int64_t bounces) {
  const RandomStream stream = random_stream(cell, seed);
  constexpr std::uint64_t draw = 1;  // draw 0 is the phases'
  std::vector<std::vector<double>> all;
  std::size_t shortest = static_cast<std::size_t>(bounces);
  for (std::int64_t i = 0; i < runs; ++i) {
    const double elapsed = uniform(random_words(stream, static_cast<std::uint64_t>(i), draw)[0]);
    all.push_back(policy.energies(cell, elapsed, bounces));
    shortest = std::min(shortest, all.back().size());
  }
  std::vector<LongRunPoint> points;
  for (std::size_t n = 1; n <= shortest; n *= 2) {
    BounceTally tally;
    for (const std::vector<double>& energies : all) tally.add(energies[n - 1]);
    points.push_back({static_cast<std::int64_t>(n), runs, tally.mean, tally.sigma()});
  }
  return points;
}

LongRun make_long_run(const BouncePolicy& policy, const BounceCell& cell, std::int64_t bounces,
                      std::vector<LongRunPoint> points) {
  const std::vector<double> at_rest = policy.energies(cell, 0, bounces);
  return {policy.name,
          cell,
          policy.drift,
          bounce_theory(policy.name, 0, 1).sigma(),
          at_rest.empty() ? 0 : at_rest.back(),
          static_cast<std::int64_t>(at_rest.size()),
          std::move(points)};
}

double random_phase_mean(const LongRun& run, double bounces) {
  const double speed = 1 + run.drift * delta(run.cell) * bounces / 2;
  return speed > 0 ? speed * speed : 0;
}

double random_phase_sigma(const LongRun& run, double bounces) {
  return std::sqrt(random_phase_mean(run, bounces) * bounces) * delta(run.cell) * run.sigma;
}

std::string to_line(const std::vector<LongRunPoint>& points) {
  std::string line = std::to_string(points.size());
  for (const LongRunPoint& p : points) line += fmt::format(" {} {} {:a} {:a}", p.bounces, p.runs, p.mean, p.sigma);
  return line;
}

std::vector<LongRunPoint> long_run_from_line(const std::string& line) {
  std::istringstream in(line);
  std::size_t count = 0;
  in >> count;
  std::vector<LongRunPoint> points;
  for (std::size_t i = 0; i < count && in; ++i) {
    LongRunPoint& p = points.emplace_back();
    std::string mean, sigma;  // streams do not read hexadecimal
    in >> p.bounces >> p.runs >> mean >> sigma;
    p.mean = std::strtod(mean.c_str(), nullptr);
    p.sigma = std::strtod(sigma.c_str(), nullptr);
  }
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a long run: " + line);
  return points;
}

}  // namespace thinwall
