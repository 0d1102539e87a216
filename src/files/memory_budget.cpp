#include "files/memory_budget.h"

namespace limpid {

void MemoryBudget::take(std::int64_t bytes, const std::string& what) {
  if (bytes > left) {
    throw OverLimit(what + ": needs " + std::to_string(bytes) +
                    " bytes of memory, expected at most " + std::to_string(left) +
                    " that are left of the limit");
  }
  left -= bytes;
}

void MemoryBudget::take(std::size_t count, std::size_t size, const std::string& what) {
  constexpr std::size_t kMost = INT64_MAX;
  take(static_cast<std::int64_t>(size > 0 && count > kMost / size ? kMost : count * size), what);
}

}  // namespace limpid
