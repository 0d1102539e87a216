#pragma once
#include <cstdint>
#include <string>

#include "limpid/core/error.h"

namespace limpid {

/// That a file asks for more than the limits allow: not a fault of the part that does.
class OverLimit : public Error {
 public:
  using Error::Error;
};

/// The memory that a model may still take.
struct MemoryBudget {
  std::int64_t left;
  /// Throws OverLimit when it is used up.
  void take(std::int64_t bytes, const std::string& what) {
    if (bytes > left) {
      throw OverLimit(what + ": needs " + std::to_string(bytes) +
                      " bytes of memory, expected at most " + std::to_string(left) +
                      " that are left of the limit");
    }
    left -= bytes;
  }
  /// The same for `count` things of a size.
  void take(std::size_t count, std::size_t size, const std::string& what) {
    constexpr std::size_t kMost = INT64_MAX;
    take(static_cast<std::int64_t>(size > 0 && count > kMost / size ? kMost : count * size), what);
  }
};

}  // namespace limpid
