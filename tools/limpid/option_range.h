#pragma once
#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

/// Ranges of options. A value out of range is wrong usage, reported when the command line is
/// parsed: the sentence names option, value and range.

namespace limpid::tool {

/// A number in the range, ends included, in the unit if there is one. An infinite end means "from
/// ... up" and does not allow infinity.
CLI::Validator number_in(double least, double most, const std::string& unit = "");
/// Any finite number above 0.
CLI::Validator number_above_zero();
/// A whole number of the range, ends included.
CLI::Validator whole_number_in(std::int64_t least, std::uint64_t most);

}  // namespace limpid::tool
