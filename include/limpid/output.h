#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/run/target.h"

namespace limpid {

enum class Runner { kFused, kReference };

/// How a picture is computed and what is written of it.
struct OutputChoice {
  std::vector<Aov> aovs;
  Runner runner = Runner::kFused;
  std::string simd;  ///< "" for the best
  /// What the fused runner may leave out, together, changes no channel of a pixel by more (white =
  /// 1): Plan::max_error.
  double max_error = 0;

  std::filesystem::path picture;  ///< EXR
  std::filesystem::path preview;  ///< PNG, or empty for none
  /// Deep EXR of the water alone, or empty for none: a volume sample on each wet pixel, of color
  /// in_scatter and alpha 1 - transmittance (write/deep_writer.h). What the surface mirrors is not
  /// in it. It begins at the surface, or at the near distance where the view begins in the water,
  /// and is as long as the way through the water, laid straight along the view ray. Water without
  /// end ends where its linear fog is full, or no more light of any channel is left; where it takes
  /// no light at all it has no sample.
  std::filesystem::path deep;
  std::string compression = "piz";
  bool store_float = false;  ///< half otherwise; depths and paths are float always
};

}  // namespace limpid
