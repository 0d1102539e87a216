#include "plate/primaries.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/files/picture/image_file.h"

namespace limpid {
namespace {

constexpr const char* kNumbers = "chromaticities";
constexpr const char* kNames[] = {"colorInteropID", "oiio:ColorSpace"};

/// x and y of red, green, blue and white.
using Chromaticities = std::array<float, 8>;

/// Little-endian, like all numbers in the file.
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

std::vector<char> bytes_of(const Primaries& p) {
  std::vector<char> bytes;
  for (const double number :
       {p.red.x, p.red.y, p.green.x, p.green.y, p.blue.x, p.blue.y, p.white.x, p.white.y}) {
    const auto value = static_cast<float>(number);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int b = 0; b < 4; ++b) bytes.push_back(static_cast<char>(bits >> 8 * b & 0xff));
  }
  return bytes;
}

/// The known space itself, if they are equal up to the file's rounding.
Primaries told_by(const std::vector<char>& bytes) {
  const Chromaticities c = chromaticities_of(bytes);
  const Primaries told{{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}};
  told.validate();
  return find_color_space(to_string(told)).value_or(told);
}

}  // namespace

std::optional<Primaries> told_primaries(const Attributes& attributes) {
  const auto numbers = attributes.find(kNumbers);
  if (numbers != attributes.end() && numbers->second.type == kNumbers &&
      numbers->second.bytes.size() == sizeof(Chromaticities)) {
    return told_by(numbers->second.bytes);
  }
  for (const char* name : kNames) {
    const auto word = attributes.find(name);
    if (word == attributes.end() || word->second.type != "string") continue;
    const std::vector<char>& bytes = word->second.bytes;
    if (const auto known = find_color_space({bytes.data(), bytes.size()})) return known;
  }
  return std::nullopt;
}

std::optional<Primaries> told_primaries(const std::filesystem::path& path) {
  if (!holds_exr(path)) return std::nullopt;
  const Attributes attributes = ExrFile::open(path).attributes(0);
  try {
    return told_primaries(attributes);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
}

void tell_primaries(Attributes& attributes, const Primaries& primaries) {
  std::optional<Primaries> told;
  try {
    told = told_primaries(attributes);
  } catch (const Error&) {
    // Named ones replace them.
  }
  if (told ? agree(*told, primaries) : agree(kRec709, primaries)) return;
  for (const char* name : kNames) attributes.erase(name);
  attributes[kNumbers] = {kNumbers, bytes_of(primaries)};
}

}  // namespace limpid
