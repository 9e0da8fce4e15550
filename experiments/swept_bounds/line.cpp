#include <thinwall/experiments/swept_bounds/line.hpp>

#include <algorithm>

namespace thinwall {

namespace {

void add(SweepTally& sum, const SweepTally& t) {
  sum.shots += t.shots;
  sum.touching += t.touching;
  sum.reported += t.reported;
  sum.false_hits += t.false_hits;
  sum.grazing += t.grazing;
  sum.missed += t.missed;
}

}  // namespace

std::vector<SweepPair> serving_pairs(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds) {
  std::vector<SweepPair> pairs;
  for (const Sweep& sweep : sweeps) {
    for (const SweptBound& bound : bounds) {
      if (bound.serves(sweep.form)) pairs.push_back({sweep, &bound});
    }
  }
  return pairs;
}

SweepLine make_line(const SweepPair& pair, const SweepTally& tally) {
  return {pair.sweep, pair.bound->name, pair.bound->makes_volume,
          sweep_theory(pair.bound->body(pair.sweep), pair.sweep), tally};
}

std::optional<double> false_fraction(const SweepTally& tally) {
  if (tally.reported == 0) return std::nullopt;
  return static_cast<double>(tally.false_hits) / static_cast<double>(tally.reported);
}

std::vector<CellCount> counts_of(const std::vector<SweepLine>& lines) {
  std::vector<CellCount> counts;
  for (const SweepLine& l : lines) {
    const SweepTally& t = l.tally;
    counts.push_back({l.bound, "touching", t.shots, t.touching, l.theory.touching});
    counts.push_back({l.bound, "reported", t.shots, t.reported, l.theory.reported()});
    counts.push_back({l.bound, "false", t.shots, t.false_hits, l.theory.false_hits});
    counts.push_back({l.bound, "missed", t.shots + t.grazing, t.missed, 0});
  }
  return counts;
}

std::vector<SweepTotal> totals(const std::vector<SweepLine>& lines) {
  std::vector<SweepTotal> all;
  for (const SweepLine& l : lines) {
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const SweepTotal& t) { return t.form == l.sweep.form && t.bound == l.bound; });
    if (found == all.end()) {
      all.push_back({.form = l.sweep.form, .bound = l.bound});
      found = all.end() - 1;
    }
    ++found->cells;
    add(found->tally, l.tally);
    found->least_false = std::min(found->least_false, l.theory.false_fraction);
    found->most_false = std::max(found->most_false, l.theory.false_fraction);
  }
  std::stable_sort(all.begin(), all.end(), [](const SweepTotal& a, const SweepTotal& b) { return a.form < b.form; });
  return all;
}

}  // namespace thinwall
