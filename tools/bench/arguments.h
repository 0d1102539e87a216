#pragma once
#include <charconv>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"

namespace limpid::bench {

/// What every benchmark can be told.
struct Arguments {
  int rounds = 7;    ///< --rounds N, at least 1: the best one counts
  std::string simd;  ///< --simd NAME: this instruction set instead of the best (or all) there are

  std::string best_simd() const { return simd.empty() ? simd_targets()[0] : simd; }
};

/// Throws Error for anything else on the command line.
inline Arguments arguments_of(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view option = argv[i];
    if ((option != "--rounds" && option != "--simd") || i + 1 == argc) {
      throw Error("'" + std::string(option) + "': expected --rounds N or --simd NAME",
                  Fault::kUsage);
    }
    const std::string_view value = argv[i + 1];
    if (option == "--simd") {
      arguments.simd = value;
      simd_index(arguments.simd);
      continue;
    }
    const char* end = value.data() + value.size();
    const auto read = std::from_chars(value.data(), end, arguments.rounds);
    if (read.ec != std::errc() || read.ptr != end || arguments.rounds < 1) {
      throw Error("--rounds " + std::string(value) + ": expected a number from 1 on",
                  Fault::kUsage);
    }
  }
  return arguments;
}

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
