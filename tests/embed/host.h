#pragma once
#include <cstring>
#include <initializer_list>
#include <vector>

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>

#include "limpid/compositor.h"

#include "support.h"

/// A host program's buffers, made from the planes of a test's frame.

namespace limpid::test {

/// Memory for some channels of one size, in a layout that hosts use.
class HostMemory {
 public:
  struct Layout {
    Sample sample = Sample::kFloat;
    bool interleaved = false;
    bool bottom_up = false;  ///< the lowest row first
    int slack = 0;           ///< bytes after each pixel, so that samples are not aligned
  };

  HostMemory(int channels, Rect window, const Layout& layout) : layout_(layout), window_(window) {
    const std::ptrdiff_t sample = bytes_of(layout.sample);
    pixel_ = (layout.interleaved ? sample * channels : sample) + layout.slack;
    row_ = pixel_ * window.width() + 12;
    plane_ = layout.interleaved ? 0 : row_ * window.height();
    bytes_.resize(static_cast<std::size_t>(row_ * window.height() * (plane_ ? channels : 1) + 64));
  }

  HostOutput channel(int i) {
    std::byte* first = bytes_.data() + 4 + (plane_ ? plane_ : bytes_of(layout_.sample)) * i;
    if (layout_.bottom_up) first += row_ * (window_.height() - 1);
    return {first, layout_.sample, pixel_, layout_.bottom_up ? -row_ : row_, window_};
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  Layout layout_;
  Rect window_;
  std::ptrdiff_t pixel_, row_, plane_;
  std::vector<std::byte> bytes_;
};

inline std::byte* at(const HostOutput& view, int x, int y) {
  return static_cast<std::byte*>(view.data) + (x - view.window.x0) * view.x_stride +
         (y - view.window.y0) * view.y_stride;
}

inline float get(const HostOutput& view, int x, int y) {
  if (view.sample == Sample::kHalf) {
    std::uint16_t bits;
    std::memcpy(&bits, at(view, x, y), sizeof bits);
    return imath_half_to_float(bits);
  }
  float value;
  std::memcpy(&value, at(view, x, y), sizeof value);
  return value;
}

inline void put(const HostOutput& view, int x, int y, float value) {
  const std::uint16_t bits = imath_float_to_half(value);
  if (view.sample == Sample::kHalf) {
    std::memcpy(at(view, x, y), &bits, sizeof bits);
  } else {
    std::memcpy(at(view, x, y), &value, sizeof value);
  }
}

inline void fill(const HostOutput& to, const View<const float>& from) {
  for (int y = from.window.y0; y < from.window.y1; ++y) {
    for (int x = from.window.x0; x < from.window.x1; ++x) put(to, x, y, from.at(x, y));
  }
}

/// The frame as a host passes it: views of its planes.
inline HostFrame host_frame(const Frame& frame, const Scene& scene) {
  HostFrame host;
  host.display = frame.display;
  host.scene = scene;
  for (int i = 0; i < kPlaneCount; ++i) {
    if (frame.planes[i]) host.planes[i] = host_view(frame.planes[i]);
  }
  return host;
}

/// The color of the picture, with `aovs`.
inline HostPicture host_picture(const Target& target, std::initializer_list<Aov> aovs = {}) {
  HostPicture host;
  for (std::size_t c = 0; c < 3; ++c) host.color[c] = host_view(target.color[c]);
  host.alpha = host_view(target.alpha);
  for (const Aov aov : aovs) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (target.of(aov)[c]) host.of(aov)[c] = host_view(target.of(aov)[c]);
    }
  }
  return host;
}

/// Color and alpha of run_fused for the frame, every value.
inline std::vector<float> judged(const Look& look, const Frame& frame, const Scene& scene) {
  const Plan plan = make_plan(look, inputs_of(frame, scene));
  Picture picture(frame.work());
  picture.target.aovs = {};
  run_fused(plan, frame, scene, picture.target, *make_executor(1));
  return picture.values();
}

}  // namespace limpid::test
