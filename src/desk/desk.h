#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/core/executor.h"
#include "limpid/job/composite.h"
#include "limpid/ops/look.h"

#include "desk/desk_frame.h"
#include "job/canvas.h"
#include "job/held_gpu.h"
#include "job/shared_textures.h"
#include "show/shown.h"

namespace limpid {

/// A look that the desk offers, by its name for `--look`.
struct DeskLook {
  std::string word;
  Look look;

  /// A look based on another look, with the numbers of one water.
  bool is_preset() const { return !look.bases.empty(); }
};

/// The inputs of a desk.
struct DeskOptions {
  /// Plate and scene of a frame; the job's look and outputs are ignored, its runner is used.
  /// `frames` is empty for a single picture.
  std::function<CompositeJob(std::optional<int> frame)> job_of;
  std::vector<int> frames = {};
  double fps = 24;

  std::vector<DeskLook> looks;
  std::string start;                       ///< name of one of them
  std::vector<std::string> settings = {};  ///< applied to the start, in the syntax of `--set`

  /// Red, green and blue of a picture to compare with, scene-linear, of the plate's primaries;
  /// empty where there is none.
  std::function<std::array<Plane, 3>(std::optional<int> frame, const Primaries& primaries)>
      reference = {};

  std::filesystem::path folder = ".";  ///< for saved looks
  /// The command line with plate, scene and runner: "composite", "dry.exr", ...
  std::vector<std::string> command = {};
  std::string range = {};  ///< the frames in the syntax of `--frames`

  /// The display of light: a config of OpenColorIO, or none for sRGB, and its initial view. The
  /// request has the exposure.
  DisplayChoice display = {};

  /// Memory limit for frames; the last frame is always kept.
  std::int64_t most_bytes = std::int64_t{1} << 30;
};

/// The picture to show.
struct DeskChoice {
  std::string look;                        ///< name of a DeskLook
  std::vector<std::string> settings = {};  ///< applied to it, in the syntax of `--set`
  std::optional<int> frame = {};           ///< the first frame if empty
  std::optional<double> time = {};         ///< seconds; empty: the frame's own
};

struct PictureRequest : DeskChoice {
  bool half = false;
  std::string show = "picture";  ///< of Desk::shows()
  double exposure = 0;           ///< stops, for light
  std::string display = {};      ///< one of Desk::displays(); "" for the first
};

/// A choice of the look that a rule of the planner replaces for this plate.
struct ReplacedChoice {
  std::string key;    ///< of the parameter, "wave_normals.model"
  std::string value;  ///< that runs
  std::string why;    ///< the reason in the plan
};

/// A parameter without effect, because the plate or its scene gives the quantity.
struct UnreadParameter {
  std::string key;  ///< "depth_fog.ambient"
  std::string why;
};

struct DeskPicture {
  Shown shown;
  bool half = false;
  std::vector<ReplacedChoice> replaced;
  std::vector<UnreadParameter> unread = {};
  /// Times in milliseconds, in the order of the work: "all" is wall-clock time, "read", each
  /// operator and "rest" are sums over all threads.
  std::vector<std::pair<std::string, double>> milliseconds;
  /// Those of CompositeReport, with lookups beyond the frame as advice. At half the size, only
  /// those of plate and look.
  std::vector<std::string> warnings, advice;
  std::optional<double> wet;  ///< share of pixels, upper bound; by the fused runner
};

struct PixelNumbers {
  Rgb<float> dry, picture;
  std::vector<std::pair<Aov, std::vector<float>>> aovs;  ///< one number per channel
};

/// An AOV or measure that can replace the picture.
struct DeskShow {
  std::string name, about;
};

/// A file exists, and replacing was not allowed.
struct NameTaken : Error {
  using Error::Error;
};

/// A plate for trying looks. Any number of threads may call it; calls run one at a time.
class Desk {
 public:
  /// Reads the first frame, so that errors of plate, scene, look, reference or display are found
  /// now. The executor must outlive it.
  Desk(DeskOptions options, Executor& executor);

  const DeskOptions& options() const { return options_; }
  /// "fused avx2"
  std::string runner() const;
  std::vector<DeskShow> shows() const;
  /// The displays of light: the initial view, the others of the config, and sRGB.
  const std::vector<std::string>& displays() const { return displays_; }
  struct Facts {
    Rect window;  ///< of the picture, in display coordinates
    Primaries primaries = kRec709;
    std::optional<int> frame;
    double time = 0;
    Look look;  ///< the start with its settings
    std::vector<std::string> files, warnings;
  };
  Facts facts();

  /// The picture, or what is shown in its stead. Of the whole size, the bytes are those of `limpid
  /// composite --preview` with the same exposure and display. Throws Error for what is wrong with
  /// the request, and Stopped after break_off().
  DeskPicture paint(const PictureRequest& request);

  /// Of a pixel, counted from the upper left of the picture at its whole size. Throws Error for one
  /// outside, and Stopped as paint().
  PixelNumbers pixel(const DeskChoice& choice, int x, int y);

  /// Nobody wants the pictures and numbers any more that have been asked for: they are broken off
  /// between two tiles, before they begin, or, by other runners than the fused one, between two
  /// parts of the pixels. Takes no time.
  void break_off();

  /// Writes the look into the folder, as a look file that reads back as the same picture: `name`
  /// ends in .toml and names no other folder. Throws NameTaken for an existing file without
  /// `replace`, and Error for an invalid name, for an input, and if writing fails.
  std::filesystem::path save(const DeskChoice& choice, const std::string& name, bool replace);

  /// The command line that writes the picture, quoted for a shell.
  std::string command(const DeskChoice& choice) const;

  /// The look of a choice. Throws Error.
  Look look_of(const DeskChoice& choice) const;

 private:
  struct Painted;  // the result of a run

  const DeskLook& look_named(const std::string& word) const;
  DeskFrame& frame_at(std::optional<int> frame);
  CompositeJob job_for(const DeskFrame& frame, const DeskChoice& choice) const;
  /// Until when what is asked for now is wanted.
  std::stop_token wanted();
  Painted run(const DeskChoice& choice, std::vector<Aov> aovs, bool half,
              std::optional<Canvas>& canvas, const std::stop_token& stop);
  Shown show(const PictureRequest& request, const Painted& painted);
  DisplayTransform display_of(const PictureRequest& request, const Primaries& primaries) const;
  const std::array<Plane, 3>& reference(std::optional<int> frame, const Primaries& primaries);
  /// The colors of the reference in the pixels that were painted, or what `halved` then holds.
  ShownViews reference_beside(const Painted& painted, std::array<Plane, 3>& halved);

  DeskOptions options_;
  std::vector<std::string> displays_;
  Executor& executor_;
  std::mutex mutex_, stop_mutex_;
  std::stop_source stop_;  ///< of what has been asked for since the last break_off()
  struct Kept {
    std::optional<int> number;
    std::unique_ptr<DeskFrame> frame;
  };
  std::list<Kept> frames_;  ///< most recently used first
  struct Reference {
    std::optional<int> frame;
    std::array<Plane, 3> color;
  };
  std::optional<Reference> reference_;  ///< the last one
  SharedTextures textures_;
  HeldGpu gpu_;
  std::optional<Canvas> whole_, half_, numbers_;
  std::string numbers_of_;  ///< the choice of `numbers_`, or ""
};

}  // namespace limpid
