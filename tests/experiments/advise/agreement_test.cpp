/// Advice and experiment agree: the configuration that the advice comes with is fired, and every method is counted within
/// what its formula allows.

#include <gtest/gtest.h>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/swept/certified.hpp>

#include "experiments/advise/given_costs.hpp"
#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

constexpr std::int64_t shots = 2000;

/// What the experiment found of a method, at the wish's own cell.
struct Found {
  std::int64_t tunneled;
  double latest;  ///< [m]
};

class Fired {
 public:
  explicit Fired(const Wish& wish)
      : wish_(wish),
        outcome_(outcome_of(
            *run_of(thin_wall_experiment(), check_config(wish, candidates(wish)), {.seed = 3, .trials = shots}))) {}

  bool self_test_passed() const { return outcome_.self_test_passed; }

  Found found(const std::string& method) const {
    const Table& table = table_of(outcome_, "cells");
    for (std::size_t row = table.rows.size(); row-- > 0;) {  // the bullet of the textbook comes first
      if (value_of(table, row, "method") != Value(method)) continue;
      EXPECT_EQ(value_of(table, row, "speed"), Value(wish_.cell.speed));
      EXPECT_EQ(value_of(table, row, "step"), Value(wish_.cell.step));
      EXPECT_EQ(value_of(table, row, "radius"), Value(wish_.cell.radius));
      EXPECT_EQ(value_of(table, row, "thickness"), Value(wish_.cell.thickness));
      EXPECT_EQ(value_of(table, row, "angle_deg"), Value(wish_.cell.angle_deg));
      EXPECT_EQ(value_of(table, row, "wall"), Value(std::string("infinite")));
      EXPECT_EQ(value_of(table, row, "shots"), Value(shots));
      const Value& latest = value_of(table, row, "lateness_max");
      return {std::get<std::int64_t>(value_of(table, row, "tunneled")),
              std::holds_alternative<double>(latest) ? std::get<double>(latest) : 0};
    }
    throw std::runtime_error(method + " was not fired");
  }

 private:
  Wish wish_;
  Outcome outcome_;
};

/// The counts that a chance allows in all but one run in 10 000.
Interval counts_of(double chance) {
  if (chance <= no_chance) return {0, 0};
  if (chance == 1) return {double{shots}, double{shots}};
  return binomial_range(shots, chance, 0.9999);
}

/// The experiment rounds the wall up and the step down by one part in 2^20, and times are known to rounding.
double rounded_up(double length, const Cell& cell) { return length + 0x1p-20 * (length + 1e-6 * step_length(cell)); }

void expect_agreement(const Wish& wish) {
  SCOPED_TRACE(cell_factors().key(wish.cell));
  const Fired fired(wish);
  EXPECT_TRUE(fired.self_test_passed());
  const Advice advice = advice_on(wish);
  for (const AdviceRow& row : advice.rows) {
    if (!row.method.fired || !row.theory.probability) continue;
    const Found found = fired.found(row.method.name);
    EXPECT_TRUE(counts_of(*row.theory.probability).contains(static_cast<double>(found.tunneled)))
        << row.method.name << ": " << found.tunneled << " of " << shots << ", theory " << *row.theory.probability;
    if (const auto latest = row.theory.largest_lateness()) {
      EXPECT_LE(found.latest, rounded_up(*latest, wish.cell)) << row.method.name;
    }
    if (!row.meets) continue;
    EXPECT_LE(static_cast<double>(found.tunneled), counts_of(wish.miss).upper) << row.method.name;
    if (wish.late) {
      EXPECT_LE(found.latest, rounded_up(*wish.late, wish.cell)) << row.method.name;
    }
  }
}

TEST(AdviceAgreement, bullet_of_the_textbook) { expect_agreement(bullet_wish); }

TEST(AdviceAgreement, slanted_and_fast) {
  Wish wish = bullet_wish;
  wish.cell = {700, 1.0 / 240, 0.003, 0.02, 35, Wall::infinite, 0};
  wish.miss = 0.95;
  expect_agreement(wish);
}

TEST(AdviceAgreement, a_point_and_a_wall) {
  Wish wish = bullet_wish;
  wish.cell.radius = 0;
  wish.miss = 0.5;
  expect_agreement(wish);
}

TEST(AdviceAgreement, a_sheet_and_a_bound_on_lateness) {
  Wish wish = {.cell = {50, 0.01, 0.05, 0, 70, Wall::infinite, 0}, .miss = 0.2, .late = 0.1};
  expect_agreement(wish);
}

TEST(AdviceAgreement, a_step_shorter_than_the_contact) {
  Wish wish = bullet_wish;
  wish.cell.step = 0.001;
  expect_agreement(wish);
}

/// At the longest step that is called safe the count is within the wish, and a tenth beyond it is not.
TEST(AdviceAgreement, the_longest_step_is_safe_and_a_longer_one_is_not) {
  for (const double miss : {0.0, 0.4}) {
    Wish wish = bullet_wish;
    wish.miss = miss;
    wish.cell.step = *longest_step(wish, row_of(advice_on(wish), "end_of_step").method.theory);
    EXPECT_TRUE(counts_of(miss).contains(static_cast<double>(Fired(wish).found("end_of_step").tunneled))) << miss;
    wish.cell.step *= 1.1;
    EXPECT_GT(static_cast<double>(Fired(wish).found("end_of_step").tunneled), counts_of(miss).upper) << miss;
  }
}

/// What docs/advise.md says of a ball that is in contact when it starts, uniformly along its path in the wall.
TEST(AdviceAgreement, a_start_in_contact_is_lost_on_tested_poses_alone) {
  Cell cell = bullet;
  cell.step = 0.0025;  // half the contact: none that starts before the wall is missed
  const Target aimed = target(cell);
  const std::vector<std::string_view> names = method_names();
  const std::vector<std::string> methods(names.begin(), names.end()), scalars = {"double"};
  for (const ThinWallMethod& method : thin_wall_methods(methods, std::vector<std::int64_t>{2}, scalars)) {
    Tally tally;
    for (std::uint64_t i = 0; i < shots; ++i) {
      const double share = uniform(random_words({7, 7}, i, 0)[0]);
      const Vec3<double> start = {-aimed.half_extents[0] - aimed.radius + share * slab_chord(cell), 0, 0};
      method.fire(aimed, start, tally);
    }
    const double lost = method.poses_per_step > 0 ? 0.5 / method.poses_per_step : 0;
    EXPECT_TRUE(counts_of(lost).contains(static_cast<double>(tally.tunneled))) << method.name << ": " << tally.tunneled;
  }
}

/// The certified answers are not in the method list and so not in the experiment: its shots are put to them here.
TEST(AdviceAgreement, certified_answers_miss_no_shot_and_are_never_late) {
  const Target aimed = target(bullet);
  const auto wall = at_rest(Aabb<double>{Vec3<double>::Zero(), aimed.half_extents});
  const Theory theory = row_of(advice_on(bullet_wish), "certified").theory;
  EXPECT_EQ(*theory.probability, 0);
  EXPECT_EQ(*theory.largest_lateness(), 0);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec3<double> start = random_start(aimed, random_stream(bullet, 5), i);
    const Moving ball{Sphere<double>{start, aimed.radius}, aimed.displacement};
    const CertifiedToi toi = certified_time_of_impact(ball, wall);
    ASSERT_EQ(toi.verdict, ToiStatus::hit);
    const double contact = path_to_contact(aimed, start) / aimed.step_length;
    EXPECT_LE(toi.lower, contact * (1 + 1e-15));
    EXPECT_LE(contact - toi.lower, theory.widest / aimed.step_length + 1e-15);
  }
}

}  // namespace
}  // namespace thinwall
