#pragma once
/// `thinwall list`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

Command list_command();

}  // namespace thinwall
