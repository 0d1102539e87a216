#include "files/exr/deep_flatten.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace limpid {
namespace {

/// Optical depth of an alpha below 1, and the light of its color without absorption.
struct Medium {
  double optical_depth, light;
};

Medium medium_of(double alpha, double color) {
  if (alpha <= 0) return {0, color};
  const double optical_depth = -std::log1p(-alpha);
  return {optical_depth, color * (optical_depth / alpha)};
}

/// One channel as composited so far.
struct Channel {
  double color = 0, through = 1;

  void over(const Medium& medium) {
    const double u = medium.optical_depth;
    color += through * (u > 0 ? medium.light * (-std::expm1(-u) / u) : medium.light);
    through *= std::exp(-u);
  }
  void over(double alpha, double premultiplied) {
    color += through * premultiplied;
    through *= 1 - alpha;
  }
};

/// The sums over the volumes at the current depth, per unit of depth.
struct Inside {
  int volumes = 0;
  std::array<Medium, 4> density{};

  void add(const DeepSample& sample, int sign) {
    volumes += sign;
    if (volumes == 0) {
      density = {};  // removes rounding errors
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
  void put(std::array<Channel, 4>& channels, double length) const {
    if (length <= 0) return;
    for (int c = 0; c < 4; ++c) {
      channels[c].over(
          {std::max(0.0, density[c].optical_depth * length), density[c].light * length});
    }
  }
};

/// Samples at the same depth, of one channel: opaque samples hide the others and share the pixel. A
/// single sample is composited unchanged.
struct Coincident {
  int count = 0, opaque = 0;
  double alpha = 0, color = 0;  ///< of the first sample
  Medium sum{};
  double walls = 0;

  void add(double next_alpha, double next_color) {
    if (++count == 1) {
      alpha = next_alpha;
      color = next_color;
      return;
    }
    if (count == 2) merge(alpha, color);
    merge(next_alpha, next_color);
  }
  void put(Channel& channel) const {
    if (count < 2) {
      channel.over(alpha, color);
    } else if (opaque > 0) {
      channel.over(1, walls / opaque);
    } else {
      channel.over(sum);
    }
  }

 private:
  void merge(double a, double c) {
    if (a >= 1) {
      ++opaque;
      walls += c;
    } else {
      const Medium medium = medium_of(a, c);
      sum.optical_depth += medium.optical_depth;
      sum.light += medium.light;
    }
  }
};

bool any(const std::array<double, 4>& alpha, bool (*holds)(double)) {
  return std::any_of(alpha.begin(), alpha.end(), holds);
}

}  // namespace

double DeepFlattener::collect(std::span<const DeepSample> samples, double from, double to) {
  double nearest = std::numeric_limits<double>::infinity();
  events_.clear();
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const DeepSample& sample = samples[i];
    const bool volume = sample.back > sample.front;
    if (volume ? sample.back <= from : sample.front <= from) continue;
    if (volume ? sample.front >= to : sample.front > to) continue;
    const double front = volume ? std::max(sample.front, from) : sample.front;
    if (any(sample.alpha, [](double a) { return a > 0; })) nearest = std::min(nearest, front);
    if (!volume) {
      events_.push_back({front, Kind::kPoint, i});
      continue;
    }
    if (any(sample.alpha, [](double a) { return a >= 1; })) {
      events_.push_back({front, Kind::kOpaqueVolume, i});
    }
    if (any(sample.alpha, [](double a) { return a < 1; })) {
      events_.push_back({front, Kind::kVolumeBegins, i});
      events_.push_back({std::min(sample.back, to), Kind::kVolumeEnds, i});
    }
  }
  std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
    return std::tie(a.depth, a.kind, a.sample) < std::tie(b.depth, b.kind, b.sample);
  });
  return nearest;
}

FlatPixel DeepFlattener::flatten(std::span<const DeepSample> samples, double from, double to) {
  FlatPixel flat;
  flat.depth = collect(samples, from, to);
  std::array<Channel, 4> channels;
  Inside inside;
  double depth = 0;
  for (std::size_t i = 0, past = 0; i < events_.size(); i = past) {
    const Kind kind = events_[i].kind;
    if (inside.volumes > 0) inside.put(channels, events_[i].depth - depth);
    depth = events_[i].depth;
    past = i + 1;
    if (kind == Kind::kVolumeBegins || kind == Kind::kVolumeEnds) {
      inside.add(samples[events_[i].sample], kind == Kind::kVolumeBegins ? 1 : -1);
      continue;
    }
    std::array<Coincident, 4> here{};
    for (past = i;
         past < events_.size() && events_[past].depth == depth && events_[past].kind == kind;
         ++past) {
      const DeepSample& sample = samples[events_[past].sample];
      for (int c = 0; c < 4; ++c) {
        const bool concerned = kind == Kind::kPoint || sample.alpha[c] >= 1;
        if (concerned) here[c].add(sample.alpha[c], sample.color[c]);
      }
    }
    for (int c = 0; c < 4; ++c) here[c].put(channels[c]);
  }
  for (int c = 0; c < 4; ++c) flat.color[c] = channels[c].color;
  return flat;
}

}  // namespace limpid
