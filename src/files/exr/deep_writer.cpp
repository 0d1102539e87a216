#include "limpid/files/exr/deep_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepImageStateAttribute.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include "limpid/core/error.h"

#include "files/exr/exr_heading.h"
#include "files/exr/exr_whole.h"
#include "files/exr/half_bits.h"

namespace limpid {
namespace {

constexpr float kMaxAlpha = 1 - 0x1p-24f;                ///< the float before 1
constexpr double kMaxOpticalDepth = 16.635532333438686;  ///< -ln(2^-24)

enum Channel { kZ, kBack, kA, kAr, kR = kAr + 3, kChannels = kR + 3 };
constexpr const char* kNames[kChannels] = {"Z", "ZBack", "A", "AR", "AG", "AB", "R", "G", "B"};
using Sample = std::array<float, kChannels>;

constexpr std::int64_t kBlockBytes = std::int64_t{8} << 20;
constexpr std::int64_t kPixelBytes = kChannels * (sizeof(float) + sizeof(char*));

Imf::PixelType type_of(int channel, bool half) {
  return half && channel >= kR ? Imf::HALF : Imf::FLOAT;
}

std::string at(int x, int y) {
  return " at pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
}

/// The water of one pixel; nothing without water. Throws Error for invalid values.
std::optional<Sample> sample_at(const DeepWater& water, std::optional<double> reach, int x, int y) {
  const float front = water.front.at(x, y), back = water.back.at(x, y);
  if (front >= kInfiniteDepth) return std::nullopt;
  if (!std::isfinite(front)) {
    throw Error("front depth " + std::to_string(front) + at(x, y) + ": expected a number or +inf");
  }
  if (!(back >= front)) {
    throw Error("back depth " + std::to_string(back) + at(x, y) +
                ": expected at least the front, " + std::to_string(front));
  }
  if (back == front) return std::nullopt;

  Sample sample;
  sample[kZ] = front;
  sample[kBack] = back;
  if (back >= kInfiniteDepth) {
    if (!reach) {
      throw Error("back depth is infinite" + at(x, y) +
                  ": expected extinction in a channel, to end the volume");
    }
    const double end = std::min<double>(front + *reach, kLargestDepth);
    sample[kBack] = std::max(static_cast<float>(end), std::nextafter(front, kInfiniteDepth));
  }
  double coverage = 0;
  for (int c = 0; c < 3; ++c) {
    const float transmittance = water.transmittance[c].at(x, y);
    const float color = water.in_scatter[c].at(x, y);
    if (std::isnan(transmittance)) {
      throw Error("transmittance is nan" + at(x, y) + ": expected 0 ... 1");
    }
    if (!std::isfinite(color)) {
      throw Error("in-scatter " + std::to_string(color) + at(x, y) + ": expected a number");
    }
    sample[kAr + c] = std::min(1 - std::clamp(transmittance, 0.0f, 1.0f), kMaxAlpha);
    sample[kR + c] = color;
    coverage += sample[kAr + c];
  }
  sample[kA] = std::min(static_cast<float>(coverage / 3), kMaxAlpha);
  return sample;
}

void check(const DeepWater& water) {
  check_heading(water);
  validate_deep_compression(water.compression);
  const auto check_view = [&](const View<const float>& view, const char* name) {
    if (!view || !view.window.contains(water.data)) {
      throw Error(std::string(name) + " does not cover the data window");
    }
  };
  check_view(water.front, "front depth");
  check_view(water.back, "back depth");
  for (const View<const float>& view : water.transmittance) check_view(view, "transmittance");
  for (const View<const float>& view : water.in_scatter) check_view(view, "in-scatter");
  for (double extinction : water.extinction) {
    if (!(extinction >= 0) || std::isinf(extinction)) {
      throw Error("extinction " + std::to_string(extinction) + ": expected 0 or more (1/unit)");
    }
  }
}

Imf::Header deep_header_of(const DeepWater& water) {
  Imf::Header header = header_of(water, compression_named(water.compression));
  add_file_hash(header);
  header.setType(Imf::DEEPSCANLINE);
  header.insert("maxSamplesPerPixel", Imf::IntAttribute(1));
  Imf::addDeepImageState(header, Imf::DIS_TIDY);
  for (int c = 0; c < kChannels; ++c) {
    header.channels().insert(kNames[c], Imf::Channel(type_of(c, water.half)));
  }
  return header;
}

/// The samples of some lines, as OpenEXR needs them: a count per pixel and, for each channel, a
/// pointer per pixel.
class Lines {
 public:
  Lines(int width, int lines) : width_(width), counts_(static_cast<std::size_t>(width) * lines) {
    for (auto& values : values_) values.resize(counts_.size());
    for (auto& pointers : pointers_) pointers.resize(counts_.size());
  }

  void put(std::size_t pixel, const std::optional<Sample>& sample, bool half) {
    counts_[pixel] = sample ? 1 : 0;
    for (int c = 0; c < kChannels; ++c) {
      float* value = &values_[c][pixel];
      pointers_[c][pixel] = sample ? reinterpret_cast<char*>(value) : nullptr;
      if (!sample) continue;
      *value = (*sample)[c];
      if (type_of(c, half) == Imf::HALF) {
        const std::uint16_t rounded = half_bits_of(*value);
        std::memcpy(value, &rounded, sizeof rounded);
      }
    }
  }

  /// For lines that begin at (x0, y0). OpenEXR needs the address of (0, 0), which may lie outside
  /// the memory, so it is computed in integers.
  Imf::DeepFrameBuffer frame(int x0, int y0, bool half) {
    const std::ptrdiff_t first = x0 + std::ptrdiff_t{y0} * width_;
    const auto origin = [&](void* memory, std::size_t bytes) {
      return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(memory) -
                                     static_cast<std::uintptr_t>(first) * bytes);
    };
    const std::size_t width = static_cast<std::size_t>(width_);
    Imf::DeepFrameBuffer frame;
    frame.insertSampleCountSlice({Imf::UINT, origin(counts_.data(), sizeof counts_[0]),
                                  sizeof counts_[0], sizeof counts_[0] * width});
    for (int c = 0; c < kChannels; ++c) {
      frame.insert(kNames[c], {type_of(c, half), origin(pointers_[c].data(), sizeof(char*)),
                               sizeof(char*), sizeof(char*) * width, sizeof(float)});
    }
    return frame;
  }

 private:
  int width_;
  std::vector<unsigned> counts_;
  std::array<std::vector<float>, kChannels> values_;
  std::array<std::vector<char*>, kChannels> pointers_;
};

void write_samples(Imf::DeepScanLineOutputFile& file, const DeepWater& water) {
  const Rect& data = water.data;
  const auto reach = deep_reach(water.extinction);
  const int most = static_cast<int>(
      std::clamp<std::int64_t>(kBlockBytes / (kPixelBytes * data.width()), 1, data.height()));
  Lines lines(data.width(), most);
  for (int y0 = data.y0; y0 < data.y1; y0 += most) {
    const int y1 = std::min(y0 + most, data.y1);
    std::size_t pixel = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = data.x0; x < data.x1; ++x) {
        lines.put(pixel++, sample_at(water, reach, x, y), water.half);
      }
    }
    file.setFrameBuffer(lines.frame(data.x0, y0, water.half));
    file.writePixels(y1 - y0);
    // As for flat pixels: it returns early if one of its threads had no memory.
    if (file.currentScanLine() != y1) throw std::bad_alloc();
  }
}

}  // namespace

std::optional<double> deep_reach(const std::array<double, 3>& extinction) {
  std::optional<double> reach;
  for (double e : extinction) {
    if (e > 0) reach = std::max(reach.value_or(0), kMaxOpticalDepth / e);
  }
  return reach;
}

void validate_deep_compression(const std::string& compression) {
  const Imf::Compression method = compression_named(compression).method;
  if (method != Imf::NO_COMPRESSION && method != Imf::RLE_COMPRESSION &&
      method != Imf::ZIPS_COMPRESSION) {
    throw Error(
        "compression '" + compression + "': deep pixels are stored with one of none, rle, zips",
        Fault::kUsage);
  }
}

void write_deep_water(const std::filesystem::path& path, const DeepWater& water) {
  AtomicFiles files;
  write_deep_water(files, path, water);
  files.commit();
}

void write_deep_water(AtomicFiles& files, const std::filesystem::path& path,
                      const DeepWater& water) {
  write_whole_exr(
      files, path, [&] { check(water); },
      [&](OutputStream& stream) {
        Imf::DeepScanLineOutputFile file(stream, deep_header_of(water));
        write_samples(file, water);
      });
}

}  // namespace limpid
