#include <thinwall/experiments/extremes/line.hpp>

#include <algorithm>

#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

double contact_share(const Place& place) {
  if (place.axis == ExtremeAxis::distance) return 1 / place.value;
  if (place.axis == ExtremeAxis::thickness) return place.value / extreme_at(place).distance;
  return 1;
}

double grazing_share(const Place& place) { return place.axis == ExtremeAxis::grazing ? place.value : 1; }

namespace {

bool in(const ExtremeLine& line, PairSet pairs) {
  if (pairs == PairSet::all) return true;
  return line.pair->every_method && (pairs == PairSet::four || line.pair->rounded == (pairs == PairSet::rounded));
}

}  // namespace

bool matches(const ExtremeLine& line, const LineFilter& f) {
  return line.precision == f.precision && (f.place == nullptr || line.place == *f.place) && in(line, f.pairs) &&
         (f.method.empty() || line.tally.method == f.method);
}

CellSum sum_of(const std::vector<ExtremeLine>& lines, const LineFilter& filter) {
  CellSum sum;
  for (const ExtremeLine& line : lines) {
    if (!matches(line, filter)) continue;
    const ExtremeTally& t = line.tally;
    sum.queries += t.queries;
    sum.touching += t.touching;
    sum.changed += t.changed;
    sum.far_wrong += t.far_wrong;
    sum.gave_up += t.gave_up;
    sum.invalid += t.invalid;
    sum.timed += t.timed;
    sum.forward_max = std::max(sum.forward_max, t.forward_max);
    sum.backward_max = std::max(sum.backward_max, t.backward_max);
    sum.worst_wrong = std::max(sum.worst_wrong, t.worst_wrong);
  }
  return sum;
}

std::vector<std::size_t> precisions_of(const std::vector<ExtremeLine>& lines) {
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < precision_count; ++p) {
    if (std::any_of(lines.begin(), lines.end(), [&](const ExtremeLine& l) { return l.precision == p; })) {
      found.push_back(p);
    }
  }
  return found;
}

std::vector<std::string_view> methods_of(const std::vector<ExtremeLine>& lines, std::size_t precision, PairSet pairs) {
  std::vector<std::string_view> found;
  for (const std::string_view name : extreme_method_names()) {
    const LineFilter filter = {.method = name, .precision = precision, .pairs = pairs};
    if (std::any_of(lines.begin(), lines.end(), [&](const ExtremeLine& l) { return matches(l, filter); })) {
      found.push_back(name);
    }
  }
  return found;
}

std::vector<Place> places_of(const std::vector<ExtremeLine>& lines) {
  std::vector<Place> places;
  for (const ExtremeLine& line : lines) {
    if (places.empty() || places.back() != line.place) places.push_back(line.place);
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.axis != b.axis ? a.axis < b.axis : a.value < b.value; });
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

double nanoseconds_of(const std::vector<ExtremeLine>& lines, std::string_view method, std::size_t precision,
                      PairSet pairs) {
  std::vector<double> times;
  for (const ExtremeLine& line : lines) {
    if (line.tally.queries == 0) continue;
    if (matches(line, {.method = method, .precision = precision, .pairs = pairs}))
      times.push_back(line.tally.nanoseconds);
  }
  return times.empty() ? 0 : median(times);
}

}  // namespace thinwall
