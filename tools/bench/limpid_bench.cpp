// Times the runners and their rivals in one run, each beside its error against the reference: the
// look `realistic` with four lookups of a normal map, and the looks `physical` and `fast`.
#include <cstdio>

#include <malloc.h>

#include "arguments.h"
#include "chain_bench.h"
#include "chain_table.h"
#include "gl_process.h"

namespace limpid::bench {
namespace {

/// Freed memory stays with the process. The OpenCV chain would otherwise spend a third of its time
/// on pages from the kernel for its temporaries; the other rows allocate no memory.
void keep_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
}

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid::bench;
  return run_program("limpid_bench", [&] {
    if (serve_drawing(argc, argv, llvmpipe_chain)) return;
    const Arguments arguments = arguments_of(argc, argv, true);
    keep_memory();
    std::printf("look realistic with four lookups of a normal map; errors against the reference\n");
    for (const char* label : {"1080p", "4K"}) {
      if (!arguments.wants_size(label)) continue;
      ChainBench bench(label, arguments);
      bench.time(arguments.rounds);
      print_table(bench, label, arguments);
    }
  });
}
