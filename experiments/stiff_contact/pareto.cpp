#include <thinwall/experiments/stiff_contact/pareto.hpp>

#include <algorithm>

#include <thinwall/experiments/stiff_contact/tables.hpp>

namespace thinwall {

namespace {

constexpr RandomStream resampling = {0, 0x7374696666};  // any constant: the interval depends on the times alone

bool all_returned(const StiffRacer& r) { return r.tally.returned > 0 && r.tally.returned == r.tally.bounces(); }

}  // namespace

BounceTime bounce_time(const StiffRacer& racer) {
  return {median(racer.nanoseconds), bootstrap_median(racer.nanoseconds, resampling)};
}

std::vector<const StiffRacer*> stiff_front(const std::vector<StiffRacer>& racers, double ratio) {
  std::vector<const StiffRacer*> all;
  for (const StiffRacer& r : racers) {
    if (r.contact.damping_ratio == ratio && all_returned(r)) all.push_back(&r);
  }
  std::stable_sort(all.begin(), all.end(), [](const StiffRacer* a, const StiffRacer* b) {
    return a->tally.square_error < b->tally.square_error;
  });
  std::vector<const StiffRacer*> front;
  for (const StiffRacer* r : all) {
    if (front.empty() || median(r->nanoseconds) < median(front.back()->nanoseconds)) front.push_back(r);
  }
  return front;
}

const StiffRacer* cheapest(const std::vector<StiffRacer>& racers, double ratio, Scheme scheme, Detection detection,
                           double error) {
  const StiffRacer* best = nullptr;
  for (const StiffRacer& r : racers) {
    const PenaltyContact& c = r.contact;
    if (c.damping_ratio != ratio || c.scheme != scheme || c.detection != detection || !all_returned(r)) continue;
    if (r.tally.rms_error() > error) continue;
    if (best == nullptr || median(r.nanoseconds) < median(best->nanoseconds)) best = &r;
  }
  return best;
}

Table race_times_table(const std::vector<StiffRacer>& racers) {
  using enum ColumnType;
  Table table = {"timings", "Time a bounce, on this machine, with every core at work: medians over rounds.", {}, {}};
  table.is_timing = true;
  table.columns = {
      {"scheme", text, "", "How a step is computed."},
      {"detection", text, "", "discrete: at the poses; toi_split: at the time of impact."},
      {"damping_ratio", number, "1", "damping / (2 sqrt(stiffness mass))."},
      {"step", number, "1/omega", "Time step."},
      {"speed_error", number, "1", "Root mean square error of speed out over speed in."},
      {"bounce_ns", number, "ns", "Median time of a bounce, from before contact until it is seen to leave."},
      {"lower_ns", number, "ns", "Lower end of its 95 % bootstrap interval."},
      {"upper_ns", number, "ns", "Upper end of it."}};
  for (const StiffRacer& r : racers) {
    const BounceTime time = bounce_time(r);
    table.rows.push_back({std::string(name(r.contact.scheme)), std::string(name(r.contact.detection)),
                          r.contact.damping_ratio, r.contact.step,
                          r.tally.returned > 0 ? Value(r.tally.rms_error()) : Value(), time.median, time.interval.lower,
                          time.interval.upper});
  }
  return table;
}

}  // namespace thinwall
