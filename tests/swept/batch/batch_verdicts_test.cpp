// Ten million rows, plain and the worst: every vector width gives the scalar code's verdicts, and its times to the bound.
// THINWALL_THOROUGH=100 tests_swept --gtest_filter='BatchVerdicts*' judges a hundred times as many.

#include <cstdio>

#include <gtest/gtest.h>

#include <thinwall/swept/certified_batch.hpp>

#include "support/batch_rows.hpp"
#include "support/certified.hpp"

namespace thinwall::testing {
namespace {

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

/// Judges every width on `count` rows of one pair.
template <class A, class B> void judge_rows(const char* name, std::size_t count) {
  using S = typename A::Scalar;
  SCOPED_TRACE(name);
  const BatchRows<A, B> rows(count, 7);
  ASSERT_TRUE(rows.has_every_status());
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

/// The same of verdicts of rays at boxes, held against raycast.
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
    Answers<S> answers(count);
    const BatchReport report = raycast(rays.rows(), boxes.rows(), answers.rows());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (answers.status[i] != batch::cast(rays[i], boxes[i]).status) ++wrong;
    }
    std::printf("%-16s %-7s %zu rows, %.4f %% asked again; wrong %zu\n", "ray aabb", target.c_str(), count,
                100.0 * double(report.asked_again) / double(count), wrong);
    EXPECT_EQ(wrong, 0U);
  });
}

template <class S> void judge_every_pair() {
  const std::size_t count = batch_rows_to_judge(1'000'000);
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

// ---- A table of spheres, certified: every row is proven, at every width of vector, on the worst motions.

using Ball = Sphere<double>;

struct CertifiedAnswers {
  std::vector<ToiStatus> verdict;
  std::vector<double> lower, upper;
  explicit CertifiedAnswers(std::size_t rows) : verdict(rows), lower(rows), upper(rows) {}
  CertifiedRows rows() { return {verdict, lower, upper}; }
};

TEST(CertifiedBatch, is_proven_by_the_integers_at_every_width) {
  Shaker<double> draw(1);
  RowTable<Moving<Ball>> a, b;
  const std::size_t count = thorough(4000);
  for (std::size_t i = 0; i < count; ++i) {
    const Motion<Ball, Ball> motion = i % 2 == 0 ? worst_motion<Ball, Ball>(draw) : plain_motion<Ball, Ball>(draw);
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
  RowTable<Moving<Ball>> rows;
  rows.push_back({{{0, 0, 0}, -1}, {1, 0, 0}});
  CertifiedAnswers answers(1);
  certified_time_of_impact(rows[0], rows.rows(), answers.rows());
  EXPECT_EQ(answers.verdict[0], ToiStatus::invalid);
  EXPECT_THROW(certified_time_of_impact(rows[0], rows.rows(), {answers.verdict, answers.lower, answers.lower}),
               std::invalid_argument);
}

}  // namespace
}  // namespace thinwall::testing
