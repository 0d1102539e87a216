#include "desk/pond_desk.h"

#include <fstream>

#include "limpid/files/picture/image_file.h"
#include "limpid/files/text/look_file.h"
#include "limpid/job/composite.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;

fs::path empty_folder() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("desk_") + info->test_suite_name() + "_" + info->name();
  std::replace(name.begin(), name.end(), '/', '_');
  const fs::path folder = fs::path(::testing::TempDir()) / name;
  fs::remove_all(folder);
  fs::create_directories(folder / "saved");
  return folder;
}

}  // namespace

PondDesk::PondDesk() : folder_(empty_folder()) {
  std::ofstream(folder_ / "scene.toml") << scene_toml();
  std::ofstream(folder_ / "pond.toml") << look_toml();
  write_waves(folder_ / "waves.exr");
}

PondDesk::~PondDesk() { fs::remove_all(folder_); }

DeskOptions PondDesk::options(const PlateOptions& plate) const {
  write_plate(folder_ / "plate.exr", plate);
  CompositeJob job;
  job.plate.files = {folder_ / "plate.exr"};
  job.scene = load_scene(folder_ / "scene.toml");
  job.output.simd = "scalar";  // the same bits wherever the test runs
  DeskOptions options;
  options.job_of = [job](std::optional<int>) { return job; };
  options.looks = {{"pond", load_look(folder_ / "pond.toml")}};
  options.start = "pond";
  options.folder = folder_ / "saved";
  options.command = {"composite", "plate.exr"};
  return options;
}

std::vector<std::uint8_t> PondDesk::previewed(const DeskOptions& options, const Look& look,
                                              std::optional<int> frame,
                                              std::optional<double> time) const {
  CompositeJob job = options.job_of(frame);
  job.look = look;
  if (time) job.time.explicit_time = time;
  job.output.picture = folder_ / "wet.exr";
  job.output.preview = folder_ / "wet.png";
  composite(job, *executor_);
  const ImageFile image = read_image(job.output.preview);
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < image.window.height(); ++y) {
    for (int x = 0; x < image.window.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = image.planes[c].view().at(x, y);
        bytes.push_back(static_cast<std::uint8_t>(value * 255 + 0.5f));
      }
    }
  }
  return bytes;
}

std::vector<std::uint8_t> PondDesk::colors(const Shown& shown) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < shown.rgba.size(); ++i) {
    if (i % 4 == 3) {
      EXPECT_EQ(shown.rgba[i], 255);
    } else {
      bytes.push_back(shown.rgba[i]);
    }
  }
  return bytes;
}

}  // namespace limpid::test
