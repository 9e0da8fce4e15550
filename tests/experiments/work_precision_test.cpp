/// The races: what each method's errors must be, whatever its times are.

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include <thinwall/swept/methods.hpp>

#include "experiments/work_precision_run.hpp"

namespace thinwall {
namespace {

/// All racers of the small races, run once.
const std::vector<std::vector<Racer>>& races() {
  static const std::vector<std::vector<Racer>> all = [] {
    std::vector<std::vector<Racer>> parsed;
    for (const std::string& line : run_races(few_races)) parsed.push_back(racers_from_line(line));
    return parsed;
  }();
  return all;
}

constexpr double rounding = 1e-6;  // [1] of a step: above what float can resolve

TEST(WorkPrecision, has_a_race_for_every_set_class_and_scalar) {
  const auto units = race_run(few_races)->units();
  EXPECT_EQ(units.size(), 2u * 3 * 2);
  std::set<std::string> keys;
  for (const Unit& unit : units) keys.insert(unit.key);
  EXPECT_EQ(keys.size(), units.size());
}

TEST(WorkPrecision, every_method_of_the_list_that_serves_the_pair_takes_part_at_every_setting) {
  std::map<std::string, int> settings;
  for (const Racer& r : races()[0]) ++settings[r.method];  // a ball and a wall, in double
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    constexpr bool served = serves<Method, Sphere<double>, Aabb<double>>;
    EXPECT_EQ(settings.contains(std::string(Method::name)), served) << Method::name;
  });
  EXPECT_EQ(settings.at("conservative_advancement"), 2);
  EXPECT_EQ(settings.at("closed_form"), 1);
}

TEST(WorkPrecision, classes_are_what_they_say) {
  for (std::size_t i = 0; i < races().size(); ++i) {
    const std::int64_t touching = races()[i].front().touching;
    if (i % 3 == 0) {
      EXPECT_EQ(touching, 40) << "hits";
    } else if (i % 3 == 1) {
      EXPECT_EQ(touching, 0) << "misses";
    } else {
      EXPECT_TRUE(touching > 5 && touching < 35) << touching << " of 40 grazes";
    }
  }
}

TEST(WorkPrecision, methods_err_as_they_claim) {
  for (const auto& racers : races()) {
    for (const Racer& r : racers) {
      SCOPED_TRACE(r.method + " " + r.setting);
      const bool never_late =
          r.method == "conservative_advancement" || r.method == "inclusion" || r.method == "speculative";
      if (never_late || r.method == "bisection" || r.method == "closed_form" || r.method == "swept_volume_ray") {
        EXPECT_EQ(r.missed, 0);
      }
      if (r.touching == 0 || !finishes(r)) continue;
      if (never_late) {
        EXPECT_LE(r.latest, 0);
      }
      if (r.method == "bisection") {
        EXPECT_LE(r.time.max, *r.option + rounding);
      }
      if (r.method == "inclusion") {
        EXPECT_LE(r.time.median, *r.option) << "the tolerance over the cosine of incidence bounds it only";
      }
      if (r.method == "closed_form") {
        EXPECT_LE(r.forward, 4);
        EXPECT_LE(r.time.p99, 1e-4);
      }
      EXPECT_LE(r.time.median, r.time.p99);
      EXPECT_LE(r.time.p99, r.time.max);
    }
  }
}

/// The poses of n substeps are 1/n apart, so that what is seen is seen that late at most.
TEST(WorkPrecision, substeps_are_late_by_up_to_one_of_them) {
  double latest = 0;
  for (const auto& racers : races()) {
    for (const Racer& r : racers) {
      if (r.method != "substeps" || r.touching == r.missed) continue;
      latest = std::max(latest, r.latest);
      EXPECT_GE(r.earliest, -rounding);
    }
  }
  EXPECT_LE(latest, 1.0 / 8 + rounding);
  EXPECT_GT(latest, 1.0 / 16);
}

TEST(WorkPrecision, a_missed_contact_is_an_infinite_error) {
  for (const Racer& r : races()[0]) {
    if (r.method != "end_of_step") continue;
    EXPECT_GT(r.missed, 20);
    EXPECT_TRUE(std::isinf(r.time.median));
    EXPECT_FALSE(finishes(r));
    return;
  }
  FAIL() << "nobody looks at the end of the step alone";
}

TEST(WorkPrecision, errors_are_the_same_in_every_run_and_read_back_as_written) {
  const std::vector<std::string> again = run_races(few_races);
  for (std::size_t i = 0; i < again.size(); ++i) {
    std::vector<Racer> first = races()[i], second = racers_from_line(again[i]);
    EXPECT_EQ(to_line(second), again[i]);
    for (auto* racers : {&first, &second}) {
      for (Racer& r : *racers) {
        EXPECT_EQ(r.nanoseconds.size(), 3u);
        for (const double t : r.nanoseconds) EXPECT_GT(t, 0);
        r.nanoseconds.clear();
      }
    }
    EXPECT_EQ(to_line(first), to_line(second));
  }
}

}  // namespace
}  // namespace thinwall
