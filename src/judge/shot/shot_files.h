#pragma once
#include <string>
#include <string_view>

/// What the pictures of a shot's page are called.

namespace limpid {

inline constexpr const char* kDryFile = "dry.png";
inline constexpr const char* kWetFile = "wet.png";
inline constexpr const char* kTruthFile = "truth.png";

inline std::string aov_file(std::string_view aov) { return "aov_" + std::string(aov) + ".png"; }
/// Of the n-th look that the shot's is compared with, from 1.
inline std::string look_file(std::size_t n) { return "look_" + std::to_string(n) + ".png"; }
inline std::string without_file(std::string_view op) {
  return "without_" + std::string(op) + ".png";
}

/// Where the picture of that file differs from the one with water.
inline std::string difference_file(const std::string& file) {
  return file.substr(0, file.rfind('.')) + "_difference.png";
}

}  // namespace limpid
