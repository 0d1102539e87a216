#include "files/exr/exr_attribute_size.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "limpid/core/error.h"

namespace limpid {
namespace {

struct TypeSize {
  std::string_view type;
  std::size_t bytes;
};
constexpr TypeSize kSizes[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};

constexpr std::size_t kChannelBytes = 16;  // after a channel's name

/// Bytes of a list of channels up to the empty name that ends it; more than there are if it is
/// missing.
std::size_t channel_list_bytes(std::span<const char> bytes) {
  std::size_t at = 0;
  while (at < bytes.size() && bytes[at] != 0) {
    const auto end = std::find(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), '\0');
    at = static_cast<std::size_t>(end - bytes.begin()) + 1 + kChannelBytes;
  }
  return at + 1;
}

[[noreturn]] void refuse(const std::string& name, const ExrFile::Attribute& attribute) {
  throw Error("damaged header (attribute '" + name + "' of type '" + attribute.type + "' has " +
              std::to_string(attribute.bytes.size()) + " bytes)");
}

}  // namespace

void check_attribute_size(const std::string& name, const ExrFile::Attribute& attribute) {
  const std::size_t size = attribute.bytes.size();
  const auto known = std::find_if(std::begin(kSizes), std::end(kSizes),
                                  [&](const TypeSize& t) { return t.type == attribute.type; });
  if (known != std::end(kSizes) && size != known->bytes) refuse(name, attribute);
  if (attribute.type == "floatvector" && size % 4 != 0) refuse(name, attribute);
  if (attribute.type == "chlist" && size != channel_list_bytes(attribute.bytes)) {
    refuse(name, attribute);
  }
  // OpenEXR 3.1 itself reads four bytes too many.
  if (attribute.type == "idmanifest") {
    throw Error("attribute '" + name + "' of type 'idmanifest' is not supported");
  }
}

}  // namespace limpid
