#pragma once
/// `thinwall completion`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

Command completion_command();

}  // namespace thinwall
