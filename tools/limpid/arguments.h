#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The command line, verb by verb, as plain text and numbers; verbs.h interprets it.

namespace limpid::tool {

struct CommonArguments {
  int threads = 0;
  std::optional<std::string> max_memory;
  bool quiet = false, verbose = false;
};

/// Look and output, for every verb that composites water.
struct WaterOptions {
  std::string look = "physical";
  std::vector<std::string> settings, aovs;
  std::string aov_names = "limpid";
  std::optional<double> time;
  double max_error = 0;
  bool strict = false;
  std::string output, preview, contact_sheet, deep, runner = "fused", simd, gpu,
                                                    compression = "piz";
  std::string show;  ///< "", "auto" or a protocol for pictures in terminals
  std::optional<double> exposure;
  std::string display, ocio;
  bool store_float = false, dry_run = false;
};

/// The frames of a sequence; without any, a single frame without a number.
struct FrameOptions {
  std::string range;
  std::optional<double> fps;
  std::optional<int> in_flight;
  std::string missing = "error";
  bool resume = false, verify = false;
};

struct CompositeArguments {
  std::vector<std::string> plates, layers;
  bool measure = false;  ///< `plan` also runs it
  std::string scene, view, depth_kind, colorspace;
  std::optional<double> depth_nothing;
  int samples = 1, overscan = 0;
  std::vector<std::string> pass_through = {"none"};
  std::string motion_to;  ///< "next", "previous", or "" for the plate's vectors
  FrameOptions frames;
  WaterOptions water;
};

/// A plate as for `composite`, and the options of its page.
struct ViewArguments {
  CompositeArguments composite;
  std::string reference, folder = ".";
  int port = 0;
  bool no_browser = false;
};

/// The looks, each in a picture of a plate.
struct LooksArguments {
  CompositeArguments composite;
  std::string pictures;
};

/// `render` and `water`.
struct RenderArguments {
  std::string scene, size = "1920x1080";
  int overscan = 0, samples = 1, shadow_map = 2048;
  bool skip_unsupported = false;
  FrameOptions frames;
  WaterOptions water;
};

struct TruthArguments {
  std::string scene, size = "1920x1080";
  int samples = 1;
  std::string light = "paths";
  std::optional<int> paths;
  int photons = 0;
  std::uint64_t seed = 0;
  bool skip_unsupported = false;
  FrameOptions frames;
  WaterOptions water;
};

struct InspectArguments {
  std::vector<std::string> plates;
  std::string scene, view;
  std::vector<std::string> layers;
};

struct OperatorsArguments {
  std::string name;  ///< one operator, or "" for the table of all operators
  std::string look;
  bool scene = false;              ///< the keys of scene files instead
  bool layers = false;             ///< the rules for finding layers instead
  bool aovs = false;               ///< the table of AOVs instead
  std::vector<std::string> verbs;  ///< for `help`, which knows them, too
};

struct CompareArguments {
  std::string a, b, diff, flip_map, frames, colorspace;
  std::vector<std::string> channels, metrics;
  double tolerance = 1e-6, allowed_percent = 0, epsilon = 1e-2;
  std::optional<double> hard_limit, clip, ppd;
};

struct ReportArguments {
  CompositeArguments composite;  ///< of a shot; its look is "" if none is named
  std::string truth;
  std::vector<std::string> against;
  std::string output;
  std::optional<std::string> size;
  std::optional<int> rounds;
  bool quick = false;
  bool hard = false;
  std::string gpu;
};

struct ShaderArguments {
  std::string language = "glsl", main = "none", function = "limpid_water";
  std::vector<std::string> planes, aovs;
  int descriptor_set = 0, first_binding = 0;
  std::string scene, output;
  WaterOptions water;
};

struct FarmArguments {
  std::vector<std::string> words;    ///< status FARM, and the like; empty to submit
  std::vector<std::string> command;  ///< after `--`
  std::optional<int> chunk, at_once, minutes;
  std::vector<std::string> sbatch;
  bool dry_run = false;
};

enum class Verb {
  kNone,
  kComposite,
  kPlan,
  kView,
  kRender,
  kWater,
  kTruth,
  kInspect,
  kOperators,
  kLooks,
  kCompare,
  kReport,
  kShader,
  kFarm,
};

struct Arguments {
  Verb verb = Verb::kNone;
  CommonArguments common;
  CompositeArguments composite;
  ViewArguments view;
  RenderArguments render;
  TruthArguments truth;
  InspectArguments inspect;
  OperatorsArguments operators;
  LooksArguments looks;
  CompareArguments compare;
  ReportArguments report;
  ShaderArguments shader;
  FarmArguments farm;
};

/// Parses argv. If no work is left (help, version, wrong usage), the text has been printed and this
/// holds the exit code instead.
struct Parsed {
  Arguments arguments;
  std::optional<int> exit_code;
};
Parsed parse(int argc, char** argv);

}  // namespace limpid::tool
