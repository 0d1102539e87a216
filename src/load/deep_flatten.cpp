#include "load/deep_flatten.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace limpid {
namespace {

/// Optical depth of an alpha below 1, and the light that its color stands for were nothing
/// absorbed.
struct Medium {
  double optical_depth, light;
};

Medium medium_of(double alpha, double color) {
  if (alpha <= 0) return {0, color};
  const double optical_depth = -std::log1p(-alpha);
  return {optical_depth, color * (optical_depth / alpha)};
}

/// What has been composited of one channel so far.
struct Channel {
  double color = 0, through = 1;

  void over(const Medium& medium) {
    const double u = medium.optical_depth;
    color += through * (u > 0 ? medium.light * (-std::expm1(-u) / u) : medium.light);
    through *= std::exp(-u);
  }
  void close(double wall) {
    color += through * wall;
    through = 0;
  }
};

/// The sums over the volumes at the current depth, per unit of depth.
struct Inside {
  int volumes = 0;
  std::array<Medium, 4> density{};

  void add(const DeepSample& sample, int sign) {
    volumes += sign;
    if (volumes == 0) {
      density = {};  // nothing is left of rounding errors
      return;
    }
    for (int c = 0; c < 4; ++c) {
      if (sample.alpha[c] >= 1) continue;
      const Medium whole = medium_of(sample.alpha[c], sample.color[c]);
      const double share = sign / (sample.back - sample.front);
      density[c].optical_depth += whole.optical_depth * share;
      density[c].light += whole.light * share;
    }
  }
};

/// Samples at one and the same depth, of one channel: opaque ones hide the others and share.
struct Coincident {
  Medium sum{};
  double walls = 0;
  int opaque = 0;

  void add(double alpha, double color) {
    if (alpha >= 1) {
      ++opaque;
      walls += color;
    } else {
      const Medium medium = medium_of(alpha, color);
      sum.optical_depth += medium.optical_depth;
      sum.light += medium.light;
    }
  }
  void put(Channel& channel) const {
    if (opaque > 0) {
      channel.close(walls / opaque);
    } else {
      channel.over(sum);
    }
  }
};

bool any(const std::array<double, 4>& alpha, bool (*holds)(double)) {
  return std::any_of(alpha.begin(), alpha.end(), holds);
}

}  // namespace

FlatPixel DeepFlattener::flatten(std::span<const DeepSample> samples, double from) {
  FlatPixel flat;
  events_.clear();
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const DeepSample& sample = samples[i];
    const bool volume = sample.back > sample.front;
    if (volume ? sample.back <= from : sample.front <= from) continue;
    const double front = volume ? std::max(sample.front, from) : sample.front;
    if (any(sample.alpha, [](double a) { return a > 0; })) flat.depth = std::min(flat.depth, front);
    if (!volume) {
      events_.push_back({front, Kind::kPoint, i});
      continue;
    }
    if (any(sample.alpha, [](double a) { return a >= 1; })) {
      events_.push_back({front, Kind::kOpaqueVolume, i});
    }
    if (any(sample.alpha, [](double a) { return a < 1; })) {
      events_.push_back({front, Kind::kVolumeBegins, i});
      events_.push_back({sample.back, Kind::kVolumeEnds, i});
    }
  }
  std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
    return std::tie(a.depth, a.kind, a.sample) < std::tie(b.depth, b.kind, b.sample);
  });

  std::array<Channel, 4> channels;
  Inside inside;
  double depth = 0;
  for (std::size_t i = 0; i < events_.size();) {
    const Event& event = events_[i];
    if (inside.volumes > 0 && event.depth > depth) {
      const double length = event.depth - depth;
      for (int c = 0; c < 4; ++c) {
        channels[c].over({std::max(0.0, inside.density[c].optical_depth * length),
                          inside.density[c].light * length});
      }
    }
    depth = event.depth;
    if (event.kind == Kind::kVolumeBegins || event.kind == Kind::kVolumeEnds) {
      inside.add(samples[event.sample], event.kind == Kind::kVolumeBegins ? 1 : -1);
      ++i;
      continue;
    }
    std::array<Coincident, 4> here{};
    const auto same = [&](const Event& e) { return e.depth == depth && e.kind == event.kind; };
    for (; i < events_.size() && same(events_[i]); ++i) {
      const DeepSample& sample = samples[events_[i].sample];
      for (int c = 0; c < 4; ++c) {
        if (event.kind == Kind::kOpaqueVolume && sample.alpha[c] < 1) continue;
        here[c].add(sample.alpha[c], sample.color[c]);
      }
    }
    for (int c = 0; c < 4; ++c) here[c].put(channels[c]);
  }
  for (int c = 0; c < 4; ++c) flat.color[c] = channels[c].color;
  return flat;
}

}  // namespace limpid
