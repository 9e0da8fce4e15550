#pragma once
/// Is a text an XML document that every reader takes?

#include <string>
#include <string_view>

namespace thinwall {

/// What is ill-formed in it, with the line; empty if nothing is. An internal subset of a DOCTYPE is not read, nor entities of its own.
std::string xml_fault(std::string_view text);

}  // namespace thinwall
