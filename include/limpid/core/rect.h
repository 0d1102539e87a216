#pragma once
#include <algorithm>
#include <cstdint>

namespace limpid {

struct Size {
  int width = 0, height = 0;
  friend bool operator==(const Size&, const Size&) = default;
};

/// Pixels x0 <= x < x1, y0 <= y < y1; y runs down. Empty when x1 <= x0 or y1 <= y0.
struct Rect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return std::max(0, x1 - x0); }
  int height() const { return std::max(0, y1 - y0); }
  Size size() const { return {width(), height()}; }
  std::int64_t area() const { return std::int64_t{width()} * height(); }
  bool empty() const { return area() == 0; }
  bool contains(const Rect& r) const {
    return r.empty() || (x0 <= r.x0 && y0 <= r.y0 && r.x1 <= x1 && r.y1 <= y1);
  }
  friend bool operator==(const Rect&, const Rect&) = default;
};

inline Rect rect_of(Size s) { return {0, 0, s.width, s.height}; }

inline Rect intersection(const Rect& a, const Rect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

}  // namespace limpid
