#pragma once
/// `thinwall merge`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

Command merge_command();

}  // namespace thinwall
