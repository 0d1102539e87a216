#include "limpid/files/exr/deep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "limpid/core/error.h"

#include "files/exr/deep_flatten.h"

namespace limpid {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// Index of each channel in a block's values; -1: the part has none.
struct DeepChannels {
  std::vector<std::string> names;
  int z = -1, back = -1;
  std::array<int, 4> color{-1, -1, -1, -1}, alpha{-1, -1, -1, -1};
  float nothing = 0, back_nothing = 0;  ///< depths from these values on mean "nothing hit"
};

/// Throws Error (begins with the path) if a channel is missing that deep pixels need.
DeepChannels channels_of(const ExrFile& file, int part) {
  if (part < 0 || part >= static_cast<int>(file.parts().size())) {
    throw Error(file.path().string() + ": part " + std::to_string(part) + ": expected 0 ... " +
                std::to_string(file.parts().size() - 1));
  }
  const std::vector<ExrChannel>& stored = file.parts()[part].channels;
  DeepChannels channels;
  const auto find = [&](const std::string& name, float* nothing = nullptr) {
    const auto found = std::find_if(stored.begin(), stored.end(),
                                    [&](const ExrChannel& c) { return c.name == name; });
    if (found == stored.end()) return -1;
    if (nothing != nullptr) *nothing = found->type == SampleType::kHalf ? 6e4f : 1e9f;
    channels.names.push_back(name);
    return static_cast<int>(channels.names.size()) - 1;
  };
  const auto need = [&](const std::string& name, float* nothing = nullptr) {
    const int index = find(name, nothing);
    if (index < 0) {
      std::vector<std::string> known;
      for (const ExrChannel& c : stored) known.push_back(c.name);
      throw Error(file.path().string() + ": no channel '" + name + "' in part " +
                  std::to_string(part) + ", which has " + join(known) +
                  ": deep pixels need R, G, B, A and Z");
    }
    return index;
  };
  channels.z = need("Z", &channels.nothing);
  channels.color = {need("R"), need("G"), need("B"), need("A")};
  channels.back = find("ZBack", &channels.back_nothing);
  channels.alpha = {find("AR"), find("AG"), find("AB"), channels.color[3]};
  for (int& alpha : channels.alpha) {
    if (alpha < 0) alpha = channels.color[3];
  }
  return channels;
}

/// Reads the samples of one pixel from a block, and sanitises them.
class SampleReader {
 public:
  SampleReader(const DeepChannels& channels, SanitiseCounts& replaced)
      : channels_(channels), replaced_(replaced) {}

  std::span<const DeepSample> read(const DeepBlock& block, std::size_t pixel) {
    samples_.clear();
    for (std::size_t s = block.first[pixel]; s < block.first[pixel + 1]; ++s) {
      const auto value = [&](int channel) { return block.values[channel][s]; };
      const float front = value(channels_.z);
      if (std::isnan(front) || front == -kInf) {
        count(PlaneId::kDepth, front);
        continue;
      }
      DeepSample sample;
      sample.front = sample.back = front >= channels_.nothing ? kInf : front;
      if (channels_.back >= 0) {
        const float back = value(channels_.back);
        if (std::isnan(back) || back == -kInf) count(PlaneId::kDepth, back);
        if (back > front && back < channels_.back_nothing) sample.back = back;
      }
      for (int c = 0; c < 3; ++c) sample.color[c] = finite(value(channels_.color[c]));
      const float alpha = finite(value(channels_.color[3]));
      for (int c = 0; c < 4; ++c) {
        const bool shared = channels_.alpha[c] == channels_.color[3];
        const float own = shared ? alpha : finite(value(channels_.alpha[c]));
        sample.alpha[c] = std::clamp(own, 0.0f, 1.0f);
      }
      sample.color[3] = sample.alpha[3];
      samples_.push_back(sample);
    }
    return samples_;
  }

 private:
  void count(PlaneId role, float value) {
    Replaced& replaced = replaced_.of(role);
    ++(std::isnan(value) ? replaced.nan : replaced.inf);
  }

  float finite(float value) {
    if (std::isfinite(value)) return value;
    count(PlaneId::kColorR, value);
    return value > 0 ? kLargestColor : 0;
  }

  const DeepChannels& channels_;
  SanitiseCounts& replaced_;
  std::vector<DeepSample> samples_;
};

float float_of(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::isinf(value) ? value : std::clamp(value, -kMost, kMost));
}

void fill(const View<float>& plane, float value) {
  for (int y = plane.window.y0; y < plane.window.y1; ++y) {
    std::fill_n(plane.row(y), plane.window.width(), value);
  }
}

DeepLayers empty_layers(const ExrFile& file, const Rect& window, bool water) {
  const std::int64_t planes = 4 + 1 + 3 + 1 + (water ? 4 : 0);
  const std::int64_t most = file.limits().max_memory;
  if (window.area() > most / (planes * std::int64_t{sizeof(float)})) {
    throw Error(file.path().string() + ": its deep layers need more memory than the limit of " +
                std::to_string(most) + " bytes");
  }
  DeepLayers layers;
  for (Plane& plane : layers.color) plane = Plane(window);
  for (Plane& plane : layers.below_color) plane = Plane(window);
  if (water) {
    for (Plane& plane : layers.foreground) plane = Plane(window);
  }
  layers.depth = Plane(window);
  layers.below_depth = Plane(window);
  fill(layers.depth.view(), kInf);
  fill(layers.below_depth.view(), kInf);
  return layers;
}

/// Whether the nearest surface behind the water, at this depth, is transparent: a point sample,
/// because a volume is no pane.
bool is_transparent(std::span<const DeepSample> samples, double nearest) {
  bool clear = false, behind = false;
  for (const DeepSample& sample : samples) {
    const bool point = sample.back == sample.front;
    if (sample.front == nearest && sample.alpha[3] > 0) clear |= point && sample.alpha[3] < 0.99;
    behind |= sample.front > nearest && sample.front < kInf && sample.alpha[3] > 0;
  }
  return clear && behind;
}

std::size_t place(const Rect& window, int x, int y) {
  return static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width()) +
         static_cast<std::size_t>(x - window.x0);
}

/// Number of set pixels whose neighbours are all set: an edge is transparent, too, but narrow.
std::int64_t count_inner(const std::vector<bool>& set, const Rect& w) {
  std::int64_t count = 0;
  for (int y = w.y0 + 1; !set.empty() && y < w.y1 - 1; ++y) {
    for (int x = w.x0 + 1; x < w.x1 - 1; ++x) {
      bool inner = true;
      for (int k = 0; inner && k < 9; ++k) inner = set[place(w, x + k % 3 - 1, y + k / 3 - 1)];
      count += inner;
    }
  }
  return count;
}

}  // namespace

DeepLayers read_deep_layers(const ExrFile& file, int part, View<const float> surface) {
  const DeepChannels channels = channels_of(file, part);
  const Rect& window = surface.window;
  DeepLayers layers = empty_layers(file, window, static_cast<bool>(surface));
  std::int64_t wet = 0;
  std::vector<bool> transparent(static_cast<std::size_t>(surface ? window.area() : 0));
  SampleReader reader(channels, layers.replaced);
  DeepFlattener flattener;
  file.read_deep(part, channels.names, [&](const DeepBlock& block) {
    const Rect wanted = intersection(block.window, window);
    for (int y = wanted.y0; y < wanted.y1; ++y) {
      for (int x = wanted.x0; x < wanted.x1; ++x) {
        const std::ptrdiff_t pixel =
            x - block.window.x0 + std::ptrdiff_t{y - block.window.y0} * block.window.width();
        const auto samples = reader.read(block, static_cast<std::size_t>(pixel));
        if (samples.empty()) continue;
        const FlatPixel all = flattener.flatten(samples, -HUGE_VAL);
        for (int c = 0; c < 4; ++c) layers.color[c].view().at(x, y) = float_of(all.color[c]);
        layers.depth.view().at(x, y) = float_of(all.depth);
        if (!surface || !(surface.at(x, y) < kInf)) continue;
        const FlatPixel below = flattener.flatten(samples, surface.at(x, y));
        for (int c = 0; c < 3; ++c)
          layers.below_color[c].view().at(x, y) = float_of(below.color[c]);
        layers.below_depth.view().at(x, y) = float_of(below.depth);
        const FlatPixel before = flattener.flatten(samples, -HUGE_VAL, surface.at(x, y));
        for (int c = 0; c < 4; ++c)
          layers.foreground[c].view().at(x, y) = float_of(before.color[c]);
        ++wet;
        transparent[place(window, x, y)] = is_transparent(samples, below.depth);
      }
    }
  });
  if (wet > 0) {
    layers.transparent = static_cast<double>(count_inner(transparent, window)) / double(wet);
  }
  return layers;
}

}  // namespace limpid
