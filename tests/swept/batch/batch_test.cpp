// What a batch does with its rows, whatever they hold: splits, one against many, threads, vectors, bad input. And ten million rows, plain
// and the worst: every vector width gives the scalar code's verdicts, and its times to the bound.
// THINWALL_THOROUGH=100 tests_swept --gtest_filter='BatchVerdicts*' judges a hundred times as many.

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/swept/batch.hpp>
#include <thinwall/swept/batch/run.hpp>
#include <thinwall/swept/batch/table.hpp>
#include <thinwall/swept/certified_batch.hpp>

#include "support/certified.hpp"
#include "support/said.hpp"
#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

// ---- Rows, plain and the worst, with the scalar code's answers.

/// One of the worst now and then, or with a NaN, an infinity or the end of the range.
template <class A, class B, class S> Motion<A, B> batch_motion(Shaker<S>& draw) {
  Motion<A, B> motion = draw.pick(0, 2) == 0 ? worst_motion<A, B>(draw) : drawn_motion<A, B>(draw);
  using Limits = std::numeric_limits<S>;
  constexpr std::array bad = {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(),
                              Limits::denorm_min()};
  const int spoiled = draw.pick(0, 30);
  Vec3<S>& displacement = spoiled == 0 ? motion.a.displacement : motion.b.displacement;
  if (spoiled < 2) displacement[draw.pick(0, 2)] = bad[static_cast<std::size_t>(draw.pick(0, 4))];
  return motion;
}

template <class S> void spoil_size(Moving<Sphere<S>>& sphere, const S& size) { sphere.shape.radius = size; }
template <class S> void spoil_size(Moving<Capsule<S>>& capsule, const S& size) { capsule.shape.radius = size; }
template <class Box, class S> void spoil_size(Moving<Box>& box, const S& size) { box.shape.half_extents[1] = size; }

template <class A, class B> struct BatchRows {
  using S = typename A::Scalar;
  RowTable<Moving<A>> a{};
  RowTable<Moving<B>> b{};
  std::vector<Toi<double>> truth{};  ///< by the scalar code, in double

  BatchRows() = default;
  BatchRows(std::size_t count, unsigned seed) {
    Shaker<S> draw(seed);
    for (std::size_t i = 0; i < count; ++i) {
      Motion<A, B> motion = batch_motion<A, B>(draw);
      const int bad = draw.pick(0, 200);
      if (bad == 0) spoil_size(motion.a, S(-1));
      if (bad == 1) spoil_size(motion.b, -std::numeric_limits<S>::denorm_min());
      if (bad == 2) spoil_size(motion.b, std::numeric_limits<S>::quiet_NaN());
      if (bad == 3) spoil_size(motion.a, std::numeric_limits<S>::infinity());
      push_back(motion);
    }
  }
  void push_back(const Motion<A, B>& motion) {
    a.push_back(motion.a);
    b.push_back(motion.b);
    const Toi<S> toi = time_of_impact(motion.a, motion.b);
    const Toi<double> fine = toi.status == ToiStatus::hit
                                 ? time_of_impact(widened<double>(motion.a), widened<double>(motion.b))
                                 : Toi<double>{};
    truth.push_back({toi.status, 0, fine.time, fine.normal, fine.point});
  }

  bool has_every_status() const {
    std::array<int, 5> seen{};
    for (const Toi<double>& toi : truth) ++seen[static_cast<std::size_t>(toi.status)];
    return seen[0] > 0 && seen[1] > 0 && seen[2] > 0 && seen[4] > 0;
  }
};

/// visit(target) with each kind of vectors that this machine has, of which the best is then taken again.
template <class Visit> void for_each_target(const Visit& visit) {
  for (const std::string& target : vector_targets()) {
    SCOPED_TRACE(target);
    use_vectors(target);
    visit(target);
  }
  use_vectors("");
}

template <class S> struct Answers {
  std::vector<ToiStatus> status;
  std::vector<S> time;
  explicit Answers(std::size_t rows) : status(rows, ToiStatus::gave_up), time(rows, S(-1)) {}
  ToiRows<S> rows() { return {status, time}; }
};

// ---- What holds of boxes and balls holds of all.

using Ball = Moving<Sphere<double>>;
using Box = Moving<Aabb<double>>;

/// The same bits, NaN included.
template <class S>::testing::AssertionResult same_answers(const Answers<S>& a, const Answers<S>& b) {
  for (std::size_t i = 0; i < a.time.size(); ++i) {
    const bool both_nan = std::isnan(a.time[i]) && std::isnan(b.time[i]);
    if (a.status[i] != b.status[i] || (a.time[i] != b.time[i] && !both_nan))
      return ::testing::AssertionFailure() << "row " << i << ": " << a.time[i] << " and " << b.time[i];
  }
  return ::testing::AssertionSuccess();
}

template <class A> RowTable<Moving<A>> repeated(const Moving<A>& row, std::size_t count) {
  RowTable<Moving<A>> table;
  for (std::size_t i = 0; i < count; ++i) table.push_back(row);
  return table;
}

class BatchRowsOfBoxesAndBalls : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_vectors(GetParam()); }
  void TearDown() override { use_vectors(""); }

  static constexpr std::size_t count = 5003;  // blocks, vectors and a ragged end
  BatchRows<Aabb<double>, Sphere<double>> rows{count, 3};
};

TEST_P(BatchRowsOfBoxesAndBalls, have_the_same_bits_for_any_split) {  // at any alignment
  Answers<double> whole(count), split(count);
  time_of_impact(rows.a.rows(), rows.b.rows(), whole.rows());
  std::size_t begin = 0;
  for (std::size_t length = 1; begin < count; ++length) {
    const std::size_t end = std::min(begin + length, count), n = end - begin;
    const ToiRows<double> part{std::span(split.status).subspan(begin, n), std::span(split.time).subspan(begin, n)};
    EXPECT_EQ(time_of_impact(rows.a.rows(begin, end), rows.b.rows(begin, end), part).rows, n);
    begin = end;
  }
  EXPECT_TRUE(same_answers(whole, split));
}

TEST_P(BatchRowsOfBoxesAndBalls, have_the_same_bits_for_any_number_of_threads) {
  Answers<double> one(count);
  const BatchReport report = time_of_impact(rows.a.rows(), rows.b.rows(), one.rows());
  for (const int threads : {0, 2, 3, 8}) {
    Answers<double> many(count);
    const BatchReport again = time_of_impact(rows.a.rows(), rows.b.rows(), many.rows(), {threads});
    EXPECT_TRUE(same_answers(one, many));
    EXPECT_EQ(again.asked_again, report.asked_again);
  }
}

TEST_P(BatchRowsOfBoxesAndBalls, have_the_same_bits_one_against_many_as_row_by_row) {
  for (const std::size_t i : {std::size_t{0}, std::size_t{7}, std::size_t{400}}) {
    const RowTable<Box> boxes = repeated(rows.a[i], count);
    const RowTable<Ball> balls = repeated(rows.b[i], count);
    Answers<double> one(count), many(count);
    time_of_impact(rows.a[i], rows.b.rows(), one.rows());
    time_of_impact(boxes.rows(), rows.b.rows(), many.rows());
    EXPECT_TRUE(same_answers(one, many));
    time_of_impact(rows.a.rows(), rows.b[i], one.rows());
    time_of_impact(rows.a.rows(), balls.rows(), many.rows());
    EXPECT_TRUE(same_answers(one, many));
  }
}

TEST_P(BatchRowsOfBoxesAndBalls, have_the_same_bits_the_other_way_round) {
  Answers<double> there(count), back(count);
  time_of_impact(rows.a.rows(), rows.b.rows(), there.rows());
  time_of_impact(rows.b.rows(), rows.a.rows(), back.rows());
  EXPECT_TRUE(same_answers(there, back));
}

TEST_P(BatchRowsOfBoxesAndBalls, have_the_scalar_codes_normals_and_points_on_request) {
  Answers<double> answers(count);
  std::array<std::vector<double>, 6> v;
  for (auto& column : v) column.assign(count, -7);
  ToiRows<double> out = answers.rows();
  out.normal = {v[0], v[1], v[2]};
  out.point = {v[3], v[4], v[5]};
  time_of_impact(rows.b.rows(), rows.a.rows(), out);
  for (std::size_t i = 0; i < count; ++i) {
    const Toi<double> toi = time_of_impact(rows.b[i], rows.a[i]);
    ASSERT_EQ(answers.status[i], toi.status);
    if (toi.status == ToiStatus::invalid) continue;
    ASSERT_EQ(Vec3<double>(v[0][i], v[1][i], v[2][i]), toi.normal) << i;
    ASSERT_EQ(Vec3<double>(v[3][i], v[4][i], v[5][i]), toi.point) << i;
  }
}

TEST_P(BatchRowsOfBoxesAndBalls, of_points_are_answered_by_vectors) {
  RowTable<Box> boxes;
  RowTable<Ball> points;
  for (int i = 0; i < 90; ++i) {
    boxes.push_back(at_rest(Aabb<double>{{0, 0, 0}, {1, 1, 1}}));
    points.push_back({{{5, 0.25, i % 3 == 1 ? 1.5 : 0.5}, 0}, {i % 3 == 2 ? 8.0 : -8.0, 0, 0}});
  }
  Answers<double> answers(90);
  EXPECT_EQ(time_of_impact(boxes.rows(), points.rows(), answers.rows()).asked_again, 0U);
  for (std::size_t i = 0; i < 90; ++i) {
    EXPECT_EQ(answers.status[i], i % 3 == 0 ? ToiStatus::hit : ToiStatus::apart);
    EXPECT_EQ(answers.time[i], i % 3 == 0 ? 0.5 : 1);
  }
}

/// Row by row and as one against many, the verdict is the scalar code's.
template <class A, class B> void expect_as_scalar(const char* what, const Moving<A>& a, const Moving<B>& b) {
  using S = typename A::Scalar;
  const RowTable<Moving<A>> as = repeated(a, 16);
  const RowTable<Moving<B>> bs = repeated(b, 16);
  const ToiStatus truth = time_of_impact(a, b).status;
  Answers<S> rows(16), many(16);
  time_of_impact(as.rows(), bs.rows(), rows.rows());
  time_of_impact(a, bs.rows(), many.rows());
  EXPECT_EQ(rows.status[0], truth) << what;
  EXPECT_EQ(many.status[0], truth) << what;
}

TEST_P(BatchRowsOfBoxesAndBalls, of_which_roundings_decide_are_the_scalar_codes) {
  const Box box = at_rest(Aabb<double>{{0, 0, 0}, {1, 1, 1}});
  const Ball quick{{{-0x1.2b62542c11654p+4, 0x1.00003357b03ecp+0, 0x1.00003357b03ecp+0}, 0x1.2265b1f236eb0p-18},
                   {0x1.61ef6182622c2p+4, -0x1.1f3d3ea1b5dd2p-31, -0x1.1f3d3ea1b5dd2p-31}};
  expect_as_scalar("a quick axis that enters drowns the slope of two slow ones", box, quick);
  const Ball leaving{{{0x1.588959c65a506p-2, 0x1.58fea0de3d819p+0, 0x1.5d28ff39531f7p+0}, 0x1.01ac5168fa606p-1},
                     {0x1.bc319838a7d44p+1, -0x1.c5ae16db86eb5p-33, -0x1.c5ae16db86eb5p-33}};
  expect_as_scalar("at R to rounding where a quick axis leaves", box, leaving);
  expect_as_scalar("a point inside", box, Ball{{{0.5, 0.25, 0}, 0}, {1, 0, 0}});
  const auto capsule = at_rest(Capsule<float>{{0, 0, 0}, {0x1.8c5e36p+9F, 0x1.30c856p+9F, 0}, 0.5F});
  const Moving<Sphere<float>> along{{{-0x1.1e673ep-1F, 0x1.a9a472p-1F, 0}, 0.5F}, {0x1.405cb4p+9F, 0x1.ecad6cp+8F, 0}};
  expect_as_scalar("almost along a capsule's axis", capsule, along);
  constexpr float u = 0x1p-24F;
  const Vec3<float> unit(1 + 30 * u, 1, 1);
  const auto turned = at_rest(Obb<float>{{0, 0, 0}, {1, 0x1p-10F, 0x1p-10F}, unit.asDiagonal()});
  const Moving<Sphere<float>> head_on{{{1 + 0x1p-6F + 0x1p-20F + 26 * u, 0, 0}, 0x1p-20F}, {-0x1p-6F, 0, 0}};
  expect_as_scalar("an axis too long by 30 u", turned, head_on);
  // Found by drawing five million: a slow axis is entered last, in whose noise a quick one leaves the face.
  using F = Vec3<float>;
  expect_as_scalar("a rim passed while a slow axis closes",
                   Moving{Aabb<float>{F(-3.6644924F, 2, 0.99949294F), F(0.3206128F, 1.9277323F, 1.5F)},
                          F(0.00091028214F, -5.31625F, -5.539623F)},
                   at_rest(Sphere<float>{F(-1.3432537F, -0.5F, -1.308669F), 2}));
  expect_as_scalar("another rim",
                   Moving{Aabb<float>{F(-0.5F, 0.500006F, -1.4622943F), F(1.3395107F, 0, 0.5428998F)},
                          F(-0.75F, -1.6043583e-05F, -0.25F)},
                   at_rest(Sphere<float>{F(-2, -1, -1.0130483F), 1.5F}));
  // The scalar code starts from the middle of the capsule, and takes a gap of a hundredth of a rounding of it for none.
  const Capsule<double> nearly_touched{{-0.79990899469703436, 1.5, 0}, {-0.79990899469703436, 0.5, 0}, 0};
  expect_as_scalar("a capsule's end that is all but touched",
                   Moving{nearly_touched, Vec3<double>(1.1008612583391368, -0.56857734173536301, -2.4862988363020122)},
                   at_rest(Sphere<double>{{-0.79628887088038658, 0.49764269878332656, -0.0045539825722720195},
                                          0.006277015432715416}));
}

/// Rows whose boxes have bad axes among others, one at a time.
template <class S> void expect_bad_axes_to_be_invalid() {
  RowTable<Moving<Sphere<S>>> balls;
  const std::array bad = {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity(), S(-3), S(0.5),
                          S(1e-3)};
  for (int i = 0; i < 90; ++i) {
    balls.push_back({{{5, 0.25, 0.5}, 0.5}, {i % 4 == 0 ? S(8) : S(-8), 0, 0}});
  }
  for (int k = 0; k < 9; ++k) {
    for (const S& off : bad) {
      RowTable<Moving<Obb<S>>> boxes;
      for (int i = 0; i < 90; ++i) {
        Obb<S> box{{0, 0, 0}, {1, 1, 1}, Mat3<S>::Identity()};
        if (i % 3 == 1) box.axes(k / 3, k % 3) += off;
        boxes.push_back(at_rest(box));
      }
      Answers<S> answers(90);
      time_of_impact(boxes.rows(), balls.rows(), answers.rows());
      for (int i = 0; i < 90; ++i) {
        const ToiStatus fine = i % 4 == 0 ? ToiStatus::apart : ToiStatus::hit;
        EXPECT_EQ(answers.status[static_cast<std::size_t>(i)], i % 3 == 1 ? ToiStatus::invalid : fine)
            << k << " " << off;
      }
    }
  }
}

TEST_P(BatchRowsOfBoxesAndBalls, with_bad_axes_are_invalid_one_by_one) {
  expect_bad_axes_to_be_invalid<float>();
  expect_bad_axes_to_be_invalid<double>();
}

TEST_P(BatchRowsOfBoxesAndBalls, of_axes_that_are_longer_by_eight_roundings_are_of_longer_boxes) {
  using V = Vec3<double>;
  const double longer = 1 + 0x1p-50;
  for (const double half : {0.0, 1.0}) {
    RowTable<Moving<Obb<double>>> boxes;
    RowTable<Moving<Sphere<double>>> balls;
    boxes.push_back(at_rest(Obb<double>{V::Zero(), {8, 8, half}, Mat3<double>(V(1, 1, longer).asDiagonal())}));
    balls.push_back({Sphere<double>{{0, 0, half + 1.25}, 1}, {0, 0, -1}});
    Answers<double> answers(1);
    EXPECT_EQ(time_of_impact(boxes.rows(), balls.rows(), answers.rows()).asked_again, 0U);
    EXPECT_NEAR(answers.time[0], 0.25 - half * 0x1p-50, 0x1p-51);
  }
}

INSTANTIATE_TEST_SUITE_P(Vectors, BatchRowsOfBoxesAndBalls, ::testing::ValuesIn(vector_targets()),
                         [](const auto& name) { return name.param; });

template <class Call> std::string refusal(const Call& call) { return error_of<std::invalid_argument>(call); }

TEST(BatchRefusals, name_what_is_wrong) {
  const BatchRows<Aabb<double>, Sphere<double>> rows(100, 3);
  Answers<double> answers(100), short_one(99);
  EXPECT_EQ(refusal([&] { time_of_impact(rows.a.rows(), rows.b.rows(), short_one.rows()); }),
            "thinwall batch: the statuses have 99 rows, and a column of what is read has 100");
  EXPECT_EQ(refusal([&] {
              time_of_impact(rows.a.rows(), rows.b.rows(), {answers.status, short_one.time});
            }),
            "thinwall batch: the statuses have 100 rows, and a column of the times has 99");
  EXPECT_EQ(refusal([&] {
              RowsOf<Ball> in_place = rows.b.rows();
              in_place.radius = answers.time;
              time_of_impact(rows.a.rows(), in_place, answers.rows());
            }),
            "thinwall batch: the times share memory with what is read");
  EXPECT_EQ(refusal([&] {
              ToiRows<double> out = answers.rows();
              out.normal = {short_one.time, short_one.time, short_one.time};
              time_of_impact(rows.a.rows(0, 99), rows.b.rows(0, 99),
                             {std::span(answers.status).first(99), std::span(answers.time).first(99), out.normal});
            }),
            "thinwall batch: the normals share memory with the normals");
  EXPECT_EQ(refusal([&] { time_of_impact(rows.a.rows(), rows.b.rows(), answers.rows(), {-1}); }),
            "thinwall batch: threads must be at least 0, which takes all; they are -1");
  EXPECT_TRUE(refusal([&] { use_vectors("MMX"); }).starts_with("thinwall batch: no vectors \"MMX\" on this machine"));
}

TEST(BatchRefusals, are_none_for_no_rows) {
  const RowTable<Ball> none;
  Answers<double> answers(0);
  EXPECT_EQ(time_of_impact(none.rows(), none.rows(), answers.rows()).rows, 0U);
}

// ---- Verdicts and times of every pair, at every width.

/// What rounding may turn a time by, in 4 u kappa: swept/toi.hpp's coordinates over the closing speed.
template <class A, class B> double bound_on_time(const A& a, const B& b, const Toi<double>& toi, double u) {
  const Vec3<double> n = toi.normal.cwiseAbs();
  const double closing = std::abs(toi.normal.dot(b.displacement - a.displacement));
  const double lengths =
      n.dot(center(a.shape).cwiseAbs() + center(b.shape).cwiseAbs() + half_widths(a.shape) + half_widths(b.shape) +
            toi.time * (a.displacement.cwiseAbs() + b.displacement.cwiseAbs()));
  return 4 * u * lengths / closing;
}

/// What a width got wrong of the rows it was asked.
template <class S> struct Faults {
  std::size_t wrong = 0, late = 0;
  double worst = 0;  ///< [4 u kappa t]

  template <class A, class B>
  void add(const Moving<A>& a, const Moving<B>& b, const Toi<double>& truth, ToiStatus status, S time) {
    if (status != truth.status) ++wrong;
    if (status != ToiStatus::hit || truth.status != ToiStatus::hit) return;
    const double least = double(std::numeric_limits<S>::denorm_min());  // of a float time
    const double off = std::abs(double(time) - truth.time);
    const double bound =
        bound_on_time(cast<double>(a), cast<double>(b), truth, double(std::numeric_limits<S>::epsilon()) / 2);
    if (off > 3 * bound + least) ++late;  // the scalar code's own 4 u kappa t, and the bound of kappa by half widths
    if (off > least) worst = std::max(worst, off / bound);
  }
  void report(const char* name, const std::string& target, std::size_t rows, std::size_t asked_again) const {
    std::printf("%-16s %-7s %zu rows, %.4f %% asked again; wrong %zu; time off by up to %.2f u kappa t\n", name,
                target.c_str(), rows, 100.0 * double(asked_again) / double(rows), wrong, 4 * worst);
    EXPECT_EQ(wrong, 0U);
    EXPECT_EQ(late, 0U);
  }
};

/// Judges every width on rows of one pair.
template <class A, class B> void judge_rows(const char* name, const BatchRows<A, B>& rows) {
  using S = typename A::Scalar;
  SCOPED_TRACE(name);
  const std::size_t count = rows.truth.size();
  for_each_target([&](const std::string& target) {
    Answers<S> answers(count);
    const BatchReport report = time_of_impact(rows.a.rows(), rows.b.rows(), answers.rows());
    Faults<S> faults;
    for (std::size_t i = 0; i < count; ++i) {
      faults.add(rows.a[i], rows.b[i], rows.truth[i], answers.status[i], answers.time[i]);
    }
    faults.report(name, target, count, report.asked_again);
  });
}

template <class A, class B> void judge_rows(const char* name, std::size_t count) {
  const BatchRows<A, B> rows(count, 7);
  ASSERT_TRUE(rows.has_every_status());
  judge_rows(name, rows);
}

/// The same of one against many, of which the first is its own row: there a first look may tell it apart.
template <class A, class B> void judge_one_against_many(const char* name, std::size_t count) {
  using S = typename A::Scalar;
  SCOPED_TRACE(name);
  constexpr std::size_t many = 16;  // lanes, at the most
  const BatchRows<A, B> rows(count + many, 17);
  for_each_target([&](const std::string& target) {
    Answers<S> answers(many);
    Faults<S> faults;
    std::size_t asked_again = 0;
    for (std::size_t i = 0; i < count; ++i) {
      asked_again += time_of_impact(rows.a[i], rows.b.rows(i, i + many), answers.rows()).asked_again;
      faults.add(rows.a[i], rows.b[i], rows.truth[i], answers.status[0], answers.time[0]);
    }
    faults.report(name, target, count * many, asked_again);
  });
}

/// The same of rays at boxes, held against raycast; and of the first of either against all of the others.
template <class S> void judge_rays(std::size_t count) {
  Shaker<S> draw(11);
  RowTable<Ray<S>> rays;
  RowTable<Aabb<S>> boxes;
  const S longest = std::numeric_limits<S>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const auto motion = batch_motion<Sphere<S>, Aabb<S>>(draw);
    const std::array<S, 6> most = {1, S(0.5), longest, longest, 0, -1};
    rays.push_back({motion.a.shape.center, motion.a.displacement, most[static_cast<std::size_t>(draw.pick(0, 5))]});
    boxes.push_back(motion.b.shape);
  }
  for_each_target([&](const std::string& target) {
    Answers<S> answers(count), one_ray(count), one_box(count);
    const BatchReport report = raycast(rays.rows(), boxes.rows(), answers.rows());
    raycast(rays[0], boxes.rows(), one_ray.rows());
    raycast(rays.rows(), boxes[0], one_box.rows());
    Faults<S> faults;
    for (std::size_t i = 0; i < count; ++i) {
      const Moving<Sphere<S>> point{{rays[i].origin, S(0)}, rays[i].direction};
      const Toi<double> truth = cast<double>(batch::cast(rays[i], boxes[i]));
      faults.add(point, at_rest(boxes[i]), truth, answers.status[i], answers.time[i]);
      const bool is_right = one_ray.status[i] == batch::cast(rays[0], boxes[i]).status &&
                            one_box.status[i] == batch::cast(rays[i], boxes[0]).status;
      faults.wrong += is_right ? 0U : 1U;
    }
    faults.report("ray aabb", target, count, report.asked_again);
  });
}

template <class S> void judge_every_pair() {
  const std::size_t count = thorough(slow_build ? 20'000 : 1'000'000);
  judge_rows<Sphere<S>, Sphere<S>>("sphere sphere", count);
  judge_rows<Aabb<S>, Sphere<S>>("aabb sphere", count);
  judge_rows<Obb<S>, Sphere<S>>("obb sphere", count);
  judge_rows<Capsule<S>, Sphere<S>>("capsule sphere", count);
  judge_rows<Aabb<S>, Aabb<S>>("aabb aabb", count);
  judge_rays<S>(count);
  judge_one_against_many<Aabb<S>, Sphere<S>>("aabb, 1st of 16", count / 10);
  judge_one_against_many<Obb<S>, Sphere<S>>("obb, 1st of 16", count / 10);
}

TEST(BatchVerdicts, are_the_scalar_codes_own_in_double) { judge_every_pair<double>(); }
TEST(BatchVerdicts, are_the_scalar_codes_own_in_float) { judge_every_pair<float>(); }

/// A ball from afar, all but along a capsule, which it meets beside its axis.
template <class S> Motion<Capsule<S>, Sphere<S>> motion_along_axis(Shaker<S>& draw) {
  const Mat3<S> axes = draw.plain_axes();
  const Vec3<S> along = axes.col(0), out = axes.col(1), aside = axes.col(2);
  const S half = power<S>(-draw.pick(0, 6)), radius = power<S>(-draw.pick(3, 9)), lean = S(2) * draw.plain();
  const S tilt = power<S>(-draw.pick(0, 8)), skew = power<S>(-draw.pick(0, 8)), speed = power<S>(draw.pick(0, 5));
  const Vec3<S> path = (along + aside * skew - out * tilt) * speed;
  const Vec3<S> place = along * S(half * draw.plain()) + safe_unit<S>(out + aside * lean) * S(2 * radius);
  const S time = S(draw.pick(1, 63)) / S(64);
  return {at_rest(Capsule<S>{-along * half, along * half, radius}), {{place - path * time, radius}, path}};
}

template <class S> void judge_paths_along_an_axis() {
  Shaker<S> draw(23);
  BatchRows<Capsule<S>, Sphere<S>> rows;
  for (std::size_t i = thorough(20'000); i > 0; --i) rows.push_back(motion_along_axis(draw));
  judge_rows("along an axis", rows);
}

// Where path and axis span a sliver, what rounding leans it along the axis counts by all of the way.
TEST(BatchVerdicts, of_paths_along_an_axis_have_times_to_rounding_in_double) { judge_paths_along_an_axis<double>(); }
TEST(BatchVerdicts, of_paths_along_an_axis_have_times_to_rounding_in_float) { judge_paths_along_an_axis<float>(); }

TEST(BatchVerdicts,
     of_a_long_core_across_the_coordinates_have_times_to_rounding) {  // its roundings move all of it alike
  using V = Vec3<double>;
  const V end(0x1.4818f8ce34e34p+6, 0, -0x1.4818f8ce34e2ep+6), path(-0x1.999999999999ap-4, 0x1.999999999999ap-3, 0.7);
  const V center(0x1.3333333333334p-5, -0x1.b333333333334p-2, -0x1.0ccccccccccccp-2);
  const auto capsules = repeated(at_rest(Capsule<double>{end, -end, 0.15}), 1);
  const auto balls = repeated(Moving<Sphere<double>>{{center, 0x1.999999999999ap-3}, path}, 1);
  for_each_target([&](const std::string&) {
    Answers<double> answers(1);
    time_of_impact(capsules.rows(), balls.rows(), answers.rows());
    EXPECT_NEAR(answers.time[0], 0.375, 1e-15);
  });
}

// ---- A table of spheres, certified: every row is proven, at every width of vector, on the worst motions.

struct CertifiedAnswers {
  std::vector<ToiStatus> verdict;
  std::vector<double> lower, upper;
  explicit CertifiedAnswers(std::size_t rows) : verdict(rows), lower(rows), upper(rows) {}
  CertifiedRows rows() { return {verdict, lower, upper}; }
};

TEST(CertifiedBatch, is_proven_by_the_integers_at_every_width) {
  Shaker<double> draw(1);
  RowTable<Ball> a, b;
  const std::size_t count = thorough(4000);
  for (std::size_t i = 0; i < count; ++i) {
    const auto motion = i % 2 == 0 ? worst_motion<Sphere<double>, Sphere<double>>(draw)
                                   : plain_motion<Sphere<double>, Sphere<double>>(draw);
    a.push_back(motion.a);
    b.push_back(motion.b);
  }
  for_each_target([&](const std::string& target) {
    CertifiedAnswers answers(count);
    const BatchReport report = certified_time_of_impact(a.rows(), b.rows(), answers.rows(), {2});
    std::printf("%-7s %.2f %% asked again\n", target.c_str(), 100.0 * double(report.asked_again) / double(count));
    EXPECT_LT(report.asked_again, count / 2);
    for (std::size_t i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const CertifiedToi toi{answers.verdict[i], answers.lower[i], answers.upper[i], DecidedBy::filter};
      EXPECT_EQ(toi.verdict, certified_time_of_impact(a[i], b[i]).verdict);
      EXPECT_TRUE(judge_exactly(a[i], b[i], toi));
    }
  });
}

TEST(CertifiedBatch, names_what_is_wrong) {
  RowTable<Ball> rows;
  rows.push_back({{{0, 0, 0}, -1}, {1, 0, 0}});
  CertifiedAnswers answers(1);
  certified_time_of_impact(rows[0], rows.rows(), answers.rows());
  EXPECT_EQ(answers.verdict[0], ToiStatus::invalid);
  EXPECT_THROW(certified_time_of_impact(rows[0], rows.rows(), {answers.verdict, answers.lower, answers.lower}),
               std::invalid_argument);
}

}  // namespace
}  // namespace thinwall::testing
