/// Units computed by any number of threads, their journal and its records, and the shards and estimates of a run.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/runner.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/shards.hpp>
#include <thinwall/experiments/lab/tasks.hpp>

#include "support/program.hpp"
#include "support/said.hpp"

namespace thinwall {

namespace {

struct RunnerTest : testing::Test {
  TemporaryFolder folder;
  std::string file = folder / "journal.tsv";
  std::atomic<int> computed = 0;

  std::vector<Unit> squares(int count) {
    std::vector<Unit> units;
    for (int i = 0; i < count; ++i) {
      units.push_back({"unit " + std::to_string(i), i + 1, [this, i] {
                         ++computed;
                         return std::to_string(i * i);
                       }});
    }
    return units;
  }
};

TEST_F(RunnerTest, stops_between_units_and_goes_on_where_it_was) {
  const auto units = squares(50);
  {
    Journal journal(file, "the run");
    const auto stop = [&] { return computed >= 20; };
    const UnitResults results = compute_units(units, journal, {.threads = 2, .stop = stop, .on_progress = {}});
    EXPECT_FALSE(results.complete);
  }
  const auto kept = static_cast<std::size_t>(computed);
  EXPECT_GE(kept, 20u);
  EXPECT_LE(kept, 22u);
  Journal journal(file, "the run");
  std::vector<Progress> seen;
  const UnitResults results = compute_units(
      units, journal,
      {.threads = 2, .stop = {}, .on_progress = [&](const Progress& progress) { seen.push_back(progress); }});
  EXPECT_TRUE(results.complete);
  EXPECT_EQ(computed, 50);
  for (std::size_t i = 0; i < units.size(); ++i) EXPECT_EQ(results.results[i], std::to_string(i * i));
  ASSERT_EQ(seen.size(), 51 - kept);
  EXPECT_EQ(seen.front().units_done, kept);
  EXPECT_EQ(seen.front().trials_done, seen.front().trials_resumed);
  EXPECT_EQ(seen.back().trials_done, seen.back().trials);
  EXPECT_EQ(seen.back().trials, 50 * 51 / 2);
}

TEST_F(RunnerTest, refuses_two_units_of_one_name) {
  auto units = squares(2);
  units[1].key = units[0].key;
  Journal journal(file, "the run");
  EXPECT_THROW(compute_units(units, journal, {.threads = 1, .stop = {}, .on_progress = {}}), std::logic_error);
}

struct JournalTest : testing::Test {
  TemporaryFolder folder;
  std::string file = folder / "journal.tsv";

  void write_three() const {
    Journal journal(file, "the run");
    journal.add("a", {0.1, "1 2 3"});
    journal.add("b", {0.2, "tab\there"});
    journal.add("c", {0.3, ""});
  }
};

TEST_F(JournalTest, gives_back_what_was_added_and_knows_whose_it_is) {
  EXPECT_EQ(read_journal(file).identity, "");
  write_three();
  EXPECT_EQ(read_journal(file).identity, "the run");
  const Journal journal(file, "the run");
  EXPECT_EQ(journal.finished().size(), 3u);
  EXPECT_EQ(journal.finished().find("a")->second.result, "1 2 3");
  EXPECT_EQ(journal.finished().find("b")->second.result, "tab\there");
  EXPECT_EQ(journal.finished().find("b")->second.seconds, 0.2);
  EXPECT_EQ(journal.finished().find("c")->second.result, "");
  EXPECT_TRUE(journal.damage().empty());
}

TEST_F(JournalTest, begins_none_in_the_place_of_what_is_none) {
  write_text(folder / "mine", "mine\n");
  std::filesystem::create_symlink("mine", folder / "link.tsv");
  for (const char* name : {"mine", "link.tsv"}) EXPECT_THROW(Journal(folder / name, "the run"), std::system_error);
  EXPECT_EQ(read_text(folder / "mine"), "mine\n");
}

TEST_F(JournalTest, drops_a_torn_last_row_wherever_it_was_torn) {
  write_three();
  const std::string whole = read_text(file);
  const auto end_of_b = whole.rfind('\n', whole.size() - 2) + 1;
  for (auto length = end_of_b; length < whole.size(); ++length) {
    write_text(file, whole.substr(0, length));
    Journal journal(file, "the run");
    EXPECT_EQ(journal.finished().size(), 2u) << length;
    EXPECT_TRUE(journal.damage().empty());
    journal.add("c", {0.3, ""});
    EXPECT_EQ(read_text(file), whole);
  }
}

TEST_F(JournalTest, takes_no_row_of_another_run) {
  Journal(folder / "other.tsv", "another run").add("b", {0.2, "theirs"});
  Journal(file, "the run").add("a", {0.1, "ours"});
  const std::string other = read_text(folder / "other.tsv");
  write_text(file, read_text(file) + other.substr(other.find('\n') + 1));
  const Journal journal(file, "the run");
  EXPECT_EQ(journal.finished().size(), 1u);
  EXPECT_EQ(
      journal.damage(),
      std::vector<std::string>{file + ":3: the row of 'b' is damaged, or of another run; that unit is computed again"});
}

TEST(Shard, is_written_as_it_is_read_and_counts_from_one) {
  EXPECT_EQ(parse_shard("2/4"), (Shard{2, 4}));
  EXPECT_EQ(to_text(parse_shard("1000/1000")), "1000/1000");
  for (const char* text : {"0/4", "5/4", "1/0", "a/b", "2", "/4", "2/", "2/4/6", "-1/4", "1/1000001", "", " 1/2"}) {
    EXPECT_TRUE(holds(error_of<UsageError>([&] { parse_shard(text); }),
                      "--shard: '" + std::string(text) + "' is not allowed; i/N"));
  }
}

TEST(Shard, has_its_units_for_itself_and_as_many_as_any_other) {
  for (const std::size_t units : {0u, 1u, 20u, 1000u}) {
    for (const int count : {1, 2, 3, 7, 50}) {
      std::vector<int> owners(units);
      for (int index = 1; index <= count; ++index) {
        const auto mine = units_of({index, count}, units);
        const auto fair = units / static_cast<std::size_t>(count);
        EXPECT_TRUE(mine.size() == fair || mine.size() == fair + 1) << mine.size();
        EXPECT_TRUE(std::ranges::is_sorted(mine));
        for (const std::size_t i : mine) ++owners[i];
      }
      EXPECT_EQ(std::ranges::count(owners, 1), static_cast<std::ptrdiff_t>(units));
    }
  }
}

TEST(Shard, mixes_units_that_repeat_in_a_pattern_and_the_same_on_every_machine) {
  EXPECT_EQ(units_of({1, 3}, 10), (std::vector<std::size_t>{1, 3, 7, 8}));
  for (const int count : {2, 3, 4, 8}) {  // every second unit is dear: none must get them all
    int dear = 0;
    for (const std::size_t i : units_of({1, count}, 4800)) dear += i % 2 == 0 ? 1 : 0;
    EXPECT_NEAR(dear * count, 2400, 240) << count;
  }
}

TEST(RunIdentity, tells_what_differs) {
  const char* config = R"({"radius":1,"speed":[1,2]})";
  const auto from_ours = [&](const RunIdentity& theirs) {
    return identity_difference(theirs, {"toy", config, 7, std::nullopt, "program"});
  };
  EXPECT_EQ(from_ours({"toy", config, 7, std::nullopt, "program"}), "");
  EXPECT_EQ(from_ours({"toy", config, 7, std::nullopt, "another"}), "");
  EXPECT_EQ(from_ours({"toy", config, 7, 5, ""}), "trials = 5, not none");
  EXPECT_EQ(from_ours({"toy", config, 8, 5, ""}), "seed = 8, not 7");
  EXPECT_EQ(from_ours({"toy", R"({"radius":1,"speed":[1,3]})", 7, {}, ""}), "speed = [1,3], not [1,2]");
  EXPECT_EQ(from_ours({"toy", R"({"radius":1,"speed":[1,2],"more":1})", 7, {}, ""}), "keys that are unknown here");
  EXPECT_FALSE(parse_identity("garbage"));
}

int computed = 0;  // by this process

std::string compute() {
  ++computed;
  return "";
}

std::string compute_forever() {
  for (volatile bool forever = true; forever;) continue;
  return "";
}

using Tasks = std::vector<Task<std::string>>;

/// Ten units that trials cut, and some that they do not.
std::unique_ptr<Run> uneven(std::int64_t trials, Tasks tasks, std::string (*work)() = compute) {
  for (int i = 0; i < 10; ++i) tasks.push_back({"cut " + std::to_string(i), trials, work});
  return make_run([](const Done<std::string>&) { return Outcome(); }, std::move(tasks));
}

RunEstimate estimate_of(std::int64_t trials, const Tasks& whole, double budget) {
  const auto run = uneven(trials, whole);
  return estimate(
      run->units(), [&](std::int64_t fewer) { return uneven(fewer, whole); }, budget);
}

TEST(Estimate, is_made_from_few_trials_and_by_another_process) {
  computed = 0;
  const RunEstimate told = estimate_of(std::int64_t(1) << 60, {{"whole", 3, compute}}, 0.2);
  EXPECT_EQ(computed, 0);
  EXPECT_EQ(told.unknown, 0);
  EXPECT_EQ(told.cut_tried, 10);
  EXPECT_EQ(told.whole, 1);
  EXPECT_EQ(told.whole_tried, 1);
  EXPECT_GT(told.seconds, 0);
  const RunEstimate itself = estimate_of(1, {}, 0.2);  // a run of one trial cannot be cut
  EXPECT_EQ(itself.cut_tried, 0);
  EXPECT_EQ(itself.whole_tried, 10);
  EXPECT_EQ(itself.unknown, 0);
}

TEST(Estimate, ends_where_a_unit_does_not) {
  const RunEstimate told =
      estimate_of(100, {{"endless", 3, compute_forever}, {"a", 1, compute}, {"b", 2, compute}}, 0.5);
  EXPECT_EQ(told.cut_tried, 10);
  EXPECT_EQ(told.whole, 3);
  EXPECT_EQ(told.whole_tried, 2);  // those of few trials come first
  EXPECT_EQ(told.unknown, 1);
  EXPECT_TRUE(basis_text(told).ends_with(", 2 of 3 units tried whole, 1 unit too long to try")) << basis_text(told);
}

TEST(Estimate, says_what_it_knows_nothing_of) {
  const auto endless = [](std::int64_t trials) { return uneven(trials, {}, compute_forever); };
  const auto run = endless(100);
  EXPECT_EQ(basis_text(estimate(run->units(), endless, 0.05)), "10 units too long to try");
}

TEST(Estimate, tries_no_unit_that_says_how_long_it_takes) {
  const auto tried = []() -> std::string { throw std::logic_error("it was tried"); };
  const RunEstimate told = estimate_of(1, {{"a", 1, tried, 3}, {"b", 1, tried, 3}}, 0.2);
  EXPECT_EQ(told.whole_tried, 12);
  EXPECT_GE(told.seconds, 6);
}

/// 40 ms a trial: of 1000 trials each of the ten units would take 40 s, of one 40 ms, and not all of them are tried.
TEST(Estimate, is_in_proportion_to_trials_and_units) {
  const auto sleepy = [](std::int64_t trials) {
    Tasks tasks;
    for (int i = 0; i < 10; ++i) {
      tasks.push_back({"unit " + std::to_string(i), trials, [trials] {
                         std::this_thread::sleep_for(std::chrono::milliseconds(40 * trials));
                         return std::string();
                       }});
    }
    return make_run([](const Done<std::string>&) { return Outcome(); }, std::move(tasks));
  };
  for (const std::int64_t trials : {1, 1000}) {
    const auto run = sleepy(trials);
    EXPECT_GE(estimate(run->units(), sleepy, 0.3).seconds, 0.4 * static_cast<double>(trials));
  }
}

TEST(Estimate, passes_over_trials_that_are_too_few) {
  const auto run = uneven(1000, {});
  const auto again = [](std::int64_t trials) {
    if (trials < 10) throw UsageError("too few");
    return uneven(trials, {});
  };
  EXPECT_GE(estimate(run->units(), again, 0.2).trials, 16);
}

TEST(Estimate, does_not_take_what_lays_out_a_run_to_grow_with_its_trials) {
  const auto run = uneven(1'000'000, {});
  const auto again = [](std::int64_t trials) {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return uneven(trials, {});
  };
  EXPECT_GT(estimate(run->units(), again, 2).trials, 1);
}

using std::chrono::milliseconds;

TEST(StopGuard, ends_what_does_not_heed_a_stop) {
  watch_for_stop();
  std::promise<void> ended;
  const StopGuard guard(milliseconds(10), [&] { ended.set_value(); });
  std::raise(SIGINT);
  EXPECT_EQ(ended.get_future().wait_for(std::chrono::seconds(60)), std::future_status::ready);
}

TEST(StopGuard, leaves_alone_what_ends_in_time_or_is_not_asked_to) {
  watch_for_stop();
  bool ended = false;
  {
    const StopGuard guard(milliseconds(0), [&] { ended = true; });
  }
  EXPECT_FALSE(ended) << "nobody asked";
  std::raise(SIGTERM);
  {
    const StopGuard guard(std::chrono::hours(1), [&] { ended = true; });
  }
  EXPECT_FALSE(ended) << "it ended within its hour";
  watch_for_stop();
}

// ---- Records: their text, their sums, and the groups of rows that have one.

struct Inner {
  std::int64_t count = 0;
  static constexpr auto fields() { return record(sum("inner_count", &Inner::count, "1", "Of a part.")); }
  bool operator==(const Inner&) const = default;
};

enum class Color { red, green };

/// Every kind of field.
struct Everything {
  std::int64_t shots = 0;
  RealSum lateness = {};
  double earliest = no_least, latest = no_most;
  std::array<std::int64_t, 3> bins = {};
  std::vector<std::int64_t> growing = {};
  std::string name = {};
  std::optional<double> guess = {};
  Color color = Color::red;
  bool flag = false;
  Inner inner = {};
  std::vector<Inner> parts = {};

  static constexpr auto fields() {
    using E = Everything;
    return record(sum("shots", &E::shots, "1", "."), sum("lateness", &E::lateness, "step", "."),
                  least("earliest", &E::earliest, "m", "."), most("latest", &E::latest, "m", "."),
                  sum("bins", &E::bins, "1", "."), sum("growing", &E::growing, "1", "."), kept("name", &E::name),
                  kept("guess", &E::guess, "m"), kept("color", &E::color), kept("flag", &E::flag), part(&E::inner),
                  sum("parts", &E::parts, "1", "."));
  }
  bool operator==(const Everything&) const = default;
};

Everything drawn() {
  const auto small = [] { return *rc::gen::inRange<std::int64_t>(-1'000'000, 1'000'000); };
  const auto real = [] { return *rc::gen::arbitrary<double>(); };
  Everything e;
  e.shots = *rc::gen::arbitrary<std::int64_t>() / 16;
  for (int i = 0; i < 3; ++i) e.lateness.add(static_cast<double>(small()) / 3e5);
  e.earliest = real();
  e.latest = real();
  e.bins = {small(), small(), small()};
  e.growing = *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(-9, 9));
  e.name = *rc::gen::arbitrary<std::string>();
  if (*rc::gen::arbitrary<bool>()) e.guess = real();
  e.color = *rc::gen::element(Color::red, Color::green);
  e.flag = *rc::gen::arbitrary<bool>();
  e.inner.count = small();
  e.parts.resize(static_cast<std::size_t>(*rc::gen::inRange(0, 4)));
  for (Inner& inner : e.parts) inner.count = small();
  return e;
}

RC_GTEST_PROP(Record, comes_back_from_its_text, ()) {
  const Everything e = drawn();
  const std::string text = to_text(e);
  RC_ASSERT(text.find_first_of("\t\n\r") == std::string::npos);
  RC_ASSERT(from_text<Everything>(text) == e);
}

TEST(Record, keeps_every_bit_of_a_real) {
  for (const double x : {0.1, -0.0, 5e-324, 1.7976931348623157e308, no_least, no_most}) {
    EXPECT_EQ(from_text<double>(to_text(x)), x);
    EXPECT_EQ(std::signbit(from_text<double>(to_text(x))), std::signbit(x));
  }
  EXPECT_TRUE(std::isnan(from_text<double>(to_text(std::numeric_limits<double>::quiet_NaN()))));
  RealSum sum;  // whose mean is exact to its unit
  EXPECT_FALSE(sum.mean());
  for (const double x : {0.25, 0.5, -0.125}) sum.add(x);
  EXPECT_EQ(*sum.mean(), 0.625 / 3);
}

/// A journal's row that another program wrote, or that was damaged in a way its checksum does not see.
TEST(Record, refuses_what_is_not_its_text) {
  const std::string whole = to_text(Everything{.shots = 3, .name = "a b"});
  EXPECT_NO_THROW(from_text<Everything>(whole));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    if (whole[length] != ' ') continue;
    EXPECT_THROW(from_text<Everything>(whole.substr(0, length)), std::runtime_error) << length;
  }
  for (const std::string& text : {whole + " 1", " " + whole, std::string()})
    EXPECT_THROW(from_text<Everything>(text), std::runtime_error) << text;
  for (const char* text : {"1.5", "99999999999999999999"})
    EXPECT_THROW(from_text<std::int64_t>(text), std::runtime_error) << text;
  for (const char* text : {"999999999999 1", "-1"})  // no room is asked for
    EXPECT_THROW(from_text<std::vector<std::int64_t>>(text), std::runtime_error) << text;
  for (const char* text : {"'a%2", "a"}) EXPECT_THROW(from_text<std::string>(text), std::runtime_error) << text;
}

RC_GTEST_PROP(Record, adds_up_to_the_same_bits_in_any_order_and_grouping, ()) {
  std::vector<Everything> all;
  for (int i = 0; i < 5; ++i) {
    all.push_back(drawn());
    all.back().name = "cell";  // what is kept is the same in all parts
    all.back().guess = 0.5;
    all.back().color = Color::green;
    all.back().flag = true;
    std::erase_if(all, [](const Everything& e) { return std::isnan(e.earliest) || std::isnan(e.latest); });
  }
  RC_PRE(!all.empty());
  Everything forward = all[0];
  for (std::size_t i = 1; i < all.size(); ++i) forward += all[i];
  Everything backward, front, back;
  for (std::size_t i = all.size(); i-- > 0;) backward += all[i];
  for (std::size_t i = 0; i < all.size(); ++i) (i % 2 == 0 ? front : back) += all[i];
  RC_ASSERT(backward == forward);
  RC_ASSERT((back += front) == forward);
}

struct Named {
  std::string method;
  Inner inner;
};

TEST(Groups, are_in_the_order_of_their_first_rows_and_add_up) {
  const std::vector<Named> rows = {{"b", {1}}, {"a", {10}}, {"b", {100}}};
  const auto groups = group_by(rows, &Named::method);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0], (Group<Named>{&rows[0], &rows[2]}));
  EXPECT_EQ(total_of(groups[0], &Named::inner).count, 101);
  EXPECT_EQ(groups[1][0]->method, "a");
  const auto some = only(rows, [](const Named& row) { return row.method == "b"; });
  EXPECT_EQ(some[1].inner.count, 100);
  EXPECT_EQ(flat(std::vector{rows, some}).size(), 5U);
}

}  // namespace

}  // namespace thinwall
