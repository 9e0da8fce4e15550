#include <thinwall/experiments/extremes/theory.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <thinwall/experiments/extremes/breaks.hpp>

namespace thinwall {

namespace {

constexpr std::string_view closed_form = "closed_form", foil = "textbook", balls = "sphere_sphere",
                           forward = "closed_form_forward";

std::string where(const ExtremeLine& line) { return std::string(line.pair->name) + ", " + key(line.place); }

/// The contract: at most 4, wherever a contact lasts.
template <class Measure>
void add_contract(std::vector<LadderTest>& tests, const std::vector<ExtremeLine>& lines, std::size_t precision,
                  std::string what, double most, const Measure& measure) {
  LadderTest test{.what = std::move(what), .precision = precision, .most = most};
  for (const ExtremeLine& line : lines) {
    if (!matches(line, {.method = closed_form, .precision = precision, .pairs = PairSet::all})) continue;
    if (line.tally.queries == 0 || contact_share(line.place) < least_contact * all_precisions()[precision].unit)
      continue;
    if (test.what == forward && grazing_share(line.place) < least_contact * all_precisions()[precision].unit) continue;
    ++test.cells;
    const double x = measure(line.tally);
    if (x <= test.measured) continue;
    test.measured = x;
    test.where = where(line);
  }
  if (test.cells > 0) tests.push_back(test);
}

/// The cells of two balls along the distance.
std::vector<const ExtremeLine*> foil_lines(const std::vector<ExtremeLine>& lines, std::size_t precision) {
  std::vector<const ExtremeLine*> found;
  for (const ExtremeLine& line : lines) {
    if (matches(line, {.method = foil, .precision = precision}) && line.pair->name == balls &&
        line.place.axis == ExtremeAxis::distance && line.tally.queries > 0) {
      found.push_back(&line);
    }
  }
  std::sort(found.begin(), found.end(), [](auto* a, auto* b) { return a->place.value < b->place.value; });
  return found;
}

void add_loss(std::vector<LadderTest>& tests, const std::vector<ExtremeLine>& lines, std::size_t precision,
              const LossTheory& theory) {
  const double u = all_precisions()[precision].unit;
  LadderTest bound{.what = "textbook_loss", .precision = precision, .most = theory.most};
  LadderTest spread{.what = "textbook_loss_spread", .precision = precision, .least = 1, .most = theory.spread};
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const ExtremeLine* line : foil_lines(lines, precision)) {
    const double d = line->place.value;
    if (d < 10 || u * d * d > 1e-3 || line->tally.timed < 4) continue;  // first order, and enough of it
    ++bound.cells;
    const double scaled = std::pow(d, 2 - theory.exponent);
    if (line->tally.loss_max * scaled > bound.measured) {
      bound.measured = line->tally.loss_max * scaled;
      bound.where = where(*line);
    }
    least = std::min(least, line->tally.loss_rms * scaled);
    if (line->tally.loss_rms * scaled > most) {
      most = line->tally.loss_rms * scaled;
      spread.where = where(*line);
    }
  }
  if (bound.cells == 0) return;
  spread.cells = bound.cells;
  spread.measured = most / least;
  tests.push_back(bound);
  if (spread.cells > 1) tests.push_back(spread);
}

/// The first distance at which one verdict in ten is wrong, over 1 / sqrt(u). Infinite where there is none.
void add_threshold(std::vector<LadderTest>& tests, const std::vector<ExtremeLine>& lines, std::size_t precision) {
  const double threshold = 1 / std::sqrt(all_precisions()[precision].unit);
  const std::vector<const ExtremeLine*> along = foil_lines(lines, precision);
  if (along.empty() || along.front()->place.value > threshold / 10) return;
  if (std::any_of(along.begin(), along.end(), [](const ExtremeLine* line) { return line->tally.queries < 5; })) return;
  const bool reached = along.back()->place.value >= 10 * threshold;
  LadderTest test{.what = "textbook_verdicts",
                  .precision = precision,
                  .cells = static_cast<std::int64_t>(along.size()),
                  .measured = std::numeric_limits<double>::infinity(),
                  .least = 0.1,
                  .most = reached ? 10 : std::numeric_limits<double>::infinity()};
  for (const ExtremeLine* line : along) {
    if (10 * line->tally.far_wrong < line->tally.queries) continue;
    test.measured = line->place.value / threshold;
    test.where = where(*line);
    break;
  }
  tests.push_back(test);
}

}  // namespace

std::vector<LadderTest> ladder_tests(const std::vector<ExtremeLine>& lines, const LossTheory& theory) {
  std::vector<LadderTest> tests;
  for (const std::size_t p : precisions_of(lines)) {
    add_contract(tests, lines, p, std::string(forward), 4, [](const ExtremeTally& t) { return t.forward_max; });
    add_contract(tests, lines, p, "closed_form_backward", 4, [](const ExtremeTally& t) { return t.backward_max; });
    add_contract(tests, lines, p, "closed_form_verdicts", break_verdict,
                 [](const ExtremeTally& t) { return t.worst_wrong; });
    add_contract(tests, lines, p, "closed_form_no_answer", 0,
                 [](const ExtremeTally& t) { return static_cast<double>(t.gave_up + t.invalid); });
    add_loss(tests, lines, p, theory);
    add_threshold(tests, lines, p);
  }
  return tests;
}

}  // namespace thinwall
