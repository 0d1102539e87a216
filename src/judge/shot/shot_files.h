#pragma once
#include <string>
#include <string_view>

/// File names of the pictures of a shot's page.

namespace limpid {

inline constexpr const char* kDryFile = "dry.png";
inline constexpr const char* kWetFile = "wet.png";
inline constexpr const char* kTruthFile = "truth.png";

inline std::string aov_file(std::string_view aov) { return "aov_" + std::string(aov) + ".png"; }
/// The n-th look for comparison, from 1.
inline std::string look_file(std::size_t n) { return "look_" + std::to_string(n) + ".png"; }
inline std::string without_file(std::string_view op) {
  return "without_" + std::string(op) + ".png";
}

/// The difference of that file's picture from the shot's.
inline std::string difference_file(const std::string& file) {
  return file.substr(0, file.rfind('.')) + "_difference.png";
}

}  // namespace limpid
