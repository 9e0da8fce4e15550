#pragma once
/// `thinwall compare`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

Command compare_command();

}  // namespace thinwall
