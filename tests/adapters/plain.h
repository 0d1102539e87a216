#pragma once
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "limpid/compositor.h"

#include "support.h"

/// A dry frame in plain arrays, and the chain's picture of it, which the adapters' pictures must
/// equal.

namespace limpid::test {

constexpr int kRed = 0, kGreen = 1, kBlue = 2, kAlpha = 3, kDepth = 4;

/// Values that halves hold exactly, different in each channel.
inline float dry(int x, int y, int channel) {
  if (channel == kDepth) return 3.5f + std::floor(384 * noise(x, y, channel)) / 64;
  return std::floor(512 * noise(x, y, channel)) / 512;
}

inline float sample_at(const HostInput& view, int x, int y) {
  float value;
  std::memcpy(&value,
              static_cast<const std::byte*>(view.data) + (y - view.window.y0) * view.y_stride +
                  (x - view.window.x0) * view.x_stride,
              sizeof value);
  return value;
}

inline void composite(const HostFrame& frame, const HostPicture& picture) {
  const std::unique_ptr<Executor> executor = make_executor(1);
  Compositor({}, {}, {.executor = executor.get()}).run(frame, picture);
}

/// Red, green, blue, alpha and depth, each in an array of its own; the arrays may have more or
/// fewer pixels than the picture.
class Plain {
 public:
  explicit Plain(Rect display) : Plain(display, display) {}
  Plain(Rect display, Rect window) : display_(display), window_(window) {
    for (int c = 0; c < 5; ++c) {
      std::vector<float>& values = channels_.emplace_back();
      for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) values.push_back(dry(x, y, c));
      }
    }
  }

  /// The frame of a host that has planes yet to set.
  HostFrame empty_frame() const {
    return {.display = display_, .planes = {}, .scene = simple_scene(display_.size())};
  }

  /// The chain's output, channel after channel: red, green, blue and, if there is an alpha, alpha.
  std::vector<std::vector<float>> wet(bool with_alpha = true) const {
    HostFrame frame = empty_frame();
    const int count = with_alpha ? 4 : 3;
    for (int c = 0; c < count; ++c) frame.planes[c] = view(channels_[c]);
    frame.plane(PlaneId::kDepth) = view(channels_[kDepth]);
    std::vector<std::vector<float>> result(channels_.begin(), channels_.begin() + count);
    HostPicture picture;
    for (int c = 0; c < 3; ++c) picture.color[c] = view(result[c]);
    if (with_alpha) picture.alpha = view(result[kAlpha]);
    composite(frame, picture);
    return result;
  }

  const std::vector<std::vector<float>>& channels() const { return channels_; }

 private:
  HostInput view(const std::vector<float>& values) const {
    return viewed<const void>(values.data());
  }
  HostOutput view(std::vector<float>& values) const { return viewed<void>(values.data()); }

  template <class Void>
  HostView<Void> viewed(Void* values) const {
    HostView<Void> view = planar(values, Sample::kFloat, window_.size());
    view.window = window_;
    return view;
  }

  Rect display_, window_;
  std::vector<std::vector<float>> channels_;
};

}  // namespace limpid::test
