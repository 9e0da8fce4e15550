#pragma once
/// `thinwall validate`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

/// Its exit code is 1 if any verdict is wrong.
Command validate_command();

}  // namespace thinwall
