#include "show/contact_sheet.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "show/letters.h"

namespace limpid {
namespace {

using Color = std::array<std::uint8_t, 3>;

Shown plain(Size size, Color color) {
  Shown shown{size, {}, {}};
  for (int i = 0; i < size.width * size.height; ++i) {
    shown.rgba.insert(shown.rgba.end(), {color[0], color[1], color[2], 255});
  }
  return shown;
}

Color at(const Shown& picture, int x, int y) {
  const auto i = 4 * (static_cast<std::size_t>(y) * picture.size.width + x);
  return {picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]};
}

int count(const Shown& picture, Color color) {
  int number = 0;
  for (int y = 0; y < picture.size.height; ++y) {
    for (int x = 0; x < picture.size.width; ++x) number += at(picture, x, y) == color ? 1 : 0;
  }
  return number;
}

constexpr Color kBlack{0, 0, 0}, kRed{250, 0, 0}, kGreen{0, 250, 0}, kBlue{0, 0, 250};

TEST(Letters, AreAllThereAndEachItsOwn) {
  std::set<std::vector<std::uint8_t>> seen;
  for (int c = ' '; c <= '~'; ++c) {
    Shown picture = plain({kLetterWidth, kLetterHeight}, kBlack);
    put_text(picture, 0, 0, 1, std::string(1, static_cast<char>(c)), kRed);
    EXPECT_EQ(count(picture, kRed) == 0, c == ' ') << static_cast<char>(c);
    for (int y = 0; y < kLetterHeight; ++y) EXPECT_EQ(at(picture, kLetterWidth - 1, y), kBlack);
    for (int x = 0; x < kLetterWidth; ++x) EXPECT_EQ(at(picture, x, kLetterHeight - 1), kBlack);
    EXPECT_TRUE(seen.insert(picture.rgba).second) << static_cast<char>(c);
  }
  Shown picture = plain({kLetterWidth, kLetterHeight}, kBlack);
  put_text(picture, 0, 0, 1, "\xe4", kRed);
  EXPECT_TRUE(seen.insert(picture.rgba).second) << "what is no letter has a box of its own";
}

TEST(Letters, AreAsReadAndScale) {
  Shown small = plain({2 * kLetterWidth, kLetterHeight}, kBlack);
  put_text(small, 0, 0, 1, "L1", kRed);
  const char* const rows[] = {"#.......#...", "#......##...", "#.......#...", "#.......#...",
                              "#.......#...", "#.......#...", "#####..###.."};
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 2 * kLetterWidth; ++x) {
      EXPECT_EQ(at(small, x, y) == kRed, rows[y][x] == '#') << x << ", " << y;
    }
  }
  Shown large = plain({6 * kLetterWidth, 3 * kLetterHeight}, kBlack);
  put_text(large, 0, 0, 3, "L1", kRed);
  for (int y = 0; y < large.size.height; ++y) {
    for (int x = 0; x < large.size.width; ++x) {
      ASSERT_EQ(at(large, x, y), at(small, x / 3, y / 3)) << x << ", " << y;
    }
  }
}

TEST(Letters, StayInThePicture) {
  Shown picture = plain({7, 5}, kBlack);
  for (const int offset : {-40, -3, 3, 40}) put_text(picture, offset, offset, 2, "@@@", kRed);
  EXPECT_EQ(picture.rgba.size(), 4 * 7 * 5);
}

TEST(ContactSheet, HasEachPictureWholeAndItsLabel) {
  const Shown sheet = contact_sheet({{"red", plain({70, 40}, kRed)},
                                     {"green", plain({70, 40}, kGreen)},
                                     {"blue", plain({70, 40}, kBlue)}});
  for (const Color color : {kRed, kGreen, kBlue}) EXPECT_EQ(count(sheet, color), 70 * 40);
  const Color ground = at(sheet, 0, 0);
  EXPECT_GT(sheet.size.width, sheet.size.height);
  // Below each picture stands what put_text() writes.
  for (int y = 0; y < sheet.size.height - 40; ++y) {
    for (int x = 0; x < sheet.size.width - 70; ++x) {
      if (at(sheet, x, y) != kGreen || at(sheet, x - 1, y) == kGreen ||
          at(sheet, x, y - 1) == kGreen) {
        continue;
      }
      Shown label = plain({5 * kLetterWidth, kLetterHeight}, ground);
      put_text(label, 0, 0, 1, "green", {216, 216, 216});
      for (int j = 0; j < kLetterHeight; ++j) {
        for (int i = 0; i < 5 * kLetterWidth; ++i) {
          ASSERT_EQ(at(sheet, x + i, y + 40 + 4 + j), at(label, i, j)) << i << ", " << j;
        }
      }
      return;
    }
  }
  ADD_FAILURE() << "no green picture begins anywhere";
}

TEST(ContactSheet, GivesLongLabelsRoom) {
  const std::string label = "a label that is much wider than its picture";
  const Shown sheet = contact_sheet({{label, plain({4, 4}, kRed)}, {label, plain({4, 4}, kBlue)}});
  EXPECT_GE(sheet.size.width, static_cast<int>(label.size()) * kLetterWidth);
  EXPECT_EQ(count(sheet, kRed), 16);
  EXPECT_EQ(count(sheet, kBlue), 16);
}

}  // namespace
}  // namespace limpid
