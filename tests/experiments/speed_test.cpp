/// The experiment speed: what it makes of what benchmark programs say, and of those that fail. It never looks at a time of ours.

#include <algorithm>

#include <gtest/gtest.h>

#include <thinwall/experiments/speed/model.hpp>

#include "experiments/speed_run.hpp"
#include "support/said.hpp"

namespace thinwall {
namespace {

const std::string our_rows = bench_row("time_of_impact/sphere_aabb/front_door", 40, 0, 0, 1e-15) + ", " +
                             bench_row("time_of_impact/sphere_aabb/plain", 20, 1, 0, 1e-14) + ", " +
                             bench_row("raycast/aabb/front_door", 30, 0, 0, 1e-15);
const std::string peer_rows = bench_row("time_of_impact/sphere_aabb/thinwall", 44, 0, 0, 1e-15) + ", " +
                              bench_row("time_of_impact/sphere_aabb/bullet_gjk_cast", 880, 376, 4, 3e-2);

struct Speed : ::testing::Test {
  TemporaryFolder folder;  ///< of the programs

  /// pairs and peers, with Bullet but without ODE.
  void write_both() const {
    write_bench(folder.path(), "pairs", bench_json(our_rows));
    write_bench(folder.path(), "peers",
                bench_json(peer_rows, R"("peer_Bullet": "built in", "peer_ODE": "missing", "peer_Jolt": "missing")"));
  }
  Outcome result(const std::string& more = "") const { return outcome_of(*speed_run(folder.path(), more)); }
};

std::string whole_text(const Outcome& outcome) {
  std::string text = outcome.answer + "\n" + outcome.summary;
  for (const Section& section : outcome.sections) text += section.heading + "\n" + section.text + "\n";
  std::replace(text.begin(), text.end(), '\n', ' ');  // wherever a terminal breaks it
  return text;
}

TEST_F(Speed, gathers_rows_of_every_program_and_round) {
  write_both();
  const auto run = speed_run(folder.path());
  EXPECT_EQ(run->units().size(), 2 * bench_program_names.size());
  const Outcome outcome = outcome_of(*run);
  EXPECT_TRUE(outcome.self_test_passed);
  const Table& timings = table_of(outcome, "timings");
  EXPECT_TRUE(timings.is_timing);
  ASSERT_EQ(timings.rows.size(), 5U);
  EXPECT_EQ(value_of(timings, 0, "nanoseconds"), Value(40.0));
  EXPECT_EQ(value_of(timings, 0, "rounds"), Value(std::int64_t{2}));
  EXPECT_EQ(value_of(timings, 0, "to_floor"), Value(20.0));
  EXPECT_EQ(value_of(timings, 4, "way"), Value(std::string("bullet_gjk_cast")));
  const Table& errors = table_of(outcome, "errors");
  EXPECT_FALSE(errors.is_timing);
  EXPECT_EQ(value_of(errors, 4, "missed"), Value(std::int64_t{376}));
  EXPECT_EQ(value_of(errors, 4, "false_hits"), Value(std::int64_t{4}));
  EXPECT_EQ(value_of(errors, 4, "length_p99"), Value(3e-2));
}

TEST_F(Speed, errors_are_no_part_of_what_changes_with_the_machine) {
  const TemporaryFolder first, second;
  write_bench(first.path(), "pairs", bench_json(bench_row("time_of_impact/sphere_aabb/front_door", 40, 0, 0, 1e-15)));
  write_bench(second.path(), "pairs", bench_json(bench_row("time_of_impact/sphere_aabb/front_door", 77, 0, 0, 1e-15)));
  const Outcome a = outcome_of(*speed_run(first.path())), b = outcome_of(*speed_run(second.path()));
  for (std::size_t i = 0; i < a.tables.size(); ++i) {
    if (!a.tables[i].is_timing) {
      EXPECT_EQ(a.tables[i].rows, b.tables[i].rows) << a.tables[i].name;
    }
  }
  EXPECT_NE(table_of(a, "timings").rows, table_of(b, "timings").rows);
  for (const Figure& figure : a.figures) EXPECT_TRUE(figure.is_timing) << figure.name;
}

TEST_F(Speed, draws_a_point_for_each_way_and_pair_and_tells_who_is_wrong) {
  write_both();
  const Outcome outcome = result();
  ASSERT_EQ(outcome.figures.size(), 3U);
  const Panel& race = outcome.figures[0].panels.at(0);
  EXPECT_TRUE(race.log_x && race.log_y);
  ASSERT_EQ(race.series.size(), 3U);  // the front door once, though both programs ask it
  EXPECT_EQ(race.series[0].label, "thinwall, front door");
  EXPECT_EQ(race.series[0].y, std::vector<double>{40});
  EXPECT_EQ(race.series[2].label, "Bullet, GJK cast");
  EXPECT_EQ(race.series[2].x, std::vector<double>{3e-2});
  EXPECT_TRUE(holds(outcome.figures[0].caption, "Bullet, GJK cast misses 376 and invents 4"));
  const std::string text = whole_text(outcome);
  EXPECT_TRUE(holds(text, "380 wrong verdicts"));
  EXPECT_TRUE(holds(text, "take 20.0 to 20 times as long"));  // 880 ns to the 44 of the same run
}

TEST_F(Speed, takes_no_ratio_of_a_cast_that_took_less_than_its_call) {
  const std::string hidden = bench_row("time_of_impact/sphere_aabb/physx_sweep", 0, 0, 0, 1e-6);
  write_bench(folder.path(), "pairs", bench_json(our_rows));
  write_bench(folder.path(), "peers", bench_json(peer_rows + ", " + hidden));
  EXPECT_TRUE(holds(whole_text(result()), "take 20.0 to 20 times as long"));
}

TEST_F(Speed, keeps_what_a_call_takes_out_of_the_errors_that_must_agree) {
  const std::string row = R"({"run_name": "time_of_impact/sphere_aabb/jolt_cast_shape/iterations:1/manual_time", )"
                          R"("cpu_time": 5e8, "time_unit": "ns", "ns_row": 1400, "call_ns": 5$$, "missed": 0})";
  write_program(folder.path(), "peers", "cat >\"$out\" <<END\n" + bench_json(row) + "\nEND");
  const Outcome outcome = result();
  EXPECT_TRUE(outcome.self_test_passed);  // though it was another number in each round
  const Table& timings = table_of(outcome, "timings");
  ASSERT_EQ(timings.rows.size(), 1U);
  EXPECT_EQ(value_of(timings, 0, "way"), Value(std::string("jolt_cast_shape")));
  EXPECT_EQ(value_of(timings, 0, "nanoseconds"), Value(1400.0));
  EXPECT_NE(value_of(timings, 0, "call_ns"), Value());
}

TEST_F(Speed, names_the_programs_and_libraries_that_are_missing_and_does_the_rest) {
  write_both();
  const std::string text = whole_text(result());
  EXPECT_TRUE(holds(text, "Left out: batch: it is not in the folder of the benchmarks"));
  EXPECT_TRUE(holds(text, "Left out: peers: without ODE: install"));
  EXPECT_TRUE(holds(text, "; without Jolt: install nodejs and run `npm ci` in experiments/adapters/npm"));
  std::filesystem::remove(folder.path() / "peers");
  const std::string without = whole_text(result());
  EXPECT_TRUE(holds(without, "No other library took part."));
  EXPECT_TRUE(holds(without, "configure with -DTHINWALL_PEERS=ON and build again"));
}

TEST_F(Speed, self_test_fails_a_wrong_verdict_of_ours_and_errors_that_change) {
  write_bench(folder.path(), "pairs", bench_json(bench_row("time_of_impact/sphere_aabb/front_door", 40, 1, 0, 1e-15)));
  EXPECT_FALSE(result().self_test_passed);
  write_program(
      folder.path(), "pairs",
      "cat >\"$out\" <<END\n" +
          bench_json(R"({"run_name": "raycast/aabb/plain", "cpu_time": 1, "time_unit": "ns", "missed": $$})") +
          "\nEND");
  const Outcome outcome = result();  // the number of the process, in every round another
  EXPECT_FALSE(outcome.self_test_passed);
  EXPECT_TRUE(holds(outcome.summary, "FAILED"));
}

TEST_F(Speed, reads_units_items_and_options) {
  const BenchOutput output = bench_output_from_json(
      "world", bench_json(R"({"run_name": "world/rain_10/clamp/iterations:12", "cpu_time": 1.5, "time_unit": "ms"},
                             {"run_name": "a/b/c", "cpu_time": 9, "time_unit": "ns", "items_per_second": 2e9},
                             {"run_name": "a/b/c", "run_type": "aggregate", "cpu_time": 7, "time_unit": "ns"},
                             {"run_name": "alone", "cpu_time": 7, "time_unit": "ns"})"));
  ASSERT_EQ(output.rows.size(), 3U);
  EXPECT_EQ(output.rows[0].way, "clamp");
  EXPECT_EQ(output.rows[0].nanoseconds, 1.5e6);
  EXPECT_EQ(output.rows[1].nanoseconds, 0.5);
  EXPECT_EQ(output.rows[2].kind, "alone");
  EXPECT_EQ(output.rows[2].subject, "");
  EXPECT_EQ(output.floors, (std::vector<Counter>{{"division_ns", 1.5}}));
}

TEST_F(Speed, draws_batches_by_where_they_lie_with_their_floor) {
  std::string rows;
  for (const char* way : {"f64/cache/scalar", "f64/cache/AVX2", "f32/memory/AVX2"}) {
    rows += fmt::format(
        R"({}{{"run_name": "sphere_sphere/{}/real_time", "cpu_time": 9e9, "time_unit": "ns", "ns_row": {}, "floor_ns": 2, "to_floor": 2}})",
        rows.empty() ? "" : ", ", way, std::string_view(way).ends_with("scalar") ? 12 : 4);
  }
  write_bench(folder.path(), "batch", bench_json(rows));
  const Outcome outcome = result();
  EXPECT_EQ(value_of(table_of(outcome, "timings"), 1, "nanoseconds"), Value(4.0));
  ASSERT_EQ(outcome.figures.size(), 1U);
  const std::vector<Panel>& panels = outcome.figures[0].panels;
  ASSERT_EQ(panels.size(), 2U);  // in the cache, from memory
  ASSERT_EQ(panels[0].series.size(), 3U);
  EXPECT_EQ(panels[0].series[1].label, "batch, AVX2");
  EXPECT_EQ(panels[0].series[2].label, "floor");
  EXPECT_EQ(panels[0].series[2].x, std::vector<double>{2});
  EXPECT_EQ(panels[1].series.size(), 2U);
  EXPECT_TRUE(holds(outcome.answer, "takes 4 to 4 ns a row at its quickest, 3 to 3 times"));
}

TEST_F(Speed, says_which_program_failed_and_how_in_one_line) {
  for (
      const auto& [body, said] :
      {std::pair{"kill -9 $$", "was killed by a signal"},
       {"echo first; echo 'no such flag' >&2; exit 3", "ended with status 3: no such flag"},
       {"exit 4", "ended with status 4: it said nothing"},
       {"echo '{\"context\": {' >\"$out\"", "not Google Benchmark's JSON"},
       {"true", "not Google Benchmark's JSON"},
       {"echo '{\"context\": {}, \"benchmarks\": [{\"run_name\": \"a\"}]}' >\"$out\"", "not Google Benchmark's JSON"},
       {"echo '{\"context\": {}, \"benchmarks\": [{\"run_name\": \"a/b/c\", \"error_occurred\": true, \"error_message\": "
        "\"no core\"}]}' >\"$out\"",
        "a/b/c: no core"}}) {
    write_program(folder.path(), "pairs", body);
    const std::string failure = error_of<std::runtime_error>([&] { run_bench_program(folder.path(), "pairs", {}); });
    EXPECT_TRUE(holds(failure, said)) << body << ": " << failure;
    EXPECT_TRUE(holds(failure, (folder.path() / "pairs").string()));
    EXPECT_EQ(failure.find('\n'), std::string::npos) << failure;
  }
}

TEST_F(Speed, a_filter_may_leave_a_program_without_a_row) {
  write_program(folder.path(), "pairs", "true");
  EXPECT_TRUE(run_bench_program(folder.path(), "pairs", {.filter = "nothing"}).rows.empty());
  EXPECT_TRUE(holds(result("filter = \"nothing\"").answer, "no race"));
}

std::string complaint_of(const std::filesystem::path& folder, const std::string& more) {
  return error_of<UsageError>([&] { speed_run(folder, more); });
}

TEST_F(Speed, refuses_a_filter_that_is_none_and_a_folder_without_a_program) {
  const TemporaryFolder empty;
  write_both();
  EXPECT_EQ(complaint_of(folder.path(), ""), "");
  EXPECT_TRUE(holds(complaint_of(folder.path(), "filter = \"(\""), "is not allowed; a regular expression, or"));
  EXPECT_TRUE(holds(complaint_of(folder.path(), "programs = [\"world\"]"), "is not allowed; a folder that holds"));
  for (const std::filesystem::path& nowhere : {empty.path(), empty.path() / "missing"}) {
    const std::string said = complaint_of(nowhere, "");
    EXPECT_TRUE(holds(said, nowhere.string()));
    EXPECT_TRUE(holds(said, "cmake --build"));
  }
}

}  // namespace
}  // namespace thinwall
