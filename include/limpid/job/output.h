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
  kReference,  ///< run/reference.h: in double, to check the others
  kGpu,        ///< gpu/gpu_runner.h
};

/// "fused", "reference", "gpu".
std::string_view runner_name(Runner runner);
/// Throws Error with the nearest name.
Runner runner_named(std::string_view name);

/// The choices of a job on computing a picture and on its output files.
///
/// All output files of a frame (EXR, deep EXR, and preview and contact sheet if they are PNGs)
/// record how they were made, in text attributes (iTXt chunks of a PNG). The same inputs give the
/// same bytes: they do not depend on places of files, on their names (except that of the wave map,
/// which is part of the recorded look), on date, threads or the name of the machine. They do depend
/// on the instruction set, also in the last bits of pixels, and machines differ in their best set:
/// choose one by name if machines must agree.
///
///     limpid/version     of the library
///     limpid/look        all parameters, as a look file; the wave map by its name only
///     limpid/plan        the operators that ran, and the reasons why the others did not
///     limpid/scene       camera, water, sun and time, as a scene file
///     limpid/inputs      all other inputs that affect the picture before look and options: the
///                        kind of depths, the channels of files that feed each role, size and
///                        samples of rendered buffers; files and models by a hash of their contents
///                        (ExrFile::content_hash)
///     limpid/scene_hash  a hash of the texts scene and inputs together: equal for the same picture
///                        before look and options
///     limpid/options     how the picture was computed and stored: runner, instruction set, GPU and
///                        driver, AOVs and their names, compression, copied layers
///     limpid/view/NAME/  scene, inputs, scene_hash, options, look or plan of each further view, in
///                        the first part of a file with several views
///     limpid/noise       of a path-traced picture with more than one path per pixel: mean standard
///                        error of its colors over their mean (TruthPicture)
///
/// Each EXR also has `limpid_file_hash`, a hash of its own bytes, which shows later changes
/// (ExrFile::is_as_written).
///
/// A rendered plate has no look and no plan, a path-traced picture no plan: its options name the
/// runner "traced", light, samples, paths and seed.
struct OutputChoice {
  std::vector<Aov> aovs;
  AovNames aov_names = AovNames::kLimpid;
  /// Whether to write the motion vectors of the scene as seen through the water, `motion`: the
  /// plate's vectors (Plate::motion_layers()) at the positions at which green was looked up, turned
  /// and stretched by the derivative of the lookup. Exact to first order if camera and water stand
  /// still; the change of the lookup by a moving camera or waves is not included. With
  /// CompositeJob::second the vectors are computed from camera and water of the second frame
  /// instead. For composite() only.
  bool motion = false;
  /// The same for the mirror image in the surface, `motion_reflected`: the plate's vectors at the
  /// end of the mirrored ray if the picture shows it (job/motion.h), else 0. For composite() only.
  bool motion_reflected = false;
  /// Layers of the plates that are copied unchanged into the output, with names, sample types and
  /// bits (Plate::passed() explains the names, such as "all"). Layers of the color's part are
  /// written beside the picture, others into a part with their part's name. The compression must
  /// then be lossless. For composite() only.
  std::vector<std::string> pass_through = {};
  Runner runner = Runner::kFused;
  std::string simd;  ///< instruction set; "" for the best
  /// For Runner::kGpu, as in GpuOptions.
  std::string gpu = {};
  std::filesystem::path gpu_cache = {};
  /// Plan::max_error, for the fused runner.
  double max_error = 0;

  /// The number of strips of each pixel (PixelPart) that are computed, 1 ... kMaxWaveSamples; the
  /// time grows by this factor. Planes of the frame are read at the pixel. Colors and shares are
  /// the means of all strips; depths, normals and maps are those of the middle strip (for an even
  /// number, of the one before the middle). Not with a deep file, whose samples have no mean.
  int wave_samples = 1;
  static constexpr int kMaxWaveSamples = 64;

  /// The number of pixels beyond each side of the display window that are written, too, as far as
  /// all buffers that are read have them. The data window of the EXR files grows accordingly, the
  /// preview does not. For composite() only.
  int overscan = 0;
  static constexpr int kMaxOverscan = 16000;

  /// Whether a warning is an Error instead, before anything is written.
  bool strict = false;

  std::filesystem::path picture;  ///< EXR
  std::filesystem::path preview;  ///< PNG, or empty for none
  /// Exposure and color transform of preview, contact sheet and CompositeReport::preview.
  DisplayChoice display = {};
  /// PNG with the picture and every AOV, reduced and with their names, or empty for none. All AOVs
  /// are computed for it, which takes as much memory as writing them.
  std::filesystem::path contact_sheet = {};
  /// The largest width of CompositeReport::preview, in pixels; 0 for no preview.
  int preview_across = 0;
  /// Whether any of the three is requested.
  bool shows() const { return !preview.empty() || !contact_sheet.empty() || preview_across > 0; }
  /// Deep EXR of the water alone, or empty for none: a volume sample on each wet pixel, of color
  /// in_scatter and alpha 1 - transmittance (files/exr/deep_writer.h). Reflected light is not part
  /// of it. The volume begins at the surface, or at the near plane if the view begins in the water,
  /// and is as long as the refracted path, laid along the view ray. An infinite path ends where its
  /// linear fog is full, or where no channel has light left; without any extinction it has no
  /// sample.
  std::filesystem::path deep;
  std::string compression = "piz";
  bool store_float = false;  ///< else half; depths and paths are always float
};

}  // namespace limpid
