// Times a sequence of 4K plates from files to files: reading, compositing and writing overlapped,
// beside the same frames without the compositing, and beside frame by frame. All rows have the same
// threads and the same files; rounds go over all rows in turn, the best counts.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/exr/exr_writer.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/files/text/look_file.h"
#include "limpid/job/sequence.h"
#include "limpid/run/fused.h"

#include "arguments.h"
#include "judge/report/picture.h"
#include "made_plate.h"
#include "rows.h"

namespace limpid::bench {
namespace {

namespace fs = std::filesystem;

constexpr Size kSize{3840, 2160};
constexpr int kFrames = 8, kRounds = 3;

/// A temporary folder, removed with its contents at the end.
struct TemporaryFolder {
  TemporaryFolder()
      : path(fs::temp_directory_path() / ("limpid_sequence_bench-" + std::to_string(::getpid()))) {
    fs::create_directory(path);
  }
  ~TemporaryFolder() { fs::remove_all(path); }
  fs::path path;
};

/// A factor within 1 % of 1 that differs on each pixel of each frame, like a renderer's noise.
float grain(int x, int y, int seed) {
  auto h = static_cast<unsigned>(x) * 73856093u ^ static_cast<unsigned>(y) * 19349663u ^
           static_cast<unsigned>(seed) * 83492791u;
  h = (h ^ h >> 13) * 0x5bd1e995u;
  return 1 + 0.02f * (static_cast<float>((h ^ h >> 15) & 0xffff) / 65536 - 0.5f);
}

/// The plates as files: half color and shadow, float depth, PIZ.
void write_plates(const MadePlate& plate, const std::string& name) {
  const Rect window = plate.frame.display;
  std::vector<Plane> color;
  for (int c = 0; c < 3; ++c) color.emplace_back(window);
  for (int frame = 1; frame <= kFrames; ++frame) {
    ExrOutput output;
    output.data = output.display = window;
    for (int c = 0; c < 3; ++c) {
      const View<float> noisy = color[static_cast<std::size_t>(c)].view();
      const View<const float>& clean = plate.frame.plane(plane_after(PlaneId::kColorR, c));
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          noisy.at(x, y) = clean.at(x, y) * grain(x, y, 3 * frame + c);
        }
      }
      output.channels.push_back({std::string(1, "RGB"[c]), noisy, true});
    }
    output.channels.push_back({"A", plate.frame.plane(PlaneId::kColorA), true});
    output.channels.push_back({"depth.Z", plate.frame.plane(PlaneId::kDepth), false});
    output.channels.push_back({"shadow.Y", plate.frame.plane(PlaneId::kShadow), true});
    write_exr(name_of_frame(name, frame), output);
  }
}

struct Bench {
  Bench(const Arguments& arguments, const fs::path& folder)
      : plate(kSize),
        plates((folder / "plate.%04d.exr").string()),
        wet((folder / "wet.%04d.exr").string()),
        executor(make_executor(0)),
        canvas(plate.frame.display) {
    write_plates(plate, plates);
    common.look = load_look(LIMPID_DATA "/looks/realistic.toml");
    common.scene.scene = plate.scene;
    common.scene.camera =
        CameraSpec{.view = plate.scene.camera->view, .projection = plate.scene.camera->projection};
    common.output.simd = arguments.simd;
    for (int frame = 1; frame <= kFrames; ++frame) sequence.frames.push_back(frame);
    composite(job_of(1), *executor);
    const ExrFile finished = ExrFile::open(name_of_frame(wet, 1));
    std::vector<ExrRequest> requests;
    for (int c = 0; c < 3; ++c) {
      requests.push_back({0, std::string(1, "RGB"[c]), canvas.target.color[c]});
    }
    requests.push_back({0, "A", canvas.target.alpha});
    finished.read(requests);
    planes = plan_composite(job_of(1)).planes;
  }

  CompositeJob job_of(int frame) const {
    CompositeJob job = common;
    job.plate.files = {name_of_frame(plates, frame)};
    job.time.fallback = frame / 24.0;
    job.output.picture = name_of_frame(wet, frame);
    return job;
  }

  /// Reads and writes the files of a frame without compositing; either can be left out.
  class Files : public FrameSlot {
   public:
    Files(const Bench& bench, bool reads, bool writes)
        : bench_(bench), reads_(reads), writes_(writes) {}
    void begin(int frame) override { frame_ = frame; }
    void read(Executor&) override {
      if (!reads_) return;
      const CompositeJob job = bench_.job_of(frame_);
      Plate::open(job.plate).read(bench_.planes, bench_.plate.scene, {}, loaded_);
    }
    void run(Executor&) override {}
    void write() override {
      if (!writes_) return;
      const Target& finished = bench_.canvas.target;
      ExrOutput output;
      output.data = output.display = bench_.plate.frame.display;
      for (int c = 0; c < 3; ++c) {
        output.channels.push_back({std::string(1, "RGB"[c]), finished.color[c]});
      }
      output.channels.push_back({"A", finished.alpha});
      write_exr(name_of_frame(bench_.wet, frame_), output);
    }
    void done(const SequenceProgress&) override {}

   private:
    const Bench& bench_;
    bool reads_, writes_;
    int frame_ = 0;
    LoadedPlate loaded_;
  };

  void files(bool reads, bool writes) const {
    run_sequence(
        sequence, [&] { return std::make_unique<Files>(*this, reads, writes); }, *executor);
  }
  void composited() const {
    composite_sequence(
        sequence, [&](int frame) { return job_of(frame); }, nullptr, *executor);
  }
  void frame_by_frame() const {
    for (const int frame : sequence.frames) composite(job_of(frame), *executor);
  }

  MadePlate plate;
  std::string plates, wet;
  std::unique_ptr<Executor> executor;
  Picture canvas;  ///< a finished frame
  PlaneSet planes;
  CompositeJob common;
  Sequence sequence;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct CpuRow : Row {
  double least_cpu_seconds = 1e30;  ///< summed over all threads
};

void bench(const Arguments& arguments) {
  const TemporaryFolder folder;
  const auto threads = static_cast<int>(std::thread::hardware_concurrency());
  set_file_threads(threads);
  const Bench b(arguments, folder.path);
  std::list<CpuRow> rows;  // list elements do not move
  const auto add = [&](const char* name, auto&& work) {
    if (!arguments.wants_row(name)) return;
    CpuRow& row = rows.emplace_back();
    row.name = name;
    row.run = [&row, work] {
      const double cpu = cpu_seconds(), seconds = seconds_of(work);
      row.least_cpu_seconds = std::min(row.least_cpu_seconds, cpu_seconds() - cpu);
      return seconds;
    };
  };
  add("read alone, pipelined", [&] { b.files(true, false); });
  add("write alone, pipelined", [&] { b.files(false, true); });
  add("read + write, pipelined", [&] { b.files(true, true); });
  add("read + composite + write, pipelined", [&] { b.composited(); });
  add("read, composite, write, frame by frame", [&] { b.frame_by_frame(); });
  arguments.expect_rows(!rows.empty());
  time_rows(rows, arguments.rounds);
  double files = 0;
  for (const CpuRow& row : rows) {
    if (row.name == "read + write, pipelined") files = row.best_seconds;
  }
  std::printf(
      "sequence of %d plates, %dx%d, half PIZ color and shadow, float depth; look realistic as "
      "it is shipped; written half PIZ\n%d threads, %d frames in flight, best of %d rounds\n",
      kFrames, kSize.width, kSize.height, threads, b.sequence.in_flight, arguments.rounds);
  std::printf("  %-40s %10s %10s %14s %14s\n", "", "ms/frame", "frames/s", "CPU ms/frame",
              files > 0 ? "x read + write" : "");
  for (const CpuRow& row : rows) {
    std::printf("  %-40s %10.0f %10.2f %14.0f", row.name.c_str(), 1e3 * row.best_seconds / kFrames,
                kFrames / row.best_seconds, 1e3 * row.least_cpu_seconds / kFrames);
    if (files > 0) std::printf(" %14.2f", row.best_seconds / files);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace limpid::bench

int main(int argc, char** argv) {
  using namespace limpid::bench;
  return run_program("limpid_sequence_bench",
                     [&] { bench(arguments_of(argc, argv, false, kRounds)); });
}
