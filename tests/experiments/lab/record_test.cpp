/// Records: their text, their sums, and the groups of rows that have one.
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {
namespace {

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
}

/// A journal's row that another program wrote, or that was damaged in a way its checksum does not see.
TEST(Record, refuses_what_is_not_its_text) {
  const std::string whole = to_text(Everything{.shots = 3, .name = "a b"});
  EXPECT_NO_THROW(from_text<Everything>(whole));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    if (whole[length] != ' ') continue;
    EXPECT_THROW(from_text<Everything>(whole.substr(0, length)), std::runtime_error) << length;
  }
  EXPECT_THROW(from_text<Everything>(whole + " 1"), std::runtime_error);
  EXPECT_THROW(from_text<Everything>(" " + whole), std::runtime_error);
  EXPECT_THROW(from_text<Everything>(""), std::runtime_error);
  EXPECT_THROW(from_text<std::int64_t>("1.5"), std::runtime_error);
  EXPECT_THROW(from_text<std::int64_t>("99999999999999999999"), std::runtime_error);
  EXPECT_THROW(from_text<std::vector<std::int64_t>>("999999999999 1"), std::runtime_error);  // no room is asked for
  EXPECT_THROW(from_text<std::vector<std::int64_t>>("-1"), std::runtime_error);
  EXPECT_THROW(from_text<std::string>("'a%2"), std::runtime_error);
  EXPECT_THROW(from_text<std::string>("a"), std::runtime_error);
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

TEST(Record, a_mean_is_exact_to_its_unit) {
  RealSum sum;
  EXPECT_FALSE(sum.mean());
  for (const double x : {0.25, 0.5, -0.125}) sum.add(x);
  EXPECT_EQ(*sum.mean(), 0.625 / 3);
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
