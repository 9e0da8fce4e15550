#include <thinwall/experiments/crossing_bullets/rules.hpp>

#include <algorithm>

#include <thinwall/discrete/sphere.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/swept_volume.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

using Ball = Sphere<double>;

/// Both are swept over the whole step, and what they sweep is tested: no time is asked for, and none given.
struct SweptOverlap {
  static constexpr std::string_view name = "swept_overlap";
};

double clamped(double share) { return std::max(0.0, share); }

template <class Method> Expected expected_of(const Method&, const CrossingTheory&) { return {}; }
Expected expected_of(const SweptOverlap&, const CrossingTheory& t) {
  return {t.touch + t.false_overlap, 0, t.false_overlap};
}
Expected expected_of(const EndOfStep<double>&, const CrossingTheory& t) {
  return {t.touch_at_end, clamped(t.touch - t.touch_at_end), 0};
}
Expected expected_of(const SweepThenConfirm<double>&, const CrossingTheory& t) {
  return {t.confirmed.share, clamped(t.touch - t.confirmed.share), 0};
}
Expected expected_of(const ClosedForm<double>&, const CrossingTheory& t) { return {t.touch, 0, 0}; }

template <class Method> Toi<double> answer_of(const Method& method, const Encounter& e) {
  return time_of_impact(method, e.faster, e.slower);
}
Toi<double> answer_of(const SweptOverlap&, const Encounter& e) {
  return {overlaps(swept_volume(e.faster), swept_volume(e.slower)) ? ToiStatus::hit : ToiStatus::apart, 1};
}

template <class Method> void note_cause(const Method&, const Encounter&, const TrueContact&, CrossingTally&) {}
void note_cause(const SweepThenConfirm<double>&, const Encounter& e, const TrueContact& truth, CrossingTally& tally) {
  const auto entry = first_shoots(e.faster, e.slower) ? enters_track<double>(e.faster, e.slower)
                                                      : enters_track<double>(e.slower, e.faster);
  if (!entry) {
    ++tally.beside;
  } else if (entry->t == 0) {
    ++tally.inside;
  } else if (static_cast<long double>(entry->t) < truth.time) {
    ++tally.early;
  } else {
    ++tally.late;
  }
}

void note_time(const Encounter& e, const TrueContact& truth, double time, CrossingTally& tally) {
  const double gap = gap_at(e, time);
  tally.widest = std::max(tally.widest, gap);
  tally.deepest = std::min(tally.deepest, gap);
  if (!truth.touches) return;
  const double late = static_cast<double>(static_cast<long double>(time) - truth.time);
  tally.lateness.add(late);
  tally.latest = std::max(tally.latest, late);
  tally.earliest = std::min(tally.earliest, late);
}

template <class Method> void put(const Method& method, const Encounter& e, CrossingTally& tally) {
  const TrueContact truth = true_contact(e);
  const Toi<double> toi = answer_of(method, e);
  ++tally.shots;
  tally.touching += truth.touches ? 1 : 0;
  tally.evaluations += toi.evaluations;
  const bool says_so = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
  tally.undecided += says_so || toi.status == ToiStatus::apart ? 0 : 1;
  if (says_so && !truth.touches) ++tally.false_hits;
  if (!says_so && truth.touches) {
    ++tally.missed;
    note_cause(method, e, truth, tally);
  }
  if (!std::is_same_v<Method, SweptOverlap> && says_so) note_time(e, truth, toi.time, tally);
}

template <class Method> CrossingRule rule_of(const Method& method) {
  return {std::string(method.name), [method](const Encounter& e, CrossingTally& tally) { put(method, e, tally); },
          [method](const CrossingTheory& theory) { return expected_of(method, theory); }};
}

}  // namespace

std::vector<CrossingRule> all_crossing_rules() {
  std::vector<CrossingRule> all = {rule_of(SweptOverlap{})};
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Ball, Ball>) all.push_back(rule_of(Method{}));
  });
  return all;
}

CrossingTally ask_all(const CrossingRule& rule, const Crossing& c, std::uint64_t seed, std::int64_t shots) {
  const RandomStream stream = crossing_factors.stream(c, seed);
  CrossingTally tally;
  for (std::int64_t i = 0; i < shots; ++i) {
    rule.ask(random_encounter(c, stream, static_cast<std::uint64_t>(i)), tally);
  }
  return tally;
}

}  // namespace thinwall
