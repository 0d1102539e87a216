#include "chain_table.h"

#include <cstdio>

namespace limpid::bench {
namespace {

/// Seconds of a row, 0 if the row is missing.
double seconds(const ChainBench& bench, const std::string& name) {
  for (const ChainRow& row : bench.rows()) {
    if (row.name == name) return row.best_seconds;
  }
  return 0;
}

void print_row(const ChainRow& row, double pixels, double rival) {
  std::printf("  %-38s %9.2f %9.1f", row.name.c_str(), 1e9 * row.best_seconds / pixels,
              1e3 * row.best_seconds);
  if (rival > 0) {
    std::printf(" %9.2f", rival / row.best_seconds);
  } else {
    std::printf(" %9s", "");
  }
  if (row.judged) {
    std::printf(" %11.2e %10.2e %10.2e", row.error.mean, row.error.p9999, row.error.max);
  }
  std::printf("\n");
}

/// The two rows whose times are compared.
struct Ratio {
  std::string of, to;
};

std::vector<Ratio> goals(const std::string& fused) {
  std::vector<Ratio> ratios;
  for (const char* rival :
       {"OpenCV chain", "llvmpipe", "scalar loop, -O3", "scalar loop, -march=native"}) {
    for (const char* threads : {", 1 thread", ", 2 threads"}) {
      ratios.push_back({rival + std::string(threads), fused + threads});
    }
  }
  for (const char* threads : {", 1 thread", ", 2 threads"}) {
    ratios.push_back({fused + threads, "memory floor" + std::string(threads)});
  }
  ratios.push_back({fused + ", 1 thread", fused + ", 2 threads"});
  ratios.push_back({"fused avx2, 1 thread", "fused avx512, 1 thread"});
  ratios.push_back({fused + ", look physical, 1 thread", fused + ", 1 thread"});
  ratios.push_back({fused + ", look fast, 1 thread", fused + ", 1 thread"});
  return ratios;
}

}  // namespace

void print_table(const ChainBench& bench, const std::string& label, const Arguments& arguments) {
  const Size size = size_of(label);
  const std::string renderer = bench.renderer();
  std::printf("%s, %dx%d, %.0f %% wet, best of %d rounds%s%s\n", label.c_str(), size.width,
              size.height, 100 * bench.plate().wet_share(), arguments.rounds,
              renderer.empty() ? "" : "; OpenGL is ", renderer.c_str());
  std::printf("  %-38s %9s %9s %9s %11s %10s %10s\n", "runner", "ns/pixel", "ms", "x OpenCV",
              "mean error", "p99.99", "max");
  const double rival = seconds(bench, "OpenCV chain, 1 thread");
  for (const ChainRow& row : bench.rows()) {
    print_row(row, double(size.width) * size.height, rival);
  }
  for (const Ratio& ratio : goals("fused " + arguments.best_simd())) {
    const double of = seconds(bench, ratio.of), to = seconds(bench, ratio.to);
    if (of > 0 && to > 0) {
      std::printf("  %-38s / %-28s %8.2f\n", ratio.of.c_str(), ratio.to.c_str(), of / to);
    }
  }
  if (const auto error = bench.fast_error()) {
    std::printf(
        "  look fast against look physical, both by the reference: mean %.2e, p99.99 %.2e, "
        "max %.2e\n",
        error->mean, error->p9999, error->max);
  }
  std::fflush(stdout);
}

}  // namespace limpid::bench
