#pragma once
#include <string>
#include <vector>

namespace limpid {

/// "3, 5-9, 12" for numbers in rising order.
std::string ranges_text(const std::vector<int>& numbers);

}  // namespace limpid
