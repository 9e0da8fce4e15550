#pragma once
/// `thinwall advise`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

Command advise_command();

}  // namespace thinwall
