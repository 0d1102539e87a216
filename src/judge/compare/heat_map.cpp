#include "judge/compare/heat_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "limpid/core/error.h"
#include "limpid/files/picture/image_file.h"

#include "judge/compare/compared_channels.h"

namespace limpid {
namespace {

constexpr std::array<float, 3> kMagenta = {1, 0, 1};

// sRGB, 8 bits, at places 0, 1/8 ... 1.
constexpr std::array<std::array<float, 3>, 9> kViridis = {{{68, 1, 84},
                                                           {71, 45, 123},
                                                           {59, 82, 139},
                                                           {44, 114, 142},
                                                           {33, 145, 140},
                                                           {40, 174, 128},
                                                           {94, 201, 98},
                                                           {173, 220, 48},
                                                           {253, 231, 37}}};

void check_scale(const HeatScale& scale) {
  if (!(scale.maximum > 0 && std::isfinite(scale.maximum))) {
    throw Error("heat map: maximum of " + std::to_string(scale.maximum) + ": expected above 0");
  }
  if (!(scale.decades >= 0 && scale.decades <= 30)) {
    throw Error("heat map: " + std::to_string(scale.decades) + " decades: expected 0 ... 30");
  }
}

double place_of(double d, const HeatScale& scale) {
  const double share = d / scale.maximum;
  return scale.decades == 0 ? share : 1 + std::log10(share) / scale.decades;
}

}  // namespace

std::array<float, 3> heat_color(double place) {
  // Written so that NaN counts as 0.
  const double at = (place > 0 ? std::min(place, 1.0) : 0.0) * (kViridis.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
  const auto t = static_cast<float>(at - static_cast<double>(lower));
  std::array<float, 3> color;
  for (std::size_t c = 0; c < 3; ++c) {
    color[c] = std::lerp(kViridis[lower][c], kViridis[lower + 1][c], t) / 255;
  }
  return color;
}

std::array<Plane, 3> heat_map(std::span<const ComparedChannel> channels, const HeatScale& scale) {
  check_compared(channels);
  check_scale(scale);
  const Rect window = channels[0].a.window;
  std::array<Plane, 3> rgb = {Plane(window), Plane(window), Plane(window)};
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      double largest = 0;
      for (const ComparedChannel& channel : channels) {
        largest = std::max(largest, difference(channel.a.at(x, y), channel.b.at(x, y)));
      }
      const auto color = std::isinf(largest) ? kMagenta : heat_color(place_of(largest, scale));
      for (std::size_t c = 0; c < 3; ++c) rgb[c].view().at(x, y) = color[c];
    }
  }
  return rgb;
}

void write_heat_map(const std::filesystem::path& path, std::span<const ComparedChannel> channels,
                    const HeatScale& scale) {
  const std::array<Plane, 3> rgb = heat_map(channels, scale);
  write_image8(path, {rgb[0].view(), rgb[1].view(), rgb[2].view()});
}

}  // namespace limpid
