#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/load/plate.h"
#include "limpid/load/scene_file.h"
#include "limpid/ops/look.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

enum class Runner { kFused, kReference };

/// From files to files: what `limpid composite` does.
struct CompositeJob {
  PlateRequest plate;
  SceneFile scene;
  std::optional<DepthKind> depth_kind;  ///< instead of the scene's
  double time = 0;                      ///< seconds, for drifting waves
  Look look;

  std::vector<Aov> aovs;
  Runner runner = Runner::kFused;
  std::string simd;  ///< "" for the best

  std::filesystem::path output;   ///< EXR
  std::filesystem::path preview;  ///< PNG, or empty for none
  std::string compression = "piz";
  bool store_float = false;  ///< half otherwise; depths and paths are float always
};

/// What was done, for the report line.
struct CompositeReport {
  Plan plan;
  Size size;
  SanitiseCounts replaced;
  double read_seconds = 0, run_seconds = 0, write_seconds = 0;
};

/// Plans without reading a pixel: what would run, and why.
Plan plan_composite(const CompositeJob& job);

/// Loads, plans, runs, writes. Throws Error; nothing is left under the output's name then but what
/// was there before.
CompositeReport composite(const CompositeJob& job, Executor& executor);

}  // namespace limpid
