#include "show/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "show/letters.h"

namespace limpid {
namespace {

constexpr std::uint8_t kGround = 28;
constexpr std::array<std::uint8_t, 3> kInk = {216, 216, 216};
constexpr int kGap = 8;          ///< pixels around each cell
constexpr int kWideCell = 320;   ///< pixels; letters are twice as large from this width on
constexpr double kAspect = 1.5;  ///< of the whole sheet

void put_picture(Shown& sheet, int x0, int y0, const Shown& picture) {
  const std::size_t row = 4 * static_cast<std::size_t>(picture.size.width);
  for (int y = 0; y < picture.size.height; ++y) {
    const auto to = 4 * (static_cast<std::size_t>(y0 + y) * sheet.size.width + x0);
    std::copy_n(picture.rgba.data() + static_cast<std::size_t>(y) * row, row,
                sheet.rgba.data() + to);
  }
}

}  // namespace

Shown contact_sheet(const std::vector<SheetCell>& cells) {
  Size size;
  std::size_t longest = 0;
  for (const SheetCell& cell : cells) {
    size = cell.shown.size;
    longest = std::max(longest, cell.label.size());
  }
  const auto label_width = [&](int scale) {
    return static_cast<int>(longest) * kLetterWidth * scale;
  };
  const int scale = size.width >= std::max(kWideCell, label_width(2)) ? 2 : 1;
  const int across = std::max(size.width, label_width(scale)) + kGap;
  const int down = size.height + kLetterHeight * scale + 2 * kGap;
  const auto count = static_cast<int>(cells.size());
  const int columns =
      std::clamp(static_cast<int>(std::lround(std::sqrt(count * kAspect * down / across))), 1,
                 std::max(count, 1));
  const int rows = (count + columns - 1) / columns;

  Shown sheet{{columns * across + kGap, rows * down + kGap}, {}, {}};
  sheet.rgba.assign(std::size_t{4} * sheet.size.width * sheet.size.height, kGround);
  for (std::size_t i = 3; i < sheet.rgba.size(); i += 4) sheet.rgba[i] = 255;
  for (int i = 0; i < count; ++i) {
    const SheetCell& cell = cells[static_cast<std::size_t>(i)];
    const int x = kGap + i % columns * across, y = kGap + i / columns * down;
    put_picture(sheet, x, y, cell.shown);
    put_text(sheet, x, y + size.height + kGap / 2, scale, cell.label, kInk);
  }
  return sheet;
}

}  // namespace limpid
