#pragma once
/// What a TOML text nests too deeply, told before a parser sees it.

#include <string_view>

namespace thinwall {

/// The line, from 1, of the first key of more than `most` parts, as `a.b.c` has three; 0 if there is none. Nested arrays
/// and inline tables are bounded by the parser itself.
int line_of_deep_key(std::string_view text, int most);

}  // namespace thinwall
