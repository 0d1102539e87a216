#include "files/exr/exr_heading.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOpaqueAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>

#include "files/exr/exr_header.h"
#include "files/exr/exr_streams.h"
#include "files/file_hash.h"

namespace limpid {
namespace {

constexpr std::size_t kMaxName = 255;

Imath::Box2i box_of(const Rect& r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

/// Attributes that every header has are typed; all others are copied as bytes.
void inherit(Imf::Header& header, const std::string& name, const ExrFile::Attribute& attribute) {
  BytesStream bytes(attribute.bytes);
  const int size = static_cast<int>(attribute.bytes.size());
  if (const auto own = header.find(name); own != header.end()) {
    if (attribute.type != own.attribute().typeName()) {
      throw Error("attribute '" + name + "' of type '" + attribute.type + "': expected '" +
                  own.attribute().typeName() + "'");
    }
    own.attribute().readValueFrom(bytes, size, Imf::EXR_VERSION);
    return;
  }
  Imf::OpaqueAttribute opaque(attribute.type.c_str());
  opaque.readValueFrom(bytes, size, Imf::EXR_VERSION);
  header.insert(name, opaque);
}

}  // namespace

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

void check_heading(const ExrHeading& heading) {
  if (heading.data.empty()) throw Error("the data window is empty: expected at least 1x1");
  if (heading.display.empty()) throw Error("the display window is empty: expected at least 1x1");
  if (!(heading.pixel_aspect > 0) || !std::isfinite(heading.pixel_aspect)) {
    throw Error("pixel aspect ratio " + std::to_string(heading.pixel_aspect) +
                ": expected a number above 0");
  }
  const auto check_name = [&](const std::string& name) {
    if (is_structural(name) || name.empty() || name.size() > kMaxName) {
      throw Error("attribute name '" + name +
                  "': expected a name of 1 ... 255 letters that does "
                  "not describe how pixels are stored");
    }
  };
  for (const auto& [name, value] : heading.text) check_name(name);
  for (const auto& [name, value] : heading.matrices) check_name(name);
}

Imf::Header header_of(const ExrHeading& heading, const Compression& compression) {
  Imf::Header header(box_of(heading.display), box_of(heading.data),
                     static_cast<float>(heading.pixel_aspect));
  for (const auto& [name, attribute] : heading.inherited) {
    const bool ours = heading.text.contains(name) || heading.matrices.contains(name);
    if (!ours && !is_structural(name)) inherit(header, name, attribute);
  }
  header.compression() = compression.method;
  if (compression.level) {
    const auto level = *compression.level;
    const bool zip =
        compression.method == Imf::ZIP_COMPRESSION || compression.method == Imf::ZIPS_COMPRESSION;
    if (zip) {
      header.zipCompressionLevel() = static_cast<int>(level);
    } else {
      header.dwaCompressionLevel() = static_cast<float>(level);
    }
  }
  for (const auto& [name, value] : heading.text) header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : heading.matrices) {
    Imath::M44f matrix;
    std::copy(value.begin(), value.end(), matrix.getValue());
    header.insert(name, Imf::M44fAttribute(matrix));
  }
  return header;
}

void add_file_hash(Imf::Header& header) {
  header.insert(std::string(kFileHashName), Imf::StringAttribute(std::string(kNoFileHash)));
}

}  // namespace limpid
