#pragma once
/// Numbers in the words of the advice.

#include <string>

#include <thinwall/experiments/advise/wish.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

std::string percent_text(double chance);       ///< "70 %", "0"
std::string tunnel_words(double chance);       ///< "no shot tunnels", "1 % of the shots tunnel"
std::string question_words(const Wish& wish);  ///< two sentences, a line each: what flies, and its measures
std::string wanted_words(const Wish& wish);    ///< "no shot tunnels, and ..."

/// As rounded_text, but never more than `value` > 0: a bound that is safe to keep to.
std::string rounded_down_text(double value, int digits);

/// `text` in lines of at most `width` columns, broken between words, each ended by a newline.
std::string wrapped(const std::string& text, std::size_t width = 100);

}  // namespace thinwall
