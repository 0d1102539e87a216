#include "plate/primaries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace limpid {
namespace {

/// x and y of red, green, blue and white.
using Chromaticities = std::array<float, 8>;

struct Space {
  std::string_view name;
  Chromaticities xy;
};

constexpr std::string_view kOurs = "Rec.709";
// clang-format off
constexpr Space kSpaces[] = {
    {kOurs,              {.64f, .33f, .30f, .60f, .15f, .06f, .3127f, .3290f}},
    {"ACEScg (AP1)",     {.713f, .293f, .165f, .830f, .128f, .044f, .32168f, .33767f}},
    {"ACES2065-1 (AP0)", {.7347f, .2653f, 0, 1, .0001f, -.077f, .32168f, .33767f}},
    {"Rec.2020",         {.708f, .292f, .170f, .797f, .131f, .046f, .3127f, .3290f}},
    {"P3-D65",           {.680f, .320f, .265f, .690f, .150f, .060f, .3127f, .3290f}},
    {"DCI-P3",           {.680f, .320f, .265f, .690f, .150f, .060f, .314f, .351f}},
    {"Adobe RGB",        {.64f, .33f, .21f, .71f, .15f, .06f, .3127f, .3290f}},
};
// clang-format on

bool agree(const Chromaticities& a, const Chromaticities& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](float x, float y) { return std::abs(x - y) <= 0.001f; });
}

/// Little-endian, as everything in the file.
Chromaticities chromaticities_of(const std::vector<char>& bytes) {
  Chromaticities xy;
  for (std::size_t i = 0; i < xy.size(); ++i) {
    std::uint32_t bits = 0;
    for (std::size_t b = 4; b-- > 0;) {
      bits = bits << 8 | static_cast<unsigned char>(bytes[4 * i + b]);
    }
    std::memcpy(&xy[i], &bits, sizeof bits);
  }
  return xy;
}

}  // namespace

std::string other_primaries(const std::map<std::string, ExrFile::Attribute>& attributes) {
  const auto found = attributes.find("chromaticities");
  if (found == attributes.end() || found->second.type != "chromaticities" ||
      found->second.bytes.size() != 8 * sizeof(float)) {
    return "";
  }
  const Chromaticities c = chromaticities_of(found->second.bytes);
  const auto space = std::find_if(std::begin(kSpaces), std::end(kSpaces),
                                  [&](const Space& s) { return agree(c, s.xy); });
  if (space != std::end(kSpaces)) {
    return space->name == kOurs ? "" : std::string(space->name);
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "red (%.4g, %.4g), green (%.4g, %.4g), blue (%.4g, %.4g), white (%.4g, %.4g)", c[0],
                c[1], c[2], c[3], c[4], c[5], c[6], c[7]);
  return text;
}

}  // namespace limpid
