#pragma once
#include <string>
#include <string_view>

namespace limpid {

/// Text as it stands between tags and in attributes of HTML, SVG and XML alike. Control characters,
/// which XML cannot hold, become '?'.
std::string escaped(std::string_view text);

/// A coordinate: at most two digits after the point, no locale, never "-0".
std::string coordinate(double value);

/// A number to read: three digits, as a decimal from 0.001 to 99999, else as 5.9·10⁻⁷. "∞" and "-"
/// for what is none.
std::string short_number(double value);

/// A number as it was written by hand: as many digits as it takes, no power of ten.
std::string plain_number(double value);

/// A power of ten times 1 ... 9, as on a logarithmic axis: 200, 0.05, 10⁻⁵, 2·10⁻⁵.
std::string tick_number(int digit, int power);

}  // namespace limpid
