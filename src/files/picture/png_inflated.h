#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace limpid {

/// Throws Error for a PNG in memory whose pixels inflate to more than `most` bytes or not at all,
/// or whose first chunk is not the header: readers that grow what they inflate into as long as
/// there is more would follow it to the end of memory. check_whole() has passed it.
void check_inflated(std::string_view png, std::int64_t most, const std::string& name);

}  // namespace limpid
