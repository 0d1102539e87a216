#include "show/terminal.h"

#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "show/decoded.h"
#include "show/palette.h"

namespace limpid {
namespace {

using ::testing::HasSubstr;

struct Bytes {
  Size size;
  std::vector<std::uint8_t> rgb;
};

/// More colors than a palette has, smooth as a picture is; its height is no whole number of bands.
Bytes gradient(Size size) {
  Bytes bytes{size, {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      bytes.rgb.push_back(static_cast<std::uint8_t>(255 * x / size.width));
      bytes.rgb.push_back(static_cast<std::uint8_t>(255 * y / size.height));
      bytes.rgb.push_back(static_cast<std::uint8_t>(128 + 100 * std::sin(0.07 * (x + y))));
    }
  }
  return bytes;
}

TEST(Terminal, HasPicturesOfKittyAndItermToTheByte) {
  for (const Size size : {Size{1, 1}, Size{37, 20}, Size{160, 91}}) {
    const Bytes from = gradient(size);
    const test::Decoded kitty =
        test::decoded_kitty(terminal_text(size, from.rgb, TerminalPictures::kKitty));
    EXPECT_EQ(kitty.size, size);
    EXPECT_EQ(kitty.rgb, from.rgb);
    const test::Decoded iterm =
        test::decoded_iterm(terminal_text(size, from.rgb, TerminalPictures::kIterm));
    EXPECT_EQ(iterm.size, size);
    EXPECT_EQ(iterm.rgb, from.rgb);
  }
}

TEST(Terminal, SendsAPictureToKittyInParts) {
  Bytes from = gradient({160, 91});
  std::uint32_t noise = 1;
  for (std::uint8_t& byte : from.rgb)
    byte = static_cast<std::uint8_t>((noise = noise * 1664525 + 1013904223) >> 24);
  const std::string text = terminal_text(from.size, from.rgb, TerminalPictures::kKitty);
  EXPECT_THAT(text, HasSubstr("m=1;"));
  EXPECT_EQ(test::decoded_kitty(text).rgb, from.rgb);
}

TEST(Terminal, HasSixelsNearThePicture) {
  for (const Size size : {Size{1, 1}, Size{5, 6}, Size{37, 20}, Size{160, 91}}) {
    const Bytes from = gradient(size);
    const test::Decoded to =
        test::decoded_sixel(terminal_text(size, from.rgb, TerminalPictures::kSixel));
    EXPECT_EQ(to.size, size);
    const test::Apart by = test::apart(to.rgb, from.rgb);
    EXPECT_LE(by.mean, 7);
    EXPECT_LE(by.most, 64);
  }
}

TEST(Terminal, HasSixelsOfFewColorsExactButForTheirPercent) {
  const std::vector<std::uint8_t> rgb = {0, 0, 0, 255, 255, 255, 200, 10, 90, 0, 0, 0};
  const test::Decoded to =
      test::decoded_sixel(terminal_text({4, 1}, rgb, TerminalPictures::kSixel));
  EXPECT_LE(test::apart(to.rgb, rgb).most, 1);
}

TEST(Palette, PartsTheColorsThatThereAre) {
  const Bytes from = gradient({64, 64});
  for (const int most : {1, 2, 7, 256}) {
    const Paletted to = paletted(from.rgb, most);
    EXPECT_EQ(to.colors.size(), most);
    EXPECT_EQ(to.pixels.size(), 64 * 64);
    for (const std::uint8_t index : to.pixels) ASSERT_LT(index, most);
  }
  EXPECT_TRUE(paletted({}, 256).colors.empty());
}

using Environment = std::map<std::string, std::string>;

std::optional<TerminalPictures> told_by(const Environment& environment) {
  return terminal_pictures([&](const char* name) {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  });
}

TEST(Terminal, IsKnownByItsEnvironment) {
  const std::pair<Environment, TerminalPictures> known[] = {
      {{{"TERM", "xterm-kitty"}}, TerminalPictures::kKitty},
      {{{"TERM", "xterm-256color"}, {"KITTY_WINDOW_ID", "1"}}, TerminalPictures::kKitty},
      {{{"TERM", "xterm-ghostty"}}, TerminalPictures::kKitty},
      {{{"TERM_PROGRAM", "ghostty"}}, TerminalPictures::kKitty},
      {{{"TERM_PROGRAM", "iTerm.app"}}, TerminalPictures::kIterm},
      {{{"TERM", "xterm-256color"}, {"LC_TERMINAL", "iTerm2"}}, TerminalPictures::kIterm},
      {{{"TERM_PROGRAM", "WezTerm"}}, TerminalPictures::kIterm},
      {{{"TERM_PROGRAM", "mintty"}}, TerminalPictures::kIterm},
      {{{"TERM", "foot"}}, TerminalPictures::kSixel},
      {{{"TERM", "foot-extra"}}, TerminalPictures::kSixel},
      {{{"TERM", "mlterm"}}, TerminalPictures::kSixel},
      {{{"TERM", "xterm-sixel"}}, TerminalPictures::kSixel},
      {{{"TERM", "xterm-256color"}, {"KONSOLE_VERSION", "221203"}}, TerminalPictures::kSixel},
  };
  for (const auto& [environment, protocol] : known) EXPECT_EQ(told_by(environment), protocol);
}

TEST(Terminal, ThatIsNotKnownHasNoPictures) {
  const Environment none[] = {
      {},
      {{"TERM", "xterm-256color"}},
      {{"TERM", "footage"}},
      {{"TERM", "linux"}},
      {{"TERM", "xterm-256color"}, {"KONSOLE_VERSION", "211200"}},
      // A multiplexer passes no pictures on, in any terminal.
      {{"TERM", "tmux-256color"}, {"KITTY_WINDOW_ID", "1"}},
      {{"TERM", "screen"}, {"LC_TERMINAL", "iTerm2"}},
      {{"TERM", "xterm-kitty"}, {"TMUX", "socket,1,0"}},
      {{"TERM", "foot"}, {"STY", "1.pts-0"}},
  };
  for (const Environment& environment : none) EXPECT_EQ(told_by(environment), std::nullopt);
}

TEST(Terminal, IsNamed) {
  EXPECT_EQ(terminal_pictures_named("kitty"), TerminalPictures::kKitty);
  EXPECT_EQ(terminal_pictures_named("iterm"), TerminalPictures::kIterm);
  EXPECT_EQ(terminal_pictures_named("sixel"), TerminalPictures::kSixel);
  try {
    terminal_pictures_named("sixels");
    ADD_FAILURE() << "an unknown way was taken";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("--show=sixels: expected auto or one of kitty, iterm, sixel"));
    EXPECT_EQ(e.fault(), Fault::kUsage);
  }
}

}  // namespace
}  // namespace limpid
