#include <cmath>
#include <deque>
#include <random>

#include <gtest/gtest.h>

#include "embed/host.h"

/// For any layout of a host's planes the picture is that of the same planes side by side; on one
/// compositor, whatever the earlier frames.

namespace limpid {
namespace {

/// Random frames: mt19937 gives the same numbers on every platform.
class Chance {
 public:
  int from(int low, int high) {
    return low + static_cast<int>(generator_() % static_cast<unsigned>(high - low + 1));
  }
  bool one_in(int n) { return from(1, n) == 1; }

 private:
  std::mt19937 generator_{7};
};

bool holds_depth(PlaneId id) {
  return id == PlaneId::kDepth || id == PlaneId::kSurfaceDepth || id == PlaneId::kReflectionDepth ||
         id == PlaneId::kBelowDepth;
}

/// The same frame twice: `laid` out by chance, and `plain`.
class Frames {
 public:
  explicit Frames(Chance& chance) : chance_(chance) {
    const Size size{chance.one_in(5) ? 1 : chance.from(1, 40),
                    chance.one_in(5) ? 1 : chance.from(1, 20)};
    const int x0 = chance.from(-9, 9), y0 = chance.from(-9, 9);
    laid.display = plain.display = {x0, y0, x0 + size.width, y0 + size.height};
    laid.scene = plain.scene = test::simple_scene(size);
    for (int i = 0; i < kPlaneCount; ++i) add(static_cast<PlaneId>(i));
  }

  HostFrame laid, plain;

 private:
  void add(PlaneId id) {
    const bool must = index_of(id) <= index_of(PlaneId::kDepth);
    const bool normal = kSurfaceNormalPlanes.has(id);
    if (normal ? !laid.plane(PlaneId::kSurfaceNormalX) && id != PlaneId::kSurfaceNormalX
               : !must && chance_.one_in(3)) {
      return;
    }
    const Rect& d = laid.display;
    const auto over = [&] { return normal ? 0 : chance_.from(0, 6); };
    const Rect window{d.x0 - over(), d.y0 - over(), d.x1 + over(), d.y1 + over()};
    const HostOutput from = laid_out(window);
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const float value = static_cast<float>(chance_.from(0, 1000)) / 1000;
        const bool nothing = holds_depth(id) && value > 0.9f;
        test::put(from, x, y, nothing ? HUGE_VALF : holds_depth(id) ? 12 * value : value);
      }
    }
    laid.plane(id) = from;
    std::vector<std::byte>& bytes =
        memory_.emplace_back(4 * static_cast<std::size_t>(window.area()));
    HostOutput to = planar<void>(bytes.data(), Sample::kFloat, window.size());
    to.window = window;
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) test::put(to, x, y, test::get(from, x, y));
    }
    plain.plane(id) = to;
  }

  /// Memory for a window: some channels a pixel, slack, rows or columns backwards, samples off any
  /// alignment, or one sample for a whole row or column.
  HostOutput laid_out(const Rect& window) {
    std::ptrdiff_t x_stride = 4 * chance_.from(1, 4) + (chance_.one_in(4) ? 1 : 0);
    std::ptrdiff_t y_stride = x_stride * window.width() + chance_.from(0, 5);
    if (chance_.one_in(8)) x_stride = 0;
    if (chance_.one_in(8)) y_stride = 0;
    std::vector<std::byte>& bytes = memory_.emplace_back(
        static_cast<std::size_t>(x_stride * window.width() + y_stride * window.height() + 16));
    std::byte* first = bytes.data() + chance_.from(0, 3);
    if (chance_.one_in(2)) {
      first += y_stride * (window.height() - 1);
      y_stride = -y_stride;
    }
    if (chance_.one_in(4)) {
      first += x_stride * (window.width() - 1);
      x_stride = -x_stride;
    }
    return {first, Sample::kFloat, x_stride, y_stride, window};
  }

  Chance& chance_;
  std::deque<std::vector<std::byte>> memory_;
};

/// Values in the display window, wherever it begins.
std::vector<float> values(const HostPicture& picture, const Rect& display) {
  std::vector<float> all;
  for (const HostOutput& channel : picture.color) {
    for (int y = display.y0; y < display.y1; ++y) {
      for (int x = display.x0; x < display.x1; ++x) all.push_back(test::get(channel, x, y));
    }
  }
  return all;
}

TEST(CompositorLayouts, GiveTheBitsOfPlainPlanes) {
  Look look;
  look.set("wave_normals", "model", "sines");
  look.set("wave_normals", "waves", Rows{{0.03, 2.1, 0.6, 0}, {0.02, -1.3, 3.2, 1}});
  const auto executor = make_executor(1);
  Compositor careful({}, look, {.executor = executor.get()});
  Compositor trusted({.trusted = true}, look, {.executor = executor.get()});
  Chance chance;
  int in_place = 0;
  for (int i = 0; i < 200; ++i) {
    Frames frames(chance);
    const Rect display = frames.laid.display;
    test::Picture plain(display), laid(display);
    HostPicture expected = test::host_picture(plain.target), got = test::host_picture(laid.target);
    expected.alpha = got.alpha = {};
    // The picture lies over its own colors, green over red: all layouts but those that repeat a
    // sample.
    bool places = true;
    for (int c = 0; c < 3; ++c) {
      places &= frames.laid.planes[c].x_stride != 0 && frames.laid.planes[c].y_stride != 0;
    }
    if (places && chance.one_in(3)) {
      ++in_place;
      for (int c = 0; c < 3; ++c) {
        const HostInput& over = frames.laid.planes[(c + 1) % 3];
        got.color[static_cast<std::size_t>(c)] = {const_cast<void*>(over.data), over.sample,
                                                  over.x_stride, over.y_stride, over.window};
      }
    }
    Compositor& compositor = i % 2 == 0 ? careful : trusted;
    compositor.run(frames.plain, expected);
    compositor.run(frames.laid, got);
    const std::vector<float> a = values(expected, display), b = values(got, display);
    ASSERT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0)
        << i << ": " << display.width() << "x" << display.height();
  }
  EXPECT_GT(in_place, 20);
}

}  // namespace
}  // namespace limpid
