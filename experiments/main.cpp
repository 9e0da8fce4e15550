#include <iostream>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/program/program.hpp>

int main(int argc, char** argv) {
  return thinwall::run_program({argv, argv + argc}, thinwall::experiments(), std::cout, std::cerr);
}
