#include <thinwall/experiments/extremes/line.hpp>

#include <algorithm>

#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

double contact_share(const Place& place) {
  if (place.axis == ExtremeAxis::distance) return 1 / place.value;
  if (place.axis == ExtremeAxis::thickness) return place.value / extreme_at(place).distance;
  return 1;
}

bool matches(const ExtremeLine& line, const LineFilter& f) {
  return line.precision == f.precision && (f.place == nullptr || line.place == *f.place) &&
         (!f.four_pairs || line.pair->every_method) && (f.method.empty() || line.tally.method == f.method);
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

std::vector<std::string_view> methods_of(const std::vector<ExtremeLine>& lines, std::size_t precision) {
  std::vector<std::string_view> found;
  for (const std::string_view name : extreme_method_names()) {
    const LineFilter filter = {.method = name, .precision = precision};
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

double nanoseconds_of(const std::vector<ExtremeLine>& lines, std::string_view method, std::size_t precision) {
  constexpr std::string_view served_by_all = "sphere_aabb";
  const LineFilter filter = {.method = method, .precision = precision};
  for (const bool any_pair : {false, true}) {
    const ExtremePair* pair = nullptr;
    std::vector<double> times;
    for (const ExtremeLine& line : lines) {
      if (!matches(line, filter) || line.tally.queries == 0) continue;
      if (!any_pair && line.pair->name != served_by_all) continue;
      if (pair == nullptr) pair = line.pair;
      if (line.pair == pair) times.push_back(line.tally.nanoseconds);
    }
    if (!times.empty()) return median(times);
  }
  return 0;
}

}  // namespace thinwall
