#include "arguments.h"

#include <charconv>

#include "limpid/core/simd.h"

namespace limpid::bench {
namespace {

int number_of_rounds(std::string_view text) {
  int rounds = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, rounds);
  if (read.ec != std::errc() || read.ptr != end || rounds < 1) {
    throw Error("--rounds " + std::string(text) + ": expected a number from 1 on", Fault::kUsage);
  }
  return rounds;
}

}  // namespace

std::string Arguments::best_simd() const { return simd.empty() ? simd_targets()[0] : simd; }

void Arguments::expect_rows(bool any) const {
  if (!any) throw Error("--rows " + rows + ": no row has this in its name", Fault::kUsage);
}

Arguments arguments_of(int argc, char** argv, bool has_sizes, int rounds) {
  Arguments arguments;
  arguments.rounds = rounds;
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    if (option == "--rounds") {
      arguments.rounds = number_of_rounds(value);
    } else if (option == "--simd") {
      arguments.simd = value;
      simd_index(value);
    } else if (option == "--rows" && !value.empty()) {
      arguments.rows = value;
    } else if (option == "--size" && has_sizes) {
      if (value != "1080p" && value != "4K") {
        throw Error("--size " + value + ": expected 1080p or 4K", Fault::kUsage);
      }
      arguments.size = value;
    } else {
      throw Error("'" + option + "': expected --rounds N, --simd NAME, --rows TEXT" +
                      (has_sizes ? " or --size 1080p|4K" : ""),
                  Fault::kUsage);
    }
  }
  return arguments;
}

}  // namespace limpid::bench
