#pragma once
/// What a mistyped word may have meant.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace thinwall {

/// The fewest letters to insert, delete, replace or swap with their neighbor that turn `a` into `b`; case is ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`; empty if none is near enough to be what was meant.
std::string_view nearest_spelling(std::string_view word, std::span<const std::string_view> candidates);

/// The end of a complaint: `did you mean 'radius'? (allowed: angle, radius)`; if nothing is near, `allowed: angle, radius`.
std::string spelling_hint(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace thinwall
