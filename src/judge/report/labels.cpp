#include "judge/report/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace limpid {
namespace {

constexpr double kMarker = 6;  // half the side of what a marker covers
constexpr double kGap = 2;     // between texts

bool crosses(const Segment& line, const Box& box) {
  // Narrowed to the part of the line within the box (Liang & Barsky 1984).
  double from = 0, to = 1;
  const auto cut = [&](double start, double step, double low, double high) {
    if (step == 0) return start > low && start < high;
    const double a = (low - start) / step, b = (high - start) / step;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
    return from < to;
  };
  return cut(line.x0, line.x1 - line.x0, box.x0, box.x1) &&
         cut(line.y0, line.y1 - line.y0, box.y0, box.y1);
}

Box around(double x, double y, double half) { return {x - half, y - half, x + half, y + half}; }

Box grown(const Box& b, double by) { return {b.x0 - by, b.y0 - by, b.x1 + by, b.y1 + by}; }

// A text whose nearest point lies at that distance and angle from the marker.
Box box_at(const LabelWish& wish, double distance, double angle) {
  const double dx = std::cos(angle), dy = std::sin(angle);
  const double x = wish.x + distance * dx + (dx - 1) / 2 * wish.width;
  const double y = wish.y + distance * dy + (dy - 1) / 2 * wish.height;
  return {x, y, x + wish.width, y + wish.height};
}

class Placing {
 public:
  Placing(std::span<const LabelWish> wishes, const Box& frame, std::span<const Segment> avoided)
      : wishes_(wishes), frame_(frame), avoided_(avoided) {}

  std::vector<std::optional<LabelPlace>> run() {
    std::vector<std::optional<LabelPlace>> places;
    for (const LabelWish& wish : wishes_) {
      places.push_back(wish.width > 0 ? place(wish) : std::nullopt);
      if (!places.back()) continue;
      texts_.push_back(places.back()->box);
      if (places.back()->led) lines_.push_back(line_of(wish, *places.back()));
    }
    return places;
  }

 private:
  static Segment line_of(const LabelWish& wish, const LabelPlace& place) {
    return {wish.x, wish.y, place.lead_x, place.lead_y};
  }

  std::optional<LabelPlace> place(const LabelWish& wish) const {
    const auto off_lines = [&](const LabelPlace& place) {
      const Box wide = grown(place.box, kGap);
      return std::none_of(avoided_.begin(), avoided_.end(),
                          [&](const Segment& line) { return crosses(line, wide); });
    };
    const auto nearby = nearest(wish, 28, off_lines);
    return nearby ? nearby : nearest(wish, 124, [](const LabelPlace&) { return true; });
  }

  template <class Accept>
  std::optional<LabelPlace> nearest(const LabelWish& wish, double farthest,
                                    const Accept& accept) const {
    // Right, left, above, below, then between them.
    constexpr double kEighth = std::numbers::pi / 4;
    constexpr std::array<double, 16> kAngles = {0,   4,   -2,  2,   -1,  1,    -3,  3,
                                                0.5, -.5, 3.5, 4.5, 1.5, -1.5, 2.5, -2.5};
    for (double distance : {9.0, 14.0, 20.0, 28.0, 38.0, 50.0, 64.0, 80.0, 100.0, 124.0}) {
      if (distance > farthest) break;
      for (double angle : kAngles) {
        LabelPlace place{box_at(wish, distance, angle * kEighth), distance > 14, 0, 0};
        place.lead_x = std::clamp(wish.x, place.box.x0, place.box.x1);
        place.lead_y = std::clamp(wish.y, place.box.y0, place.box.y1);
        if (free(wish, place) && accept(place)) return place;
      }
    }
    return {};
  }

  bool free(const LabelWish& wish, const LabelPlace& place) const {
    if (!frame_.contains(place.box)) return false;
    const Box wide = grown(place.box, kGap);
    const Segment lead = line_of(wish, place);
    const auto meets = [&](const Box& b) { return wide.meets(b); };
    if (std::any_of(texts_.begin(), texts_.end(), meets)) return false;
    for (const LabelWish& other : wishes_) {
      if (place.box.meets(around(other.x, other.y, kMarker))) return false;
      const bool same = other.x == wish.x && other.y == wish.y;
      if (place.led && !same && crosses(lead, around(other.x, other.y, kMarker / 2))) return false;
    }
    const auto crossed = [&](const Segment& l) { return crosses(l, wide); };
    if (std::any_of(lines_.begin(), lines_.end(), crossed)) return false;
    const auto cut = [&](const Box& b) { return crosses(lead, b); };
    return !place.led || std::none_of(texts_.begin(), texts_.end(), cut);
  }

  std::span<const LabelWish> wishes_;
  Box frame_;
  std::span<const Segment> avoided_;
  std::vector<Box> texts_;
  std::vector<Segment> lines_;
};

}  // namespace

double text_width(std::string_view text, double font_size) {
  // Parts of the font size, those of DejaVu Sans rounded up.
  constexpr std::string_view kNarrow = " .,:;'|!()[]/ijlftr-", kWide = "mwMW%@";
  double width = 0;
  for (char c : text) {
    if ((c & 0xc0) == 0x80) continue;  // not the first byte of a letter
    width += kNarrow.find(c) != std::string_view::npos ? 0.42
             : kWide.find(c) != std::string_view::npos ? 1.0
             : c >= 'A' && c <= 'Z'                    ? 0.78
                                                       : 0.65;
  }
  return width * font_size;
}

std::vector<std::optional<LabelPlace>> place_labels(std::span<const LabelWish> wishes,
                                                    const Box& frame,
                                                    std::span<const Segment> lines) {
  return Placing(wishes, frame, lines).run();
}

}  // namespace limpid
