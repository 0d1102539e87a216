#pragma once
#include <string>

namespace limpid {

/// A quoted TOML string; control characters are escaped.
std::string toml_text(const std::string& word);

/// The shortest TOML float that parses to the same number, in any locale.
std::string toml_text(double x);

}  // namespace limpid
