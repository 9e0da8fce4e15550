#pragma once
/// Ctrl-C and SIGTERM as a question that a long loop asks.

namespace thinwall {

/// From now on SIGINT and SIGTERM only set a flag. A second one ends the program at once.
void watch_for_stop();

/// True once one of them has come.
bool stop_requested();

}  // namespace thinwall
