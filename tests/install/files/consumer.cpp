// From files to files: renders one of the installed scenes small, puts water of an installed look
// into it, and reads back what was written. Run as: consumer DATA_FOLDER
#include <array>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/gltf/gltf.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/text/look_file.h"
#include "limpid/job/sequence.h"
#include "limpid/job/water.h"

namespace {

using namespace limpid;
namespace fs = std::filesystem;

void expect(bool right, const char* sentence) {
  if (!right) throw Error(sentence);
}

/// A slot of this program's own: what a library's class needs is there, its virtual table too.
struct Counting : FrameSlot {
  int& frames;
  explicit Counting(int& frames) : frames(frames) {}
  void begin(int) override {}
  void read(Executor&) override {}
  void run(Executor&) override {}
  void write() override { ++frames; }
  void done(const SequenceProgress&) override {}
};

void check_a_picture(const fs::path& data, Executor& executor) {
  WaterJob job;
  job.scene = load_scene(data / "scenes" / "pool.toml");
  job.render.size = {64, 36};
  job.look = look_named("realistic", std::array{data / "looks"});
  const Look pool = look_named("pool", std::array{data / "looks", data / "presets"});
  expect(pool.of<WaveNormals>().map == job.look.of<WaveNormals>().map, "a preset has another map");
  job.output.picture = "files_consumer.exr";
  job.output.preview = "files_consumer.png";
  water(load_gltf(job.scene.geometry), job, executor);
  const Rect window = rect_of(job.render.size);
  expect(ExrFile::open(job.output.picture).parts().at(0).display == window, "the EXR is not 64x36");
  // Other formats than EXR are read by a module that lies beside the installed library.
  expect(read_image(job.output.preview).window == window, "the PNG is not 64x36");
}

bool refuses_a_missing_scene(const fs::path& data) {
  try {
    load_scene(data / "no such scene.toml");
  } catch (const Error&) {
    return true;
  }
  return false;
}

}  // namespace

int main(int, char** arguments) try {
  const fs::path data = arguments[1];
  const auto executor = make_executor(0);
  check_a_picture(data, *executor);
  expect(refuses_a_missing_scene(data), "a missing scene was not refused by a limpid::Error");
  int frames = 0;
  run_sequence(
      {.frames = {1, 2, 3}}, [&] { return std::make_unique<Counting>(frames); }, *executor);
  expect(frames == 3, "three frames were expected");
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
