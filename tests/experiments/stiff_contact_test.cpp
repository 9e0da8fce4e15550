/// The stiff contact's settings and answers, and whether a wrong theory would be noticed.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

/// Small enough for a debug build, and still with every kind of cell: soft and stiff, undamped, damped and overdamped.
constexpr std::string_view few_contacts = R"(
  bounces = 100
  stiffness = [100, 1e6, 1e10]
  damping_ratio = [0, 1e-5, 0.1, 1, 1e5]
  step = [1.5e-5, 0.15, 1.5, 15]
  bounce_damping = [0, 0.1]
  bounce_step = [0.3, 1.5, 1.9, 5, 1000]
  race_step = [0.8, 0.1]
  race_bounces = 4
  rounds = 3
)";

Outcome stiff_outcome(std::string_view text = few_contacts) {
  return outcome_of(*run_of(stiff_contact_experiment(), text));
}

StiffResults measured() {
  const Experiment experiment = stiff_contact_experiment();
  StiffResults all = {
      make_stiff_plan(Settings(few_contacts, "test.toml", experiment.default_toml), {.seed = 1, .trials = {}}),
      {},
      {},
      {}};
  for (const Scheme scheme : all_schemes) {
    for (const double stiffness : all.plan.stiffness) {
      for (const double ratio : all.plan.ratios)
        all.limits.push_back(measured_spring(all.plan, scheme, stiffness, ratio));
      for (const double ratio : all.plan.bounce_ratios) {
        for (const Detection detection : all_detections) {
          const auto wall = measured_wall(all.plan, {scheme, detection, stiffness, ratio, 0});
          all.bounces.insert(all.bounces.end(), wall.begin(), wall.end());
        }
      }
    }
  }
  return all;
}

bool passes(const StiffResults& m) { return all_passed(stiff_claims(m)); }

bool passes_with_limit(StiffResults m, Scheme scheme, const std::function<double(double ratio, double limit)>& wrong) {
  for (LimitRow& row : m.limits) {
    if (row.scheme == scheme) row.theory = wrong(row.ratio, row.theory.value_or(0));
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
  const StiffResults m = measured();
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
  const StiffResults m = measured();
  const auto passes_with = [&](const std::function<void(ContactRow&)>& change) {
    StiffResults changed = m;
    for (ContactRow& row : changed.bounces) change(row);
    return passes(changed);
  };
  EXPECT_TRUE(passes_with([](ContactRow&) {}));
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.fastest *= 1.01; }));
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.slowest *= 0.99; }));
  EXPECT_FALSE(passes_with([](ContactRow& r) {  // an implicit step that gains
    if (r.contact.scheme == Scheme::implicit_euler) r.tally.fastest = 1.001;
  }));
  EXPECT_FALSE(passes_with([](ContactRow& r) {  // an explicit one that loses
    if (r.contact.scheme == Scheme::explicit_euler) r.tally.slowest = 0.999;
  }));
  EXPECT_FALSE(passes_with([](ContactRow& r) {  // a split that matters
    if (r.contact.detection == Detection::toi_split) r.tally.fastest *= 1 + 1e-6;
  }));
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.escaped = 0; }));  // nobody tunnels
  EXPECT_FALSE(passes_with([](ContactRow& r) { r.tally.escaped = 1; }));  // somebody always does
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

TEST(StiffContact, the_first_picture_is_the_stability_map) {
  const Outcome outcome = stiff_outcome();
  ASSERT_EQ(outcome.figures.size(), 5U);
  EXPECT_EQ(outcome.figures[0].name, "stability");
  EXPECT_EQ(outcome.figures[0].panels.size(), 3U);
  for (const Figure& figure : outcome.figures) {
    EXPECT_EQ(figure.is_timing, figure.name == "race");
    for (const Panel& panel : figure.panels) EXPECT_FALSE(panel.series.empty()) << figure.name;
  }
}

TEST(StiffContact, answers_for_the_smallest_of_settings) {
  const Outcome outcome = stiff_outcome(
      "bounces = 1\nstiffness = [100]\ndamping_ratio = [0]\nstep = [1]\nbounce_damping = [2]\nbounce_step = [3]\n"
      "race_step = [1]\nrace_bounces = 1\nrounds = 1");
  EXPECT_TRUE(outcome.self_test_passed) << outcome.summary;
  EXPECT_NE(outcome.answer.find("in 3 of 3 springs"), std::string::npos) << outcome.answer;
}

TEST(StiffContact, refuses_what_cannot_be_asked) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      run_of(stiff_contact_experiment(), text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  for (const std::string key : {"stiffness", "damping_ratio", "step", "bounce_damping", "bounce_step", "race_step"}) {
    for (const char* value : {"[-1]", "[inf]", "[nan]", "[]", "[1, 1]", "1", "['a']", "[1e300]"}) {
      const std::string complaint = refusal(key + " = " + value);
      EXPECT_NE(complaint.find("key '" + key + "'"), std::string::npos) << key << " " << value << ": " << complaint;
      EXPECT_EQ(complaint.find('\n'), std::string::npos);
    }
  }
  for (const std::string key : {"mass", "speed", "radius", "thickness", "blow_up"}) {
    for (const char* value : {"-1", "inf", "nan", "[1]", "1e300"}) {
      EXPECT_NE(refusal(key + " = " + value).find("key '" + key + "'"), std::string::npos) << key << " " << value;
    }
  }
  for (const char* text :
       {"mass = 0", "stiffness = [0]", "stiffness = [1, 0]", "step = [0]", "bounce_step = [0]", "race_step = [0]",
        "race_step = [2.5]", "speed = 0", "blow_up = 1", "bounces = 0", "rounds = 0", "race_bounces = 0",
        "damping_ratio = [1e-6]", "stifness = [1]", "radius = 0\nthickness = 0", "mass = 1e-12\nstiffness = [1e18]"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_NE(refusal("stiffness = [0]").find("key 'stiffness'"), std::string::npos);
  EXPECT_NE(refusal("stifness = [1]").find("did you mean 'stiffness'?"), std::string::npos);
  EXPECT_NE(refusal("damping_ratio = [1e-6]").find("0, or 1e-05 to 100000"), std::string::npos);
  EXPECT_NE(refusal("radius = 0\nthickness = 0").find("key 'thickness'"), std::string::npos);
}

}  // namespace
}  // namespace thinwall
