#pragma once
#include <string>

/// Numbers as lines of progress have them, and as the script of the pages writes them, too.

namespace limpid {

/// A number to read: three digits, as a decimal from 0.001 to 99999, else as 5.9·10⁻⁷. "∞" and "-"
/// for what is none.
std::string short_number(double value);

/// A number as it was written by hand: as many digits as it takes, no power of ten.
std::string plain_number(double value);

}  // namespace limpid
