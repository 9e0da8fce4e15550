#pragma once
/// `thinwall reproduce`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

Command reproduce_command();

}  // namespace thinwall
