#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/files/picture/display.h"
#include "limpid/run/aov_names.h"
#include "limpid/run/target.h"

namespace limpid {

enum class Runner {
  kFused,      ///< run/fused.h: the fast one
  kReference,  ///< run/reference.h: the judge
  kGpu,        ///< gpu/gpu_runner.h
};

/// "fused", "reference", "gpu".
std::string_view runner_name(Runner runner);
/// Throws Error with the nearest name.
Runner runner_named(std::string_view name);

/// How a picture is computed and what is written of it.
///
/// All files of a frame, EXR, deep EXR, preview and contact sheet where they are PNGs, say how they
/// were made, in text attributes (iTXt chunks of a PNG). The same inputs give the same bytes:
/// nothing in them depends on places of files, nor on their names but for the wave map's, which the
/// look gives so that it can be used again; nor on date, threads or the name of the machine. The
/// instruction set does count, in the last bits of pixels too, and the best is not the same on
/// every machine: name one where machines must agree.
///
///     limpid/version     of the library
///     limpid/look        all parameters, a look file; the wave map by its name alone
///     limpid/plan        the operators that ran, and why the others did not
///     limpid/scene       camera, water, sun and time, a scene file
///     limpid/inputs      all else that decides what is to be seen: the kind of depths, which
///                        channels of which file feed what, size and samples of what was rendered;
///                        files and models by a hash of their contents (ExrFile::content_hash)
///     limpid/scene_hash  such a hash of the two texts before it, one after the other: the same for
///                        the same picture before look and options
///     limpid/options     how it was computed and stored: runner, instruction set, GPU and driver,
///                        AOVs and their names, compression, what is passed through
///     limpid/view/NAME/  and then scene, inputs, scene_hash, options, look or plan, in the first
///                        part of a file of several views: of each other view
///     limpid/noise       of a ray-traced picture of more than one path a pixel: standard errors of
///                        its colors over the colors, both in the mean (TruthPicture)
///
/// Each EXR also has `limpid_file_hash`, a hash of its own bytes: whether it is still as it was
/// written (ExrFile::is_as_written).
///
/// A rendered plate has no look and no plan, a ray-traced picture no plan: its options name the
/// runner "traced", light, samples, paths and seed.
struct OutputChoice {
  std::vector<Aov> aovs;
  AovNames aov_names = AovNames::kLimpid;
  /// Also the motion vectors of what is seen through the water, where the plate has vectors
  /// (Plate::motion_layers()): `motion`, with the vectors that the plate has of the places that
  /// green was looked up at, as the lookup turns and stretches them. Exact to the first order of
  /// the motion where camera and water stand still; what the camera or the waves do to the lookup
  /// from frame to frame is not in them. With CompositeJob::second they are computed by camera and
  /// water of the second frame instead. For composite() alone.
  bool motion = false;
  /// The same of what the surface mirrors: `motion_reflected`, by the vectors that the plate has
  /// where the mirrored ray meets what the picture shows (job/motion.h), else 0. For composite()
  /// alone.
  bool motion_reflected = false;
  /// Other layers of the plates that are written as they are (Plate::passed() has what the names
  /// mean, "all" among them): names, sample types and bits, beside the picture if they lie in the
  /// part that the color comes from, else in a part of their name. The compression is then one that
  /// changes no sample. For composite() alone.
  std::vector<std::string> pass_through = {};
  Runner runner = Runner::kFused;
  std::string simd;  ///< "" for the best
  /// Of Runner::kGpu, as in GpuOptions.
  std::string gpu = {};
  std::filesystem::path gpu_cache = {};
  /// What the fused runner may leave out, together, changes no channel of a pixel by more (white =
  /// 1): Plan::max_error.
  double max_error = 0;

  /// In so many parts of each pixel the water is met and its waves are filtered (PixelPart), 1 ...
  /// kMaxWaveSamples; the frame's planes are read at the pixel. It takes as many times as long.
  /// Colors and shares are the means of all parts, depths, normals and maps those of the middle
  /// part (the one before the middle, of an even number). Without a deep file: its samples have no
  /// mean.
  int wave_samples = 1;
  static constexpr int kMaxWaveSamples = 64;

  /// So many pixels beyond each side of the display window are written, too, as far as all buffers
  /// that are read have them: the data window of the files is as much larger, the preview is not.
  /// For composite() alone.
  int overscan = 0;
  static constexpr int kMaxOverscan = 16000;

  /// Whether what would be a warning is an Error, before anything is written.
  bool strict = false;

  std::filesystem::path picture;  ///< EXR
  std::filesystem::path preview;  ///< PNG, or empty for none
  /// How preview, contact sheet and CompositeReport::preview show light.
  DisplayChoice display = {};
  /// PNG with the picture and every AOV, small, named, and as their kinds are looked at, or empty
  /// for none. All AOVs are computed for it, which takes as much memory as to write them.
  std::filesystem::path contact_sheet = {};
  /// Most pixels across of CompositeReport::preview; 0 for none.
  int preview_across = 0;
  /// Whether any of the three is wanted.
  bool shows() const { return !preview.empty() || !contact_sheet.empty() || preview_across > 0; }
  /// Deep EXR of the water alone, or empty for none: a volume sample on each wet pixel, of color
  /// in_scatter and alpha 1 - transmittance (files/exr/deep_writer.h). What the surface mirrors is
  /// not in it. It begins at the surface, or at the near distance where the view begins in the
  /// water, and is as long as the way through the water, laid straight along the view ray. Water
  /// without end ends where its linear fog is full, or no more light of any channel is left; where
  /// it takes no light at all it has no sample.
  std::filesystem::path deep;
  std::string compression = "piz";
  bool store_float = false;  ///< half otherwise; depths and paths are float always
};

}  // namespace limpid
