#include <thinwall/experiments/bouncing/impacts.hpp>

namespace thinwall {

std::int64_t fly_between(FlyingBall& ball, std::span<FlyingWall> walls, double seconds) {
  std::int64_t impacts = 0;
  for (double left = seconds;;) {
    const FlyingWall* struck = nullptr;
    Toi<double> first;
    for (const FlyingWall& wall : walls) {
      const auto toi = next_impact(ball, wall);
      if (!toi || toi->time > left || (struck != nullptr && toi->time >= first.time)) continue;
      struck = &wall;
      first = *toi;
    }
    const double flight = struck != nullptr ? first.time : left;
    ball.fly(flight);
    for (FlyingWall& wall : walls) wall.fly(flight);
    if (struck == nullptr) return impacts;
    left -= flight;
    ball.velocity -= first.normal * (2 * (ball.velocity - struck->velocity).dot(first.normal));
    ++impacts;
  }
}

std::int64_t fly_together(std::vector<FlyingBall>& balls, double seconds) {
  std::int64_t impacts = 0;
  for (double left = seconds;;) {
    FlyingBall *a = nullptr, *b = nullptr;
    Toi<double> first;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      for (std::size_t j = i + 1; j < balls.size(); ++j) {
        const auto toi = next_impact(balls[i], balls[j]);
        if (!toi || toi->time > left || (a != nullptr && toi->time >= first.time)) continue;
        a = &balls[i];
        b = &balls[j];
        first = *toi;
      }
    }
    const double flight = a != nullptr ? first.time : left;
    for (FlyingBall& ball : balls) ball.fly(flight);
    if (a == nullptr) return impacts;
    left -= flight;
    const LineSpeeds<double> before = {a->velocity.dot(first.normal), b->velocity.dot(first.normal)};
    const LineSpeeds<double> after = after_impact(before, 1.0, 1.0, 1.0);
    a->velocity += first.normal * (after.a - before.a);
    b->velocity += first.normal * (after.b - before.b);
    ++impacts;
  }
}

}  // namespace thinwall
