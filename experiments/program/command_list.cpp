#include <array>

#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/compare_command.hpp>
#include <thinwall/experiments/program/completion_command.hpp>
#include <thinwall/experiments/program/list_command.hpp>
#include <thinwall/experiments/program/plan_command.hpp>
#include <thinwall/experiments/program/reproduce_command.hpp>
#include <thinwall/experiments/program/run_command.hpp>
#include <thinwall/experiments/program/validate_command.hpp>

namespace thinwall {

std::span<const Command> commands() {
  static const std::array all = {
      list_command(),        //
      run_command(),         //
      compare_command(),     //
      plan_command(),        //
      reproduce_command(),   //
      validate_command(),    //
      completion_command(),  //
  };
  return all;
}

}  // namespace thinwall
