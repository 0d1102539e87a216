#pragma once
#include <cstdint>
#include <string>

#include "limpid/core/error.h"

namespace limpid {

/// A file exceeds the limits: not a fault of a single part.
class OverLimit : public Error {
 public:
  using Error::Error;
};

/// The remaining memory for a model.
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
  /// The same for `count` objects of a size.
  void take(std::size_t count, std::size_t size, const std::string& what) {
    constexpr std::size_t kMost = INT64_MAX;
    take(static_cast<std::int64_t>(size > 0 && count > kMost / size ? kMost : count * size), what);
  }
};

}  // namespace limpid
