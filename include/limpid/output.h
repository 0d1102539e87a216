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

  std::filesystem::path picture;  ///< EXR
  std::filesystem::path preview;  ///< PNG, or empty for none
  std::string compression = "piz";
  bool store_float = false;  ///< half otherwise; depths and paths are float always
};

}  // namespace limpid
