/// The shots of the thin wall and the response to them, without any method under test.
#include <thinwall/experiments/thin_wall/model.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/thin_wall/methods.hpp>

namespace thinwall {
namespace {

const std::vector<Cell> cells = {
    bullet,
    {2000, 1.0 / 30, 0.001, 0.0001, 80, Wall::infinite, 0},
    {1, 0.001, 0.02, 0.1, 80, Wall::infinite, 0},
    {700, 1.0 / 60, 0, 0.0001, 30, Wall::infinite, 0},
    {50, 1.0 / 60, 0.02, 0.1, 0, Wall::finite, 1},
    {2000, 1.0 / 30, 0.02, 0, 60, Wall::finite, 0.3},
    {1, 0.001, 0.02, 0.1, 80, Wall::finite, 1},
};

bool float_holds(const Vec3<double>& v) { return v.cast<float>().cast<double>() == v; }

/// Of every pose, and of every step: so both scalars are asked the same question.
TEST(ThinWallShots, float_holds_every_pose) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    EXPECT_TRUE(float_holds(aimed.displacement) && float_holds(aimed.half_extents)) << cell_factors().key(cell);
    EXPECT_EQ(static_cast<double>(static_cast<float>(aimed.radius)), aimed.radius);
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
      const Vec3<double> start = random_start(aimed, random_stream(cell, 1), trial);
      Vec3<double> pose = start;
      for (int k = 0; !is_past(aimed, pose); pose = start + ++k * aimed.displacement) ASSERT_TRUE(float_holds(pose));
      ASSERT_TRUE(float_holds(pose)) << cell_factors().key(cell);
    }
  }
}

/// So that a rounded wall cannot let through what the one in the settings stops.
TEST(ThinWallShots, rounding_only_helps_the_wall) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    const Vec3<double> step = step_length(cell) * direction(cell);
    EXPECT_GE(aimed.radius, cell.radius);
    EXPECT_GE(2 * aimed.half_extents[0], cell.thickness);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(aimed.displacement[i], step[i]);
      EXPECT_NEAR(aimed.displacement[i], step[i], 1e-3 * step[i]);
    }
  }
}

TEST(ThinWallShots, start_before_contact_by_at_most_two_steps_of_the_plane) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    for (std::uint64_t trial = 0; trial < 1000; ++trial) {
      const Vec3<double> start = random_start(aimed, random_stream(cell, 1), trial);
      ASSERT_GE(gap(aimed, start), 0) << cell_factors().key(cell);
      ASSERT_FALSE(is_past(aimed, start));
      if (cell.wall == Wall::infinite) {
        ASSERT_LE(path_to_contact(aimed, start), aimed.step_length * (1 + 1e-6));
      }
    }
  }
}

/// The ball touches where the path says, to rounding.
TEST(ThinWallShots, path_ends_at_contact) {
  for (const Cell& cell : cells) {
    const Target aimed = target(cell);
    for (std::uint64_t trial = 0; trial < 1000; ++trial) {
      const Vec3<double> start = random_start(aimed, random_stream(cell, 1), trial);
      const double path = path_to_contact(aimed, start);
      const Vec3<double> contact = start + path / aimed.step_length * aimed.displacement;
      ASSERT_NEAR(gap(aimed, contact), 0, 1e-13 * (1 + start.norm())) << cell_factors().key(cell);
      ASSERT_GE(gap(aimed, (start + contact) / 2), 0);
    }
  }
}

TEST(ThinWallShots, phase_is_uniform) {
  const Target aimed = target(bullet);
  std::vector<double> counts(50);
  for (std::uint64_t trial = 0; trial < 50000; ++trial) {
    const double phase =
        path_to_contact(aimed, random_start(aimed, random_stream(bullet, 3), trial)) / aimed.step_length;
    ++counts[std::min<std::size_t>(49, static_cast<std::size_t>(50 * phase))];
  }
  double sum = 0;
  for (const double count : counts) sum += (count - 1000) * (count - 1000) / 1000;
  EXPECT_TRUE(chi_square_range(49, 0.9999).contains(sum)) << sum;
}

/// Head-on, the share of lines that meet the wall itself is its face over its shadow; the others meet the rim only.
TEST(ThinWallShots, aim_is_uniform_over_the_shadow) {
  const Cell cell = {10, 1.0 / 60, 0.2, 0.1, 0, Wall::finite, 1};
  const Target aimed = target(cell);
  std::int64_t face = 0, upper_half = 0;
  constexpr std::int64_t shots = 50000;
  for (std::uint64_t trial = 0; trial < shots; ++trial) {
    const Vec3<double> start = random_start(aimed, random_stream(cell, 3), trial);
    face += std::max(std::abs(start[1]), std::abs(start[2])) <= 0.5 ? 1 : 0;
    upper_half += start[2] > 0 ? 1 : 0;
  }
  EXPECT_LT(std::abs(standard_residual(face, shots, 1 / shadow(rounded_box(cell), {1, 0, 0}))), 4);
  EXPECT_LT(std::abs(standard_residual(upper_half, shots, 0.5)), 4);
}

TEST(ThinWallShots, depend_on_the_physical_factors_and_the_seed_alone) {
  const Target aimed = target(bullet);
  EXPECT_EQ(random_start(aimed, random_stream(bullet, 1), 7), random_start(aimed, random_stream(bullet, 1), 7));
  EXPECT_NE(random_start(aimed, random_stream(bullet, 1), 7), random_start(aimed, random_stream(bullet, 2), 7));
  EXPECT_NE(random_start(aimed, random_stream(bullet, 1), 7), random_start(aimed, random_stream(bullet, 1), 8));
  Cell faster = bullet;
  faster.speed = 11;
  EXPECT_NE(random_stream(bullet, 1).stream, random_stream(faster, 1).stream);
}

TEST(ThinWallBounce, pushes_out_to_touch_and_reflects) {
  const Target wall = target(bullet);
  const double face = wall.half_extents[0] + wall.radius;
  Flight shallow = {{-face + 0.01, 0, 0}, {0.1, 0.05, 0}};
  respond(wall, {1, 0, 0}, shallow);
  EXPECT_NEAR(shallow.position[0], -face, 1e-15);
  EXPECT_EQ(shallow.displacement, Vec3<double>(-0.1, 0.05, 0));
  Flight deep = {{0.001, 0, 0}, {0.1, 0.05, 0}};  // past the middle: the way out leads ahead
  respond(wall, {-1, 0, 0}, deep);
  EXPECT_NEAR(deep.position[0], face, 1e-15);
  EXPECT_EQ(deep.displacement, Vec3<double>(0.1, 0.05, 0));
  Flight early = {{-face - 0.01, 0, 0}, {0.1, 0, 0}};  // seen before contact: reflected where it is
  respond(wall, {1, 0, 0}, early);
  EXPECT_EQ(early.position[0], -face - 0.01);
  EXPECT_TRUE(has_left(wall, early));
}

/// Points uniform in the rounded box, and the normal that the library gives there.
TEST(ThinWallBounce, unturned_share_is_what_the_normals_say) {
  const RoundedBox box = {{0.1, 0.6, 0.6}, 0.25};
  for (const double angle : {0.0, 0.5, 1.2}) {
    const Vec3<double> direction(std::cos(angle), angle == 0 ? 0 : std::sin(angle), 0);
    const RandomStream stream{5, 7};
    std::int64_t inside = 0, unturned = 0;
    for (std::uint64_t trial = 0; trial < 100000; ++trial) {
      const RandomWords words = random_words(stream, trial, 0);
      Vec3<double> point;
      for (int i = 0; i < 3; ++i)
        point[i] = (2 * uniform(words[static_cast<std::size_t>(i)]) - 1) * (box.half_extents[i] + box.radius);
      const auto found =
          separation(Sphere<double>{point, box.radius}, Aabb<double>{Vec3<double>::Zero(), box.half_extents});
      if (found.distance > 0) continue;
      ++inside;
      unturned += found.normal.dot(direction) > 0 ? 0 : 1;
    }
    const double spacing = 2 * longest_chord(box, direction), lines = spacing * shadow(box, direction);
    const double missed = 1 - volume(box) / lines;
    const double expected = (*unturned_probability(box, direction, spacing) - missed) / (volume(box) / lines);
    EXPECT_LT(std::abs(standard_residual(unturned, inside, expected)), 4) << angle;
    EXPECT_FALSE(unturned_probability(box, direction, longest_chord(box, direction) / 2));
  }
}

}  // namespace
}  // namespace thinwall
