#pragma once
#include <string>

/// Numbers in progress lines, in the same format as the script of the pages.

namespace limpid {

/// A short number: three digits, as a decimal from 0.001 to 99999, else as 5.9·10⁻⁷. "∞" and "-"
/// for infinity and NaN.
std::string short_number(double value);

/// The shortest decimal that reads back as the number, without a power of ten.
std::string plain_number(double value);

}  // namespace limpid
