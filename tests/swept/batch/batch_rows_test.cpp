// What a batch does with its rows, whatever they hold: splits, one against many, threads, vectors, rays, bad input.

#include <gtest/gtest.h>

#include "support/batch_rows.hpp"
#include "support/said.hpp"

namespace thinwall::testing {
namespace {

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

TEST_P(BatchRowsOfBoxesAndBalls, of_rays_are_raycasts) {
  Shaker<double> draw(5);
  RowTable<Ray<double>> rays;
  RowTable<Aabb<double>> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto motion = batch_motion<Sphere<double>, Aabb<double>>(draw);
    const std::array most = {1.0, 0.5, std::numeric_limits<double>::infinity(), 0.0, -1.0};
    rays.push_back({motion.a.shape.center, motion.a.displacement, most[static_cast<std::size_t>(draw.pick(0, 4))]});
    boxes.push_back(motion.b.shape);
  }
  Answers<double> answers(count);
  raycast(rays.rows(), boxes.rows(), answers.rows());
  for (std::size_t i = 0; i < count; ++i) {
    const Toi<double> toi = batch::cast(rays[i], boxes[i]);
    ASSERT_EQ(answers.status[i], toi.status) << i;
    if (toi.status == ToiStatus::hit) {
      ASSERT_NEAR(answers.time[i], toi.time, 1e-9 * toi.time) << i;
    } else if (toi.status != ToiStatus::invalid) {
      ASSERT_EQ(answers.time[i], toi.time) << i;
    }
  }
  Answers<double> one_ray(count), one_box(count);
  raycast(rays[0], boxes.rows(), one_ray.rows());
  raycast(rays.rows(), boxes[0], one_box.rows());
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(one_ray.status[i], batch::cast(rays[0], boxes[i]).status) << i;
    ASSERT_EQ(one_box.status[i], batch::cast(rays[i], boxes[0]).status) << i;
  }
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

}  // namespace
}  // namespace thinwall::testing
