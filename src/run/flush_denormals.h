#pragma once
#include "core/lanes.h"

/// For inclusion by lanes_target.cpp alone.

namespace limpid::HWY_NAMESPACE {

/// While it lives, denormal floats in this thread, inputs and results, count as 0: high powers of
/// small numbers produce many denormals, and each may take longer than a hundred other operations.
/// Copies keep their bits. Does nothing on CPUs without this mode.
class FlushDenormals {
 public:
#if defined(__x86_64__)
  FlushDenormals() { __builtin_ia32_ldmxcsr(before_ | kFlushAndZero); }
  ~FlushDenormals() { __builtin_ia32_ldmxcsr(before_); }

 private:
  static constexpr unsigned kFlushAndZero = 0x8040;  // FTZ of results, DAZ of operands
  const unsigned before_ = __builtin_ia32_stmxcsr();
#elif defined(__aarch64__)
  FlushDenormals() {
    asm volatile("mrs %0, fpcr" : "=r"(before_));
    asm volatile("msr fpcr, %0" : : "r"(before_ | kFlush));
  }
  ~FlushDenormals() { asm volatile("msr fpcr, %0" : : "r"(before_)); }

 private:
  static constexpr std::uint64_t kFlush = 1u << 24;  // FZ
  std::uint64_t before_;
#else
  FlushDenormals() {}
#endif

 public:
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
};

}  // namespace limpid::HWY_NAMESPACE
