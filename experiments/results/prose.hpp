#pragma once
/// What docs/NAME.md says about an experiment, for its report: the page is embedded in the program as its defaults are.

#include <string>
#include <string_view>

namespace thinwall {

struct Prose {
  std::string method;  ///< HTML of its sections, but for its results, which are of another run, and its limits
  std::string limits;  ///< HTML of the section "Limits"
  std::string pages;   ///< HTML of the pages that those link to, folded: a report needs no other file
};

/// Links lead to the section or the page in the report; one to another file of the project becomes its words, one to the web its
/// words and the address.
/// Empty where there is no such page.
Prose prose_of(std::string_view experiment);

}  // namespace thinwall
