#pragma once
/// The advice in words, for a terminal, and as JSON, for a script.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <thinwall/experiments/advise/advice.hpp>

namespace thinwall {

/// The advice itself: a sentence or two, of one line.
std::string advice_sentence(const Advice& advice);

/// All of it, at most 100 columns wide, ended by a newline.
std::string advice_text(const Advice& advice);

/// Every number, keys in order.
nlohmann::ordered_json advice_json(const Advice& advice);

}  // namespace thinwall
