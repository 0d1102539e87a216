#pragma once
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "limpid/core/error.h"

namespace limpid::bench {

/// The options of a benchmark.
struct Arguments {
  int rounds = 7;    ///< --rounds N, at least 1: the fastest round counts
  std::string simd;  ///< --simd NAME: this instruction set instead of the best one (or of all)
  std::string rows;  ///< --rows TEXT: only rows with the text in their name
  std::string size;  ///< --size 1080p or 4K: this size instead of both

  std::string best_simd() const;
  bool wants_row(const std::string& name) const { return name.find(rows) != std::string::npos; }
  /// Throws Error unless `any` row was selected.
  void expect_rows(bool any) const;
  bool wants_size(std::string_view label) const { return size.empty() || size == label; }
};

/// `has_sizes`: whether the benchmark has the option --size; `rounds`: the default of --rounds.
/// Throws Error for any other argument.
Arguments arguments_of(int argc, char** argv, bool has_sizes = false, int rounds = 7);

/// The body of a program: an exception becomes one sentence on stderr and an exit code.
template <class Body>
int run_program(const char* name, Body&& body) {
  try {
    body();
    return 0;
  } catch (const Error& e) {
    std::fprintf(stderr, "%s: %s\n", name, e.what());
    return e.fault() == Fault::kUsage ? 2 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", name, e.what());
    return 1;
  }
}

}  // namespace limpid::bench
