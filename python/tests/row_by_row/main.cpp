#include "row_by_row.hpp"

namespace {

template <class S> bool ask(const thinwall::row_by_row::Task& task) {
  using namespace thinwall::row_by_row;
  if (task.query == "time_of_impact") return in_time<S>(task);
  if (task.query == "method" || task.query == "turning") return by_method<S>(task);
  return at_rest<S>(task);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace thinwall::row_by_row;
  if (argc != 7) return 2;
  const Task task{argv[1], argv[3], argv[4], argv[6], std::strtoul(argv[5], nullptr, 10)};
  const bool is_float = std::string(argv[2]) == "float32";
  const bool asked = task.query == "certified" ? certified(task) : is_float ? ask<float>(task) : ask<double>(task);
  return asked ? 0 : 2;  // no such pair
}
