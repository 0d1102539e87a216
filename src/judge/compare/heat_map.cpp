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
