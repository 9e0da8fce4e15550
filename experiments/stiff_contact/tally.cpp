#include <thinwall/experiments/stiff_contact/tally.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>

namespace thinwall {

double ContactTally::rms_error() const { return std::sqrt(square_error / static_cast<double>(returned)); }

ContactTally bounce_all(const Approach& e, const PenaltyContact& c, std::uint64_t seed, std::int64_t count) {
  const std::array factors = {e.mass,      e.speed,         e.radius, e.thickness,
                              c.stiffness, c.damping_ratio, c.step,   static_cast<double>(count)};
  const RandomStream stream = {seed, stream_of(factors)};
  const double exact = restitution(c.damping_ratio);
  ContactTally t;
  for (std::int64_t i = 0; i < count; ++i) {
    const double within = uniform(random_words(stream, static_cast<std::uint64_t>(i), 0)[0]);
    const Bounce b = bounce(e, c, (static_cast<double>(i) + within) / static_cast<double>(count));
    if (b.blow_up_step > 0) {
      t.blow_up_step = t.blown_up == 0 ? b.blow_up_step : std::min(t.blow_up_step, b.blow_up_step);
      ++t.blown_up;
    }
    if (b.ending == Ending::escaped) ++t.escaped;
    if (b.ending == Ending::unfinished) ++t.unfinished;
    if (b.ending != Ending::returned) continue;
    ++t.returned;
    t.contact_steps += b.contact_steps;
    t.slowest = std::min(t.slowest, b.speed);
    t.fastest = std::max(t.fastest, b.speed);
    t.speed_sum += b.speed;
    t.square_error += (b.speed - exact) * (b.speed - exact);
    t.shallowest = std::min(t.shallowest, b.deepest);
    t.deepest = std::max(t.deepest, b.deepest);
  }
  return t;
}

std::string to_line(const ContactTally& t) {
  return fmt::format("{} {} {} {} {} {} {:a} {:a} {:a} {:a} {:a} {:a}", t.returned, t.escaped, t.unfinished,
                     t.contact_steps, t.blown_up, t.blow_up_step, t.slowest, t.fastest, t.speed_sum, t.square_error,
                     t.shallowest, t.deepest);
}

double read_number(std::istream& in) {
  std::string text;
  in >> text;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);  // streams do not read hexadecimal or infinity
  if (text.empty() || *end != '\0') throw std::runtime_error("not a number: " + text);
  return value;
}

ContactTally bounce_tally_from(std::istream& in) {
  ContactTally t;
  in >> t.returned >> t.escaped >> t.unfinished >> t.contact_steps >> t.blown_up >> t.blow_up_step;
  if (!in) throw std::runtime_error("not a tally of bounces");
  t.slowest = read_number(in);
  t.fastest = read_number(in);
  t.speed_sum = read_number(in);
  t.square_error = read_number(in);
  t.shallowest = read_number(in);
  t.deepest = read_number(in);
  return t;
}

}  // namespace thinwall
