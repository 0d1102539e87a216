#include <array>
#include <chrono>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "limpid/core/simd.h"
#include "limpid/version.h"

#include "judge/report/measure.h"
#include "judge/report/now.h"

namespace limpid {
namespace {

/// The text after the first `key` of a text file, without blanks and quotes around it; "" if there
/// is no file or key.
std::string entry(const char* file, std::string_view key, char separator) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(separator);
    if (!line.starts_with(key) || at == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(" \t\"", at + 1);
    if (first == std::string::npos) return "";
    return line.substr(first, line.find_last_not_of(" \t\"") + 1 - first);
  }
  return "";
}

std::string or_unknown(const std::string& text) { return text.empty() ? "unknown" : text; }

std::string processor() {
  for (const char* key : {"model name", "Model", "Hardware"}) {
    const std::string name = entry("/proc/cpuinfo", key, ':');
    if (!name.empty()) return name;
  }
  return "unknown";
}

std::string first_line(const char* file) {
  std::ifstream lines(file);
  std::string line;
  std::getline(lines, line);
  return line;
}

}  // namespace

std::string now_text() {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  std::array<char, 32> text;
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

ReportMachine this_machine() {
  return {processor(), or_unknown(entry("/etc/os-release", "PRETTY_NAME", '=')),
          or_unknown(first_line("/proc/sys/kernel/osrelease")),
          static_cast<int>(std::thread::hardware_concurrency()), simd_targets()};
}

ReportBuild this_build() {
  return {kVersion, LIMPID_COMPILER, LIMPID_BUILD_TYPE, LIMPID_LIBRARIES};
}

}  // namespace limpid
