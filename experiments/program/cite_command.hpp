#pragma once
/// `thinwall cite`.

#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

Command cite_command();

}  // namespace thinwall
