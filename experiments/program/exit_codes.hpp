#pragma once
/// What the program says to the shell.

namespace thinwall {

inline constexpr int exit_done = 0;           ///< done, and nothing was found wrong
inline constexpr int exit_failed = 1;         ///< it ran and found something wrong, or the system failed it
inline constexpr int exit_bad_input = 2;      ///< the command line, a configuration or a file of the user's
inline constexpr int exit_interrupted = 130;  ///< Ctrl-C; what was done is kept

}  // namespace thinwall
