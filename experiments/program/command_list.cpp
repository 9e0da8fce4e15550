#include <array>

#include <thinwall/experiments/program/advise_command.hpp>
#include <thinwall/experiments/program/cite_command.hpp>
#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/compare_command.hpp>
#include <thinwall/experiments/program/completion_command.hpp>
#include <thinwall/experiments/program/list_command.hpp>
#include <thinwall/experiments/program/merge_command.hpp>
#include <thinwall/experiments/program/plan_command.hpp>
#include <thinwall/experiments/program/report_command.hpp>
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
      advise_command(),      //
      validate_command(),    //
      merge_command(),       //
      report_command(),      //
      reproduce_command(),   //
      cite_command(),        //
      completion_command(),  //
  };
  return all;
}

}  // namespace thinwall
