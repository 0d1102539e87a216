#include "judge/report/subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "limpid/core/color_space.h"
#include "limpid/files/exr/exr_writer.h"

#include "core/convert_color.h"
#include "plate/primaries.h"

/// The surroundings of a report's scene.

namespace limpid {
namespace {

TEST(Subject, EnvironmentsAreOfTheScenesWorkingSpace) {
  const std::filesystem::path sky =
      std::filesystem::path(testing::TempDir()) / "subject_acescg_sky.exr";
  const Primaries acescg = find_color_space("ACEScg").value();
  const std::array<float, 3> light{0.5f, 0.25f, 1.0f};
  std::array<Plane, 3> colors;
  ExrOutput output;
  output.data = output.display = {0, 0, 8, 4};
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    colors[c] = Plane(output.data);
    for (int y = 0; y < 4; ++y) std::fill_n(colors[c].view().row(y), 8, light[c]);
    output.channels.push_back({names[c], colors[c].view(), false});
  }
  tell_primaries(output.inherited, acescg);
  write_exr(sky, output);

  const auto executor = make_executor(1);
  Subject subject = Subject::of_scene(std::filesystem::path(LIMPID_DATA) / "scenes/pool.toml",
                                      {32, 18}, sky, *executor);
  ASSERT_EQ(subject.scene().primaries, kRec709);
  convert_color({colors[0].view(), colors[1].view(), colors[2].view()}, kRec709, acescg);
  EXPECT_GT(std::abs(colors[0].view().at(3, 2) - light[0]), 0.05) << "the spaces differ";
  const Frame frame = subject.frame_for(subject.plan(Look{}));
  ASSERT_TRUE(frame.environment);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(frame.environment.channels[c].at(3, 2),
                colors[static_cast<std::size_t>(c)].view().at(3, 2), 1e-6);
  }
  std::filesystem::remove(sky);
}

}  // namespace
}  // namespace limpid
