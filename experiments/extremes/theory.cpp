#include <thinwall/experiments/extremes/theory.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace thinwall {

namespace {

constexpr std::string_view closed_form = "closed_form", foil = "textbook", balls = "sphere_sphere",
                           forward = "closed_form_forward";

std::string where(const ExtremeRow& row) { return std::string(row.pair->name) + ", " + key(row.place); }

/// The contract: at most 4, wherever a contact lasts.
template <class Measure>
void add_contract(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& rows, std::size_t precision,
                  std::string what, double most, const Measure& measure) {
  LadderTest test{.what = std::move(what), .precision = precision, .most = most};
  for (const ExtremeRow& row : rows) {
    if (!matches(row, {.method = closed_form, .precision = precision, .pairs = PairSet::all})) continue;
    if (row.tally.queries == 0 || contact_share(row.place) < least_contact * all_precisions()[precision].unit) continue;
    if (test.what == forward && grazing_share(row.place) < least_contact * all_precisions()[precision].unit) continue;
    ++test.cells;
    const double x = measure(row.tally);
    if (x <= test.measured) continue;
    test.measured = x;
    test.where = where(row);
  }
  if (test.cells > 0) tests.push_back(test);
}

/// The cells of two balls along the distance.
std::vector<const ExtremeRow*> foil_rows(const std::vector<ExtremeRow>& rows, std::size_t precision) {
  std::vector<const ExtremeRow*> found;
  for (const ExtremeRow& row : rows) {
    if (matches(row, {.method = foil, .precision = precision}) && row.pair->name == balls &&
        row.place.axis == ExtremeAxis::distance && row.tally.queries > 0) {
      found.push_back(&row);
    }
  }
  std::sort(found.begin(), found.end(), [](auto* a, auto* b) { return a->place.value < b->place.value; });
  return found;
}

void add_loss(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& rows, std::size_t precision,
              const LossTheory& theory) {
  const double u = all_precisions()[precision].unit;
  LadderTest bound{.what = "textbook_loss", .precision = precision, .most = theory.most};
  LadderTest spread{.what = "textbook_loss_spread", .precision = precision, .least = 1, .most = theory.spread};
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const ExtremeRow* row : foil_rows(rows, precision)) {
    const double d = row->place.value;
    if (d < 10 || u * d * d > 1e-3 || row->tally.timed < 4) continue;  // first order, and enough of it
    ++bound.cells;
    const double scaled = std::pow(d, 2 - theory.exponent);
    if (row->tally.loss_max * scaled > bound.measured) {
      bound.measured = row->tally.loss_max * scaled;
      bound.where = where(*row);
    }
    least = std::min(least, row->tally.loss_rms * scaled);
    if (row->tally.loss_rms * scaled > most) {
      most = row->tally.loss_rms * scaled;
      spread.where = where(*row);
    }
  }
  if (bound.cells == 0) return;
  spread.cells = bound.cells;
  spread.measured = most / least;
  tests.push_back(bound);
  if (spread.cells > 1) tests.push_back(spread);
}

/// The first distance at which one verdict in ten is wrong, over 1 / sqrt(u). Infinite where there is none.
void add_threshold(std::vector<LadderTest>& tests, const std::vector<ExtremeRow>& rows, std::size_t precision) {
  const double threshold = 1 / std::sqrt(all_precisions()[precision].unit);
  const std::vector<const ExtremeRow*> along = foil_rows(rows, precision);
  if (along.empty() || along.front()->place.value > threshold / 10) return;
  if (std::any_of(along.begin(), along.end(), [](const ExtremeRow* row) { return row->tally.queries < 5; })) return;
  const bool reached = along.back()->place.value >= 10 * threshold;
  LadderTest test{.what = "textbook_verdicts",
                  .precision = precision,
                  .cells = static_cast<std::int64_t>(along.size()),
                  .measured = std::numeric_limits<double>::infinity(),
                  .least = 0.1,
                  .most = reached ? 10 : std::numeric_limits<double>::infinity()};
  for (const ExtremeRow* row : along) {
    if (10 * row->tally.far_wrong < row->tally.queries) continue;
    test.measured = row->place.value / threshold;
    test.where = where(*row);
    break;
  }
  tests.push_back(test);
}

}  // namespace

std::vector<LadderTest> ladder_tests(const std::vector<ExtremeRow>& rows, const LossTheory& theory) {
  std::vector<LadderTest> tests;
  for (const std::size_t p : precisions_of(rows)) {
    add_contract(tests, rows, p, std::string(forward), 4, [](const ExtremeTally& t) { return t.forward_max; });
    add_contract(tests, rows, p, "closed_form_backward", 4, [](const ExtremeTally& t) { return t.backward_max; });
    add_contract(tests, rows, p, "closed_form_verdicts", break_verdict,
                 [](const ExtremeTally& t) { return t.worst_wrong; });
    add_contract(tests, rows, p, "closed_form_no_answer", 0,
                 [](const ExtremeTally& t) { return static_cast<double>(t.gave_up + t.invalid); });
    add_loss(tests, rows, p, theory);
    add_threshold(tests, rows, p);
  }
  return tests;
}

}  // namespace thinwall
