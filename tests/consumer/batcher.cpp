// Fires a table of balls at a wall.

#include <thinwall/swept/batch.hpp>
#include <thinwall/swept/batch/table.hpp>

#include <vector>

int main() {
  using namespace thinwall;
  RowTable<Moving<Sphere<double>>> balls;
  for (int i = 0; i < 100; ++i) balls.push_back({{{-10, i - 50.0, 0}, 0.25}, {1000, 0, 0}});
  std::vector<ToiStatus> status(balls.size());
  std::vector<double> time(balls.size());
  const auto wall = at_rest(Aabb<double>{{0, 0, 0}, {0.001, 8, 8}});
  time_of_impact(wall, balls.rows(), ToiRows<double>{status, time}, {2});
  return status[50] == ToiStatus::hit && status[0] == ToiStatus::apart ? 0 : 1;
}
