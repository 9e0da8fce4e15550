/// The stiff contact's answers, and whether a wrong theory would be noticed.
#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "experiments/stiff_contact_run.hpp"

namespace thinwall {
namespace {

struct Measured {
  StiffPlan plan = stiff_plan();
  std::vector<LimitLine> limits;
  std::vector<ContactLine> bounces;
};

Measured measured() {
  Measured m;
  for (const LimitCell& cell : limit_cells(m.plan)) {
    m.limits.push_back(limit_line(m.plan, cell, limit_result(m.plan, cell)));
  }
  for (const BounceSeries& series : bounce_series(m.plan)) {
    for (const ContactLine& l : bounce_lines(m.plan, series, bounce_result(m.plan, series))) m.bounces.push_back(l);
  }
  return m;
}

bool passes(const Measured& m) { return all_passed(stiff_tests(m.plan, m.limits, m.bounces)); }

bool passes_with_limit(Measured m, Scheme scheme, const std::function<double(double ratio, double limit)>& wrong) {
  for (LimitLine& line : m.limits) {
    if (line.cell.scheme == scheme) line.theory = wrong(line.cell.ratio, line.theory.value_or(0));
  }
  return passes(m);
}

TEST(StiffContact, agrees_with_theory) {
  const Outcome outcome = stiff_outcome();
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  for (const std::vector<Value>& row : table_of(outcome, "self_test").rows) {
    EXPECT_GT(std::get<std::int64_t>(row[1]), 0) << std::get<std::string>(row[0]);  // no claim is empty
  }
}

TEST(StiffContact, fails_a_wrong_limit) {
  const Measured m = measured();
  EXPECT_TRUE(passes(m));
  const auto as_it_is = [](double, double limit) { return limit; };
  EXPECT_TRUE(passes_with_limit(m, Scheme::semi_implicit, as_it_is));
  EXPECT_FALSE(passes_with_limit(m, Scheme::semi_implicit, [](double, double limit) { return limit * 1.001; }));
  EXPECT_FALSE(passes_with_limit(m, Scheme::semi_implicit, [](double, double) { return 2.0; }));  // forgets damping
  EXPECT_FALSE(passes_with_limit(m, Scheme::semi_implicit, [](double ratio, double) {  // takes damping as implicit
    return 2 * (std::hypot(1.0, ratio) + ratio);
  }));
  EXPECT_FALSE(passes_with_limit(m, Scheme::explicit_euler, [](double ratio, double) {  // forgets overdamping
    return 2 * ratio;
  }));
  EXPECT_FALSE(passes_with_limit(m, Scheme::implicit_euler, [](double, double) { return 1e5; }));
}

TEST(StiffContact, fails_a_wrong_bounce) {
  const Measured m = measured();
  const auto passes_with = [&](const std::function<void(ContactLine&)>& change) {
    Measured changed = m;
    for (ContactLine& line : changed.bounces) change(line);
    return passes(changed);
  };
  EXPECT_TRUE(passes_with([](ContactLine&) {}));
  EXPECT_FALSE(passes_with([](ContactLine& l) { l.tally.fastest *= 1.01; }));
  EXPECT_FALSE(passes_with([](ContactLine& l) { l.tally.slowest *= 0.99; }));
  EXPECT_FALSE(passes_with([](ContactLine& l) {  // an implicit step that gains
    if (l.contact.scheme == Scheme::implicit_euler) l.tally.fastest = 1.001;
  }));
  EXPECT_FALSE(passes_with([](ContactLine& l) {  // an explicit one that loses
    if (l.contact.scheme == Scheme::explicit_euler) l.tally.slowest = 0.999;
  }));
  EXPECT_FALSE(passes_with([](ContactLine& l) {  // a split that matters
    if (l.contact.detection == Detection::toi_split) l.tally.fastest *= 1 + 1e-6;
  }));
  EXPECT_FALSE(passes_with([](ContactLine& l) { l.tally.escaped = 0; }));  // nobody tunnels
  EXPECT_FALSE(passes_with([](ContactLine& l) { l.tally.escaped = 1; }));  // somebody always does
}

TEST(StiffContact, says_what_is_stable_and_what_a_bounce_does) {
  const std::string answer = stiff_outcome().answer;
  for (const char* part : {"in 45 of 45 springs", "at h omega = 1.9 a semi-implicit bounce leaves with 0.3", "to 2.",
                           "because at first touch a spring does not push yet", "and 0.0 %."}) {
    EXPECT_NE(answer.find(part), std::string::npos) << part << "\n" << answer;
  }
}

TEST(StiffContact, no_table_has_a_nan) {
  for (const Table& t : stiff_outcome().tables) {
    for (const std::vector<Value>& row : t.rows) {
      for (const Value& value : row) {
        if (const double* number = std::get_if<double>(&value)) {
          EXPECT_TRUE(std::isfinite(*number)) << t.name;
        }
      }
    }
  }
}

TEST(StiffContact, an_unstable_step_is_reported_with_the_step_where_it_blew_up) {
  const Table map = table_of(stiff_outcome(), "stability");
  std::size_t unstable = 0;
  for (std::size_t row = 0; row < map.rows.size(); ++row) {
    const bool blown = std::get<std::string>(value_of(map, row, "verdict")) == "unstable";
    unstable += blown ? 1U : 0U;
    if (blown) {
      EXPECT_GT(std::get<std::int64_t>(value_of(map, row, "blow_up_step")), 0);
    }
  }
  EXPECT_GT(unstable, 20U);
  EXPECT_LT(unstable, map.rows.size());
}

bool is_race(const Unit& unit) { return unit.key.starts_with("race"); }

TEST(StiffContact, does_not_depend_on_the_order_of_the_units) {
  const auto run = stiff_run(few_contacts);
  std::vector<Unit> units = run->units();
  std::erase_if(units, is_race);  // these hold times
  const std::vector<std::string> forward = results_of(units);
  std::reverse(units.begin(), units.end());
  std::vector<std::string> backward = results_of(units);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

/// What the manifest hashes is the same in every run; what is not, says so.
TEST(StiffContact, only_what_holds_times_differs_from_run_to_run) {
  const Outcome first = stiff_outcome(), second = stiff_outcome();
  ASSERT_EQ(first.tables.size(), second.tables.size());
  std::size_t timings = 0;
  for (std::size_t i = 0; i < first.tables.size(); ++i) {
    timings += first.tables[i].is_timing ? 1U : 0U;
    if (!first.tables[i].is_timing) {
      EXPECT_EQ(first.tables[i].rows, second.tables[i].rows) << first.tables[i].name;
    }
  }
  EXPECT_EQ(timings, 1U);
}

TEST(StiffContact, a_cell_keeps_its_bounces_whatever_else_is_asked) {
  const Table all = table_of(stiff_outcome(), "bounces");
  const Table one =
      table_of(stiff_outcome("bounces = 100\nstiffness = [1e6]\ndamping_ratio = [0.1]\nstep = [1.5]\n"
                             "bounce_damping = [0.1]\nbounce_step = [1.9]\nrace_step = [0.8]\nrounds = 1"),
               "bounces");
  ASSERT_EQ(one.rows.size(), 6U);
  for (const std::vector<Value>& row : one.rows) {
    EXPECT_NE(std::find(all.rows.begin(), all.rows.end(), row), all.rows.end());
  }
}

}  // namespace
}  // namespace thinwall
