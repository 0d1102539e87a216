#include "shared_options.h"

#include <limits>

#include <CLI/CLI.hpp>

#include "limpid/core/error.h"
#include "limpid/job/sequence.h"
#include "limpid/run/target.h"

#include "option_range.h"

namespace limpid::tool {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMaxSeconds = 1e12;  ///< so that no wave's phase overflows
constexpr double kMaxFps = 1e6;
constexpr double kMaxStops = 100;

}  // namespace

void add_plates(CLI::App& verb, std::vector<std::string>& plates, std::string& scene,
                std::vector<std::string>& layers, std::string& view) {
  verb.add_option("plates", plates, "EXR files with the buffers of one frame")
      ->option_text("PLATE...");
  verb.add_option("--scene", scene, "Scene file: plates, camera, water, sun")->option_text("FILE");
  verb.add_option("--layer", layers,
                  "Source of a buffer: ROLE=FILE:CHANNELS, ROLE=FILE, ROLE=CHANNELS or ROLE=none "
                  "(repeatable)")
      ->option_text("ROLE=LAYER")
      ->allow_extra_args(false);
  verb.add_option(
          "--view", view,
          "View of a stereo plate, such as left or right (default: the first); for composite "
          "also left,right or all, and the view replaces %V in names of inputs")
      ->option_text("NAME");
}

void add_time(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--time", a.time,
                  "Time in seconds, for waves and their drift (default: the scene's, or 0)")
      ->option_text("S")
      ->check(number_in(-kMaxSeconds, kMaxSeconds, "s"));
}

void add_frame_numbers(CLI::App& verb, FrameOptions& a, const std::string& about) {
  verb.add_option("--frames", a.range, about)->option_text("RANGE");
  verb.add_option("--fps", a.fps, "Frames per second (default: 24)")
      ->option_text("N")
      ->check(number_in(1 / kMaxFps, kMaxFps));
}

void add_frames(CLI::App& verb, FrameOptions& a, const std::string& about) {
  add_frame_numbers(verb, a, about);
  verb.add_option("--frames-in-flight", a.in_flight,
                  "Frames in the pipeline of reading, compositing and writing, each in its own "
                  "memory (default: 3)")
      ->option_text("N")
      ->check(whole_number_in(1, kMaxInFlight));
}

void add_resume(CLI::App& verb, FrameOptions& a) {
  verb.add_flag(
      "--resume", a.resume,
      "Skip frames that are complete and were made from the same inputs with the same options");
  verb.add_flag("--verify", a.verify,
                "With --resume: verify every byte of these frames by the hashes in their headers");
}

void add_settings(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--look", a.look, "Look by name, or a look file (default: physical)")
      ->option_text("NAME|FILE");
  verb.add_option("--set", a.settings, "One parameter: operator.parameter=value (repeatable)")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  add_time(verb, a);
}

void add_look(CLI::App& verb, WaterOptions& a) {
  add_settings(verb, a);
  std::vector<std::string> known;
  for (const AovInfo& info : aovs()) known.emplace_back(info.name);
  verb.add_option("--aov", a.aovs,
                  "Also write AOVs: all, or some of " + join(known) +
                      ", and for composite of motion and motion_reflected, with motion vectors in "
                      "the plate or with --motion-to")
      ->option_text("all|NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--max-error", a.max_error,
                  "Leave out operators as long as no channel of a pixel changes by more than E in "
                  "all, white = 1 (default: 0, exact)")
      ->option_text("E")
      ->check(number_in(0, kInfinity, "white = 1"));
  verb.add_flag("--strict", a.strict, "Turn warnings into errors, before anything is written");
}

void add_file(CLI::App& verb, WaterOptions& a) {
  verb.add_option("-o", a.output, "EXR file to write")->option_text("OUT.exr");
  verb.add_option(
          "--compression", a.compression,
          "Compression: none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab (default: "
          "piz)")
      ->option_text("NAME[:LEVEL]");
  verb.add_flag("--float", a.store_float, "Write float instead of half");
}

void add_simd(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--simd", a.simd, "Instruction set (default: the best of this machine)")
      ->option_text("NAME");
}

void add_display(CLI::App& verb, WaterOptions& a) {
  verb.add_option(
          "--display", a.display,
          "View transform: sRGB, DISPLAY/VIEW of an OpenColorIO config, or a view of its default "
          "display (default: the config's default, or sRGB without a config)")
      ->option_text("sRGB|DISPLAY/VIEW");
  verb.add_option("--ocio", a.ocio, "OpenColorIO config (default: $OCIO)")->option_text("FILE");
}

void add_preview(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--preview", a.preview, "Also write a picture for a screen")
      ->option_text("OUT.png");
  verb.add_option("--exposure", a.exposure,
                  "Exposure of --preview, --contact-sheet and --show, in stops (default: 0)")
      ->option_text("STOPS")
      ->check(number_in(-kMaxStops, kMaxStops, "stops"));
  add_display(verb, a);
}

void add_runner(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--runner", a.runner,
                  "Runner: fused (SIMD), gpu (Vulkan) or reference (double) (default: fused)")
      ->option_text("NAME");
}

void add_gpu(CLI::App& verb, WaterOptions& a) {
  verb.add_option("--gpu", a.gpu, "Part of the GPU's name (default: the fastest kind)")
      ->option_text("NAME");
}

void add_wave_samples(CLI::App& verb, CompositeArguments& a) {
  verb.add_option("--samples", a.samples,
                  "Samples per pixel of the water and its waves; plates are read once, and the run "
                  "takes N times as long (default: 1)")
      ->option_text("N")
      ->check(whole_number_in(1, OutputChoice::kMaxWaveSamples));
}

void add_picture(CLI::App& verb, WaterOptions& a) {
  add_file(verb, a);
  verb.add_option(
          "--aov-names", a.aov_names,
          "Names of picture and AOVs as in limpid, nuke, blender or arnold (default: limpid)")
      ->option_text("HOST");
  add_simd(verb, a);
  add_preview(verb, a);
  verb.add_option("--contact-sheet", a.contact_sheet,
                  "Also write one sheet with the picture and every AOV, small, with their names")
      ->option_text("OUT.png");
  verb.add_flag("--show{auto}", a.show,
                "Show the preview in the terminal, if it can show pictures; --show=kitty, "
                "--show=iterm and --show=sixel name the protocol");
  verb.add_option("--deep", a.deep, "Also write the water as deep samples, with zips compression")
      ->option_text("OUT.exr");
  add_runner(verb, a);
  add_gpu(verb, a);
  verb.add_flag("-n", a.dry_run, "Print the plan; write nothing");
}

}  // namespace limpid::tool
