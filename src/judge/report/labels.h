#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace limpid {

/// A rectangle on the drawing, y running down.
struct Box {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool meets(const Box& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
  bool contains(const Box& b) const { return x0 <= b.x0 && y0 <= b.y0 && b.x1 <= x1 && b.y1 <= y1; }
};

/// A straight line on the drawing.
struct Segment {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// How wide a text is at most, in the widest of the usual sans-serif faces.
double text_width(std::string_view text, double font_size);

/// A marker at (x, y) that wants a text of that size beside it; none when it is 0 wide.
struct LabelWish {
  double x = 0, y = 0, width = 0, height = 0;
};

/// Where the text of each marker goes: as near to it as can be, and neither over another text nor
/// over a marker, a leading line or the frame's edge; over one of `lines` only where there is no
/// place nearby without. The first wishes are served first. Nothing where no place is left.
struct LabelPlace {
  Box box;
  bool led = false;               ///< so far off that a line must lead there
  double lead_x = 0, lead_y = 0;  ///< the line's end
};
std::vector<std::optional<LabelPlace>> place_labels(std::span<const LabelWish> wishes,
                                                    const Box& frame,
                                                    std::span<const Segment> lines = {});

}  // namespace limpid
