#include <thinwall/experiments/work_precision/model.hpp>

#include <algorithm>
#include <functional>

#include <thinwall/swept/methods/closed_form.hpp>
#include <thinwall/swept/methods/conservative_advancement.hpp>
#include <thinwall/swept/methods/speculative.hpp>

namespace thinwall {

namespace {

bool is_fine(const Racer& racer, std::string_view scalar) {
  return finishes(racer) && racer.time.p99 <= fine_error(scalar);
}

}  // namespace

Measured nanoseconds(const Racer& racer) { return median_of_rounds(racer.nanoseconds); }

Measured slowdown(const Racer& racer, const Racer& other) {
  std::vector<double> ratios(racer.nanoseconds.size());
  std::ranges::transform(racer.nanoseconds, other.nanoseconds, ratios.begin(), std::divides());
  return median_of_rounds(ratios);
}

double fine_error(std::string_view scalar) { return scalar == "float" ? 1e-6 : 1e-12; }

bool finishes(const Racer& racer) { return racer.missed == 0 && racer.gave_up == 0; }

std::vector<const Racer*> pareto_front(const Heat& heat) {
  std::vector<const Racer*> all;
  for (const Racer& racer : heat.racers) {
    if (finishes(racer) && racer.touching > 0) all.push_back(&racer);
  }
  std::sort(all.begin(), all.end(), [](const Racer* a, const Racer* b) { return a->time.p99 < b->time.p99; });
  std::vector<const Racer*> front;
  for (const Racer* racer : all) {
    if (front.empty() || median(racer->nanoseconds) < median(front.back()->nanoseconds)) front.push_back(racer);
  }
  return front;
}

std::vector<const Racer*> one_a_method(const Heat& heat) {
  const auto better = [&](const Racer* a, const Racer* b) {
    const bool a_fine = is_fine(*a, heat.scalar), b_fine = is_fine(*b, heat.scalar);
    if (a_fine != b_fine) return a_fine;
    if (a_fine) return false;  // the first is the roughest
    if (finishes(*a) != finishes(*b)) return finishes(*a);
    return finishes(*a) ? a->time.p99 < b->time.p99 : a->missed + a->gave_up < b->missed + b->gave_up;
  };
  std::vector<const Racer*> chosen;
  for (const Group<Racer>& settings : group_by(heat.racers, &Racer::method))
    chosen.push_back(*std::ranges::min_element(settings, better));
  return chosen;
}

std::optional<double> false_share(const std::vector<Heat>& heats, const Heat& heat, const Racer& racer) {
  for (const Heat& other : heats) {
    if (other.set != heat.set || other.scalar != heat.scalar || other.kind != QueryClass::miss) continue;
    for (const Racer& r : other.racers) {
      if (r.method != racer.method || r.setting != racer.setting || r.queries == 0) continue;
      return static_cast<double>(r.false_hits) / static_cast<double>(r.queries);
    }
  }
  return {};
}

const Racer* closed_form_of(const Heat& heat) {
  const auto found = std::ranges::find(heat.racers, ClosedForm<double>::name, &Racer::method);
  return found == heat.racers.end() ? nullptr : &*found;
}

std::vector<const Racer*> fine_and_faster(const Heat& heat) {
  std::vector<const Racer*> faster;
  const Racer* exact = closed_form_of(heat);
  if (exact == nullptr) return faster;
  for (const Racer& racer : heat.racers) {
    if (&racer == exact || !is_fine(racer, heat.scalar) || racer.touching == 0) continue;
    if (slowdown(racer, *exact).interval.upper < 1) faster.push_back(&racer);
  }
  return faster;
}

bool keeps_contract(const Heat& heat) {
  if (heat.set->turns) {
    return std::ranges::all_of(heat.racers, [](const Racer& r) {
      const bool claims_it = r.method == ConservativeAdvancement<double>::name || r.method == Speculative<double>::name;
      return !claims_it || (r.missed == 0 && !(r.latest > 0));
    });
  }
  const Racer* exact = closed_form_of(heat);
  return exact == nullptr || (finishes(*exact) && exact->false_hits == 0 && exact->forward <= 4);
}

}  // namespace thinwall
