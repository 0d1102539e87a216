// --contact-sheet and --show: what they write beside the preview.
#include <gmock/gmock.h>

#include "paths.h"
#include "show/decoded.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::HasSubstr;

class ShowTest : public ToolTest {
 protected:
  Decoded bytes_of(const std::string& file) const { return decoded_file(folder_ / file); }

  void refused(const Words& more, const Words& parts, int code = 1) const {
    Words words = {"plate.exr", "--scene", "scene.toml"};
    words.insert(words.end(), more.begin(), more.end());
    expect_no_composite(words, parts, code);
  }

  /// Runs the tool in its own terminal.
  Ran in_terminal(const Words& environment, const Words& more) const {
    Words words = {PYTHON3,
                   "-c",
                   "import pty, sys; sys.exit(pty.spawn(sys.argv[1:]) >> 8)",
                   "env",
                   "-u",
                   "TMUX",
                   "-u",
                   "STY",
                   "-u",
                   "KITTY_WINDOW_ID",
                   "-u",
                   "TERM_PROGRAM",
                   "-u",
                   "LC_TERMINAL",
                   "-u",
                   "KONSOLE_VERSION"};
    words.insert(words.end(), environment.begin(), environment.end());
    words.insert(words.end(), {LIMPID_TOOL, "composite", "plate.exr", "--scene", "scene.toml",
                               "--look", "look.toml", "-o", "wet.exr", "-q"});
    words.insert(words.end(), more.begin(), more.end());
    return run(folder_, words);
  }
};

TEST_F(ShowTest, WritesThePreviewToTheTerminalThatIsNamed) {
  for (const char* protocol : {"kitty", "iterm", "sixel"}) {
    const Ran ran =
        composite("wet.exr", {"--preview", "wet.png", "-q", std::string("--show=") + protocol});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Decoded preview = bytes_of("wet.png");
    const std::string name = protocol;
    const Decoded shown = name == "kitty"   ? decoded_kitty(ran.out)
                          : name == "iterm" ? decoded_iterm(ran.out)
                                            : decoded_sixel(ran.out);
    EXPECT_EQ(shown.size, preview.size) << protocol;
    const Apart by = apart(shown.rgb, preview.rgb);
    EXPECT_LE(by.mean, name == "sixel" ? 5 : 0) << protocol;
    EXPECT_LE(by.most, name == "sixel" ? 40 : 0) << protocol;
  }
}

TEST_F(ShowTest, FindsTheTerminalByItself) {
  const Ran ran = in_terminal({"TERM=xterm-kitty"}, {"--show", "--preview", "wet.png"});
  ASSERT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_EQ(decoded_kitty(ran.out).rgb, bytes_of("wet.png").rgb);
  const Ran other = in_terminal({"TERM=linux"}, {"--show"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.out, HasSubstr("--show: the terminal (TERM=linux) is not known to show "
                                   "pictures: expected kitty, iTerm2, one with sixels, or "
                                   "--show=kitty"));
}

TEST_F(ShowTest, WaterIsShownToo) {
  const std::string pool = LIMPID_DATA "/scenes/pool.toml";
  const Ran ran = limpid({"water", pool, "--size", "64x36", "--samples", "2", "-o", "pool.exr",
                          "--preview", "pool.png", "--show=iterm", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(decoded_iterm(ran.out).rgb, bytes_of("pool.png").rgb);
}

TEST_F(ShowTest, RefusesBeforeAnythingIsMade) {
  refused({"--show"}, {"--show: standard output is not a terminal", "--show=sixel"}, 2);
  refused({"--show=sixels"}, {"--show=sixels", "did you mean 'sixel'?"}, 2);
  refused({"--show=kitty", "--frames", "1-2"}, {"--show and --frames"}, 2);
  refused({"--show=kitty", "-n"}, {"--show and -n"}, 2);
}

TEST_F(ShowTest, TheContactSheetHasThePictureAndEveryAov) {
  const Ran ran = composite("wet.exr", {"--preview", "wet.png", "--contact-sheet", "sheet.png"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("\nsheet.png\n"));
  const Decoded sheet = bytes_of("sheet.png"), preview = bytes_of("wet.png");
  // 18 cells of a picture 64 pixels wide, each with a label.
  EXPECT_GT(sheet.size.width, 4 * 64);
  EXPECT_GT(sheet.size.height, 3 * 36);
  const auto row = [](const Decoded& picture, int x, int y, int width) {
    const auto at = picture.rgb.begin() + 3 * (y * picture.size.width + x);
    return std::vector<std::uint8_t>(at, at + 3 * width);
  };
  // The first cell is the preview, byte for byte.
  for (int y = 0; y < 36; ++y) ASSERT_EQ(row(sheet, 8, 8 + y, 64), row(preview, 0, y, 64)) << y;

  // The AOVs have the written values: transmittance, in the sixth cell, is a share and stays
  // unscaled.
  composed("aov.exr", {"--aov", "transmittance", "--float"});
  oiiotool({"aov.exr", "--ch", "transmittance.R,transmittance.G,transmittance.B", "--chnames",
            "R,G,B", "-d", "uint8", "-o", "share.png"});
  const Decoded share = bytes_of("share.png");
  int found = 0;
  for (int y = 0; y + 36 <= sheet.size.height; ++y) {
    for (int x = 0; x + 64 <= sheet.size.width; ++x) {
      bool same = true;
      for (int j = 0; same && j < 36; j += 5) {
        const std::vector<std::uint8_t> a = row(sheet, x, y + j, 64), b = row(share, 0, j, 64);
        same = apart(a, b).most <= 1;
      }
      found += same ? 1 : 0;
    }
  }
  EXPECT_EQ(found, 1);
  // The picture is the same as without a sheet.
  composed("alone.exr", {});
  EXPECT_TRUE(same("wet.exr", "alone.exr"));
}

TEST_F(ShowTest, ALargePictureIsSmallOnTheSheet) {
  const std::string pool = LIMPID_DATA "/scenes/pool.toml";
  const Ran ran = limpid({"water", pool, "--size", "1000x500", "-o", "pool.exr", "--contact-sheet",
                          "sheet.png", "-q"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Size size = bytes_of("sheet.png").size;
  // The sheet is a third as wide: 333 pixels, in 4 or 5 columns.
  EXPECT_GE(size.width, 4 * 333);
  EXPECT_LE(size.width, 5 * 333 + 100);
}

TEST_F(ShowTest, TheContactSheetGoesWithItsFrame) {
  const Words words = {"composite",       "plate.exr",   "--scene",  "scene.toml",
                       "--look",          "look.toml",   "-o",       "wet.#.exr",
                       "--contact-sheet", "sheet.#.png", "--frames", "1-2"};
  ASSERT_EQ(limpid(words).code, 0);
  EXPECT_THAT(files(), ::testing::IsSupersetOf({"sheet.0001.png", "sheet.0002.png"}));
  Words again = words;
  again.emplace_back("--resume");
  const Ran kept = limpid(again);
  EXPECT_THAT(kept.err, HasSubstr("2 of 2 frames are kept"));
  std::filesystem::remove(folder_ / "sheet.0002.png");
  EXPECT_THAT(limpid(again).err, HasSubstr("1 of 2 frames are kept"));
  EXPECT_THAT(files(), ::testing::Contains("sheet.0002.png"));
}

TEST_F(ShowTest, RefusesASheetThatCannotBeWritten) {
  refused({"--contact-sheet", "absent/sheet.png"}, {"absent"});
  refused({"--contact-sheet", "sheet.gif"}, {"sheet.gif", ".png"});
  refused({"--contact-sheet", "plate.exr"}, {"plate.exr", "input"}, 2);
  expect_refused(composite("wet.#.exr", {"--frames", "1-2", "--contact-sheet", "sheet.png"}),
                 {"sheet.png", "%04d"}, 2);
  refused({"--frames", "1", "--resume", "--contact-sheet", "sheet.tif"},
          {"--resume and --contact-sheet sheet.tif", ".png"}, 2);
}

}  // namespace
}  // namespace limpid::test
