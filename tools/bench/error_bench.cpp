// Speed against error: variants of refraction on the plate lagoon, each with its time and its error
// against a path-traced picture of the same water.
#include <cstdio>
#include <string>
#include <vector>

#include "arguments.h"
#include "judge/report/lagoon.h"
#include "judge/report/picture.h"
#include "rows.h"

namespace limpid::bench {
namespace {

struct VariantRow : Row {
  Plan plan;
  TruthError error = {};
};

std::vector<VariantRow> rows_of(const Lagoon& lagoon) {
  std::vector<VariantRow> rows;
  for (const Lagoon::Refracted& variant : Lagoon::refraction_variants()) {
    VariantRow& row = rows.emplace_back();
    row.name = variant.name;
    row.plan = lagoon.plan(variant.look);
  }
  return rows;
}

void bench(const Arguments& arguments) {
  const Lagoon lagoon(LIMPID_DATA "/plates/lagoon");
  const std::string simd = arguments.best_simd();
  const auto executor = make_executor(1);
  const Picture picture(lagoon.window());
  std::vector<VariantRow> rows = rows_of(lagoon);
  std::erase_if(rows, [&](const VariantRow& row) { return !arguments.wants_row(row.name); });
  arguments.expect_rows(!rows.empty());
  for (VariantRow& row : rows) {
    row.run = [&] {
      return seconds_of([&] { lagoon.run(row.plan, picture.target, *executor, simd); });
    };
    row.run();
    row.error = lagoon.error_of(picture.color());
  }
  time_rows(rows, arguments.rounds);

  const Size size = lagoon.window().size();
  const double pixels = double(size.width) * size.height;
  std::printf("lagoon, calm, %dx%d, %.0f %% wet; of these %.1f %% in frame\n", size.width,
              size.height, 100 * lagoon.wet_share(), 100 * lagoon.in_frame_share());
  std::printf(
      "error: mean |picture - truth| / mean truth, values clipped at 4; "
      "time: fused %s, 1 thread, best of %d rounds\n",
      simd.c_str(), arguments.rounds);
  std::printf("  %-24s %10s %10s %10s\n", "refraction", "all wet", "in frame", "ns/pixel");
  const TruthError dry = lagoon.error_of(lagoon.dry());
  std::printf("  %-24s %10.4f %10.4f %10s\n", "no water at all", dry.wet, dry.in_frame, "");
  for (const VariantRow& row : rows) {
    std::printf("  %-24s %10.4f %10.4f %10.2f\n", row.name.c_str(), row.error.wet,
                row.error.in_frame, 1e9 * row.best_seconds / pixels);
  }
}

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid::bench;
  return run_program("limpid_error_bench", [&] { bench(arguments_of(argc, argv)); });
}
