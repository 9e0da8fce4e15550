#include <thinwall/experiments/advise/words.hpp>

#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace thinwall {

std::string percent_text(double chance) { return chance <= no_chance ? "0" : rounded_text(100 * chance, 3) + " %"; }

std::string tunnel_words(double chance) {
  if (chance <= no_chance) return "no shot tunnels";
  if (chance == 1) return "every shot tunnels";
  return percent_text(chance) + " of the shots tunnel";
}

std::string question_words(const Wish& wish) {
  const Cell& cell = wish.cell;
  const auto number = [](double x) { return rounded_text(x, 4); };
  const std::string angle =
      cell.angle_deg == 0 ? "head-on" : fmt::format("at {} deg from its normal", exact_text(cell.angle_deg));
  std::string text = wrapped(fmt::format(
      "A ball of radius {} m flies at {} m/s at a wall {} m thick, {}, {} steps a second.", exact_text(cell.radius),
      exact_text(cell.speed), exact_text(cell.thickness), angle, number(1 / cell.step)));
  const double contact = slab_chord(cell);
  if (contact == 0) {
    return text + wrapped(
                      "A point and a wall of no thickness are in contact for an instant: every pose that is tested "
                      "misses it, and a method that wants to see the contact again at the time it found does so or not "
                      "as rounding has it.");
  }
  const double steps = contact / step_length(cell);
  return text +
         wrapped(fmt::format("A step is {} s and {} m long; of its path, {} m are in contact with the wall: {}.",
                             number(cell.step), number(step_length(cell)), number(contact),
                             steps < 1 ? percent_text(steps) + " of a step" : rounded_text(steps, 3) + " steps"));
}

std::string wanted_words(const Wish& wish) {
  std::string text = wish.miss == 0   ? "no shot tunnels"
                     : wish.miss == 1 ? "whatever: any number of shots may tunnel"
                                      : fmt::format("at most {} of the shots tunnel", percent_text(wish.miss));
  if (wish.late) text += fmt::format(", and none is seen more than {} m past first contact", exact_text(*wish.late));
  return text;
}

std::string rounded_down_text(double value, int digits) {
  const double near = std::stod(rounded_text(value, digits));
  const double unit = std::pow(10.0, std::floor(std::log10(value)) + 1 - digits);
  return rounded_text(near <= value ? near : near - unit, digits);
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string out, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      out += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return out + line + "\n";
}

}  // namespace thinwall
