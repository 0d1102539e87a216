#include "files/exr/exr_compression.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "files/exr/exr_header.h"

namespace limpid {

Compression compression_named(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const auto found = std::find(kCompressions.begin(), kCompressions.end(), name);
  if (found == kCompressions.end()) {
    const std::vector<std::string> known(kCompressions.begin(), kCompressions.end());
    throw Error(
        "compression '" + name + "': expected one of " + join(known) + did_you_mean(name, known),
        Fault::kUsage);
  }
  Compression compression{static_cast<Imf::Compression>(found - kCompressions.begin()), {}};
  if (colon == std::string::npos) return compression;

  const bool zip = name == "zip" || name == "zips", dwa = name == "dwaa" || name == "dwab";
  if (!zip && !dwa) {
    throw Error("compression '" + text + "': " + name + " has no level, only zip, zips, dwaa, dwab",
                Fault::kUsage);
  }
  double level = 0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data() + colon + 1, end, level);
  const bool in_range =
      zip ? level >= 1 && level <= 9 && level == std::floor(level) : level >= 0 && level <= 100000;
  if (failure != std::errc() || stop != end || !in_range) {
    throw Error("compression '" + text + "': expected a level of " +
                    (zip ? "1 ... 9, whole" : "0 ... 100000"),
                Fault::kUsage);
  }
  compression.level = level;
  return compression;
}

}  // namespace limpid
