#include "files/exr/exr_header.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "files/exr/exr_attribute_size.h"
#include "files/file_hash.h"

namespace limpid {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kTiledFlag = 0x200, kDeepFlag = 0x800;
constexpr std::uint32_t kKnownFlags = kTiledFlag | 0x400 | kDeepFlag | kMultiPartFlag;
constexpr std::size_t kMaxName = 255;
constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t{64} << 20;
constexpr int kMaxCoordinate = 1 << 30;

std::uint32_t u32_of(const char* p) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = (value << 8) | static_cast<unsigned char>(p[i]);
  return value;
}

std::uint32_t read_u32(FileStream& stream) {
  char bytes[4];
  stream.read(bytes, 4);
  return u32_of(bytes);
}

std::string read_name(FileStream& stream) {
  std::string name;
  for (;;) {
    char c;
    stream.read(&c, 1);
    if (c == 0) return name;
    name += c;
    if (name.size() > kMaxName) throw Error("damaged header (a name of more than 255 letters)");
  }
}

/// The attributes of one header up to the empty name that ends it.
std::map<std::string, ExrFile::Attribute> read_attributes(FileStream& stream) {
  std::map<std::string, ExrFile::Attribute> attributes;
  for (std::string name = read_name(stream); !name.empty(); name = read_name(stream)) {
    ExrFile::Attribute attribute{read_name(stream), {}};
    const std::uint32_t size = read_u32(stream);
    if (size > stream.remaining() || stream.tellg() + size > kMaxHeaderBytes) {
      throw Error("damaged header (attribute '" + name + "' claims " + std::to_string(size) +
                  " bytes)");
    }
    attribute.bytes.resize(size);
    if (size > 0) stream.read(attribute.bytes.data(), static_cast<int>(size));
    check_attribute_size(name, attribute);
    if (!attributes.emplace(name, std::move(attribute)).second) {
      throw Error("damaged header (two attributes '" + name + "')");
    }
  }
  return attributes;
}

/// Reads values from the bytes of one attribute, and throws if they end too early.
class AttributeReader {
 public:
  AttributeReader(const ExrHeader& header, const std::string& name, std::string_view type)
      : name_(name) {
    const auto found = header.attributes.find(name);
    if (found == header.attributes.end()) {
      throw Error("damaged header (no attribute '" + name + "')");
    }
    if (found->second.type != type) {
      throw Error("damaged header (attribute '" + name + "' is of type '" + found->second.type +
                  "', expected '" + std::string(type) + "')");
    }
    rest_ = found->second.bytes;
  }

  std::span<const char> take(std::size_t count) {
    if (rest_.size() < count)
      throw Error("damaged header (attribute '" + name_ + "' is too short)");
    const std::span<const char> taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  std::uint32_t u32() { return u32_of(take(4).data()); }
  int i32() { return static_cast<int>(u32()); }
  unsigned byte() { return static_cast<unsigned char>(take(1)[0]); }
  std::string name() {
    std::string text;
    for (char c = take(1)[0]; c != 0; c = take(1)[0]) text += c;
    return text;
  }
  std::string rest() const { return {rest_.begin(), rest_.end()}; }
  bool ended() const { return rest_.empty(); }

 private:
  std::string name_;
  std::span<const char> rest_;
};

Rect window_of(const ExrHeader& header, const std::string& name) {
  AttributeReader reader(header, name, "box2i");
  const int x0 = reader.i32(), y0 = reader.i32(), x1 = reader.i32(), y1 = reader.i32();
  for (int v : {x0, y0, x1, y1}) {
    if (v < -kMaxCoordinate || v > kMaxCoordinate) {
      throw Error(name + " reaches to " + std::to_string(v) + ": expected at most " +
                  std::to_string(kMaxCoordinate));
    }
  }
  if (x1 < x0 || y1 < y0) throw Error(name + " is empty: expected at least one pixel");
  return {x0, y0, x1 + 1, y1 + 1};
}

std::vector<ExrChannel> channels_of(const ExrHeader& header, int limit) {
  AttributeReader reader(header, "channels", "chlist");
  std::vector<ExrChannel> channels;
  for (std::string name = reader.name(); !name.empty(); name = reader.name()) {
    const std::uint32_t type = reader.u32();
    reader.take(4);
    const int x_sampling = reader.i32(), y_sampling = reader.i32();
    constexpr SampleType kTypes[] = {SampleType::kUint, SampleType::kHalf, SampleType::kFloat};
    if (type > 2 || x_sampling < 1 || y_sampling < 1) {
      throw Error("damaged header (channel '" + name + "' has an impossible type or sampling)");
    }
    if (channels.size() >= static_cast<std::size_t>(limit)) {
      throw Error("more than " + std::to_string(limit) + " channels in one part, the limit");
    }
    channels.push_back({name, kTypes[type], x_sampling, y_sampling});
  }
  if (channels.empty()) throw Error("damaged header (no channel)");
  return channels;
}

std::string text_of(const ExrHeader& header, const std::string& name) {
  return header.attributes.contains(name) ? AttributeReader(header, name, "string").rest() : "";
}

/// The names in a list of texts, each after its length.
std::vector<std::string> texts_of(const ExrHeader& header, const std::string& name, int limit) {
  if (!header.attributes.contains(name)) return {};
  AttributeReader reader(header, name, "stringvector");
  std::vector<std::string> texts;
  while (!reader.ended()) {
    const std::span<const char> text = reader.take(reader.u32());
    texts.emplace_back(text.begin(), text.end());
    if (texts.size() > static_cast<std::size_t>(limit)) {
      throw Error("more than " + std::to_string(limit) + " texts in '" + name + "', the limit");
    }
  }
  return texts;
}

double pixel_aspect_of(const ExrHeader& header) {
  const std::uint32_t bits = AttributeReader(header, "pixelAspectRatio", "float").u32();
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

ExrHeader header_of(std::map<std::string, ExrFile::Attribute> attributes, std::uint32_t flags,
                    const Limits& limits) {
  ExrHeader header;
  header.attributes = std::move(attributes);
  ExrPart& part = header.part;
  part.name = text_of(header, "name");
  part.view = text_of(header, "view");
  part.views = texts_of(header, "multiView", limits.max_channels);
  part.data = window_of(header, "dataWindow");
  part.display = window_of(header, "displayWindow");
  part.pixel_aspect = pixel_aspect_of(header);
  part.channels = channels_of(header, limits.max_channels);

  const unsigned compression = AttributeReader(header, "compression", "compression").byte();
  if (compression >= kCompressions.size()) {
    throw Error("compression number " + std::to_string(compression) + " is unknown");
  }
  header.compression = static_cast<int>(compression);
  part.compression = kCompressions[compression];

  const std::string type = text_of(header, "type");
  if (type.empty()) {
    if (flags & (kMultiPartFlag | kDeepFlag)) throw Error("damaged header (a part without type)");
    part.tiled = (flags & kTiledFlag) != 0;
  } else if (type == "scanlineimage" || type == "tiledimage" || type == "deepscanline" ||
             type == "deeptile") {
    // In a single-part file of flat pixels the flag decides, as in OpenEXR.
    const bool type_decides = (flags & (kMultiPartFlag | kDeepFlag)) != 0;
    part.deep = type_decides && type.starts_with("deep");
    part.tiled =
        type_decides ? type == "tiledimage" || type == "deeptile" : (flags & kTiledFlag) != 0;
  } else {
    throw Error("a part of the unknown type '" + type + "'");
  }
  if (part.tiled) {
    AttributeReader tiles(header, "tiles", "tiledesc");
    header.tile_width = tiles.u32();
    header.tile_height = tiles.u32();
  }
  if (header.attributes.contains("chunkCount")) {
    header.chunk_count = AttributeReader(header, "chunkCount", "int").i32();
    if (header.chunk_count < 0) throw Error("damaged header (a negative count of chunks)");
  }
  return header;
}

}  // namespace

bool is_structural(std::string_view attribute) {
  constexpr std::string_view kNames[] = {"channels",
                                         "compression",
                                         "dataWindow",
                                         "displayWindow",
                                         "lineOrder",
                                         "tiles",
                                         "chunkCount",
                                         "type",
                                         "name",
                                         "version",
                                         "preview",
                                         "pixelAspectRatio",
                                         "maxSamplesPerPixel",
                                         "deepImageState",
                                         "dwaCompressionLevel",
                                         kFileHashName};
  return std::find(std::begin(kNames), std::end(kNames), attribute) != std::end(kNames);
}

bool describes_content(std::string_view attribute) {
  constexpr std::string_view kFamilies[] = {"cryptomatte/", "idmanifest/", "limpid/"};
  constexpr std::string_view kNames[] = {"multiView",
                                         "idManifest",
                                         "envmap",
                                         "wrapmodes",
                                         "acesImageContainerFlag",
                                         "BlenderMultiChannel",
                                         "nuke/full_layer_names",
                                         "oiio:subimages",
                                         "oiio:subimagename",
                                         "oiio:AverageColor",
                                         "oiio:ConstantColor",
                                         "oiio:SHA-1",
                                         "spectralLayoutVersion",
                                         "textureformat"};
  const auto begins = [&](std::string_view family) { return attribute.starts_with(family); };
  return std::any_of(std::begin(kFamilies), std::end(kFamilies), begins) ||
         std::find(std::begin(kNames), std::end(kNames), attribute) != std::end(kNames);
}

std::vector<ExrHeader> read_exr_headers(FileStream& stream, const Limits& limits) {
  if (stream.remaining() < 8 || read_u32(stream) != kMagic) throw Error("is not an OpenEXR file");
  const std::uint32_t version = read_u32(stream);
  const std::uint32_t flags = version & ~0xffu;
  if ((version & 0xff) != kVersion || (flags & ~kKnownFlags) != 0) {
    throw Error("is an OpenEXR file of another version than 2");
  }
  const bool multi_part = (flags & kMultiPartFlag) != 0;
  if ((flags & kTiledFlag) != 0 && (flags & (kDeepFlag | kMultiPartFlag)) != 0) {
    throw Error("damaged header (contradicting flags)");
  }

  std::vector<ExrHeader> headers;
  for (;;) {
    auto attributes = read_attributes(stream);
    if (attributes.empty()) {
      if (multi_part && !headers.empty()) break;
      throw Error("damaged header (it is empty)");
    }
    if (headers.size() >= static_cast<std::size_t>(limits.max_parts)) {
      throw Error("more than " + std::to_string(limits.max_parts) + " parts, the limit");
    }
    headers.push_back(header_of(std::move(attributes), flags, limits));
    if (!multi_part) break;
  }
  return headers;
}

}  // namespace limpid
