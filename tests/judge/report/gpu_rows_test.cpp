#include <gtest/gtest.h>

#include "limpid/files/text/look_file.h"

#include "gpu/gpu.h"
#include "judge/report/measure.h"
#include "paths.h"

namespace limpid {
namespace {

using GpuRows = test::GpuTest;

/// One row per look, timed from memory to memory, as close to the reference as the fused rows.
TEST_F(GpuRows, StandBesideTheOthers) {
  const std::filesystem::path data = LIMPID_DATA;
  ReportOptions options;
  options.rounds = 1;
  Look look = load_look(data / "looks/realistic.toml");
  look.name = "physical";  // the report judges other looks by this one
  const auto executor = make_executor(1);
  Report report;
  const GpuOptions gpu;
  const Measuring m{options, {look}, look, *executor, *executor, 1, "", report, &gpu};
  Subject subject = Subject::of_plate(data / "plates/lagoon/lagoon.toml", {96, 54});
  measure_looks(m, subject, false);
  int rows = 0;
  for (const RunnerRow& row : report.runners) {
    if (row.runner != "gpu") continue;
    ++rows;
    EXPECT_EQ(row.simd.find(gpu_devices()[0].name), 0u);
    EXPECT_GT(row.ns_per_pixel, 0);
    EXPECT_GT(row.error.mean, 0);
    EXPECT_LT(row.error.mean, 1e-5);
  }
  EXPECT_EQ(rows, 1);
}

}  // namespace
}  // namespace limpid
