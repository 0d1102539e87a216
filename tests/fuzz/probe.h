#pragma once
#include <functional>
#include <string>

namespace limpid::fuzz {

/// How a piece of work in a process of its own ended.
struct Outcome {
  enum class End { kAccepted, kRefused, kBroken };
  End end = End::kBroken;
  std::string cause;     ///< of kBroken: "signal 11 (Segmentation fault)"
  double seconds = 0;    ///< of the processor
  long long memory = 0;  ///< most bytes resident at once
};

/// Runs `work` in a child of this process, which should have no other threads. Work that throws
/// Error is refused; any other exception, a signal, and `most_seconds` of the processor or ten
/// times as many of wall-clock time are broken. `address_space`, in bytes, is the most that the
/// child can allocate; 0 sets no limit, because programs with a sanitizer reserve terabytes.
Outcome probe(const std::function<void()>& work, int most_seconds, long long address_space = 0);

}  // namespace limpid::fuzz
