#include <thinwall/experiments/extremes/breaks.hpp>

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace thinwall {

std::string_view name(Flaw flaw) {
  constexpr std::array<std::string_view, 4> names{"verdict", "error", "nan", "gave_up"};
  return names[static_cast<std::size_t>(flaw)];
}

std::optional<Flaw> flaw_of(const ExtremeTally& tally) {
  if (tally.worst_wrong > break_verdict) return Flaw::verdict;
  if (tally.forward_max > break_error) return Flaw::error;
  if (tally.invalid > 0) return Flaw::nan;
  if (tally.gave_up > 0) return Flaw::gave_up;
  return {};
}

Survival survival(const std::vector<ExtremeLine>& lines, const Arm& arm, std::string_view method, std::size_t precision,
                  PairSet pairs) {
  Survival result;
  for (const double value : values_along(arm, places_of(lines))) {
    const Place place = {arm.axis, value};
    bool asked = false;
    for (const ExtremeLine& line : lines) {
      if (!matches(line, {.method = method, .precision = precision, .place = &place, .pairs = pairs}) ||
          line.tally.queries == 0) {
        continue;
      }
      asked = true;
      const std::optional<Flaw> flaw = flaw_of(line.tally);
      if (!flaw || (result.broken && *flaw >= result.flaw)) continue;
      result.broken = value;
      result.flaw = *flaw;
      result.pair = line.pair->name;
    }
    if (result.broken) return result;
    if (asked) result.survived = value;
  }
  return result;
}

bool breaks_at_once(const std::vector<ExtremeLine>& lines, std::string_view method, std::size_t precision,
                    PairSet pairs) {
  std::size_t asked = 0, at_once = 0;
  for (const Arm& arm : all_arms()) {
    const Survival s = survival(lines, arm, method, precision, pairs);
    if (s.survived || s.broken) ++asked;
    if (s.broken && !s.survived) ++at_once;
  }
  return 2 * at_once > asked;
}

std::string short_text(const Survival& s) {
  if (!s.broken) return s.survived ? "-" : "";
  const char letter = name(s.flaw)[0];
  if (!s.survived) return fmt::format("all{}", letter);
  return fmt::format("{:.3g}{}", std::log10(*s.broken), letter);
}

}  // namespace thinwall
