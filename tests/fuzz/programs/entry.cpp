// What libFuzzer calls; LIMPID_HARNESS is one of harness.h.
#include <cstddef>

#include "fuzz/harness.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  limpid::fuzz::LIMPID_HARNESS({bytes, size});
  return 0;
}
