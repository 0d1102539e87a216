// --exposure, --display and --ocio: the view transform of --preview, --contact-sheet and --show.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "limpid/files/picture/image_file.h"
#include "limpid/files/picture/preview.h"

#include "files/picture/tiny_ocio.h"
#include "paths.h"
#include "show/decoded.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

class DisplayTest : public ToolTest {
 protected:
  DisplayTest() { write_tiny_ocio(folder_ / "tiny.ocio"); }

  Decoded decoded(const std::string& file) const { return decoded_file(folder_ / file); }
  Bytes bytes_of(const std::string& file) const { return decoded(file).rgb; }
  Bytes preview(const Words& more = {}) const {
    Words words = {"--preview", "wet.png"};
    words.insert(words.end(), more.begin(), more.end());
    composed("wet.exr", words);
    return bytes_of("wet.png");
  }
  /// Runs the tool with the environment variable OCIO.
  Ran with_ocio(const std::string& ocio, const Words& more) const {
    Words words = {"/usr/bin/env", "OCIO=" + ocio, LIMPID_TOOL, "composite", "plate.exr", "--scene",
                   "scene.toml",   "--look",       "look.toml", "-o",        "env.exr"};
    words.insert(words.end(), more.begin(), more.end());
    return run(folder_, words);
  }
};

double light(std::uint8_t byte) { return linear_from_srgb(static_cast<float>(byte) / 255); }

TEST_F(DisplayTest, ExposureBrightensWhateverIsShown) {
  const Bytes usual = preview(), brighter = preview({"--exposure", "1"});
  EXPECT_EQ(preview({"--exposure", "0"}), usual);
  for (std::size_t i = 0; i < usual.size(); ++i) {
    const auto twice = static_cast<float>(std::min(1.0, 2 * light(usual[i])));
    ASSERT_NEAR(brighter[i], 255 * srgb_from_linear(twice), 4);
  }
  const Ran ran = composite(
      "wet.exr", {"--exposure", "1", "--show=kitty", "-q", "--contact-sheet", "sheet.png"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(decoded_kitty(ran.out).rgb, brighter);
  const Decoded sheet = decoded("sheet.png");
  for (int y = 0; y < 36; ++y) {
    const auto in_sheet = sheet.rgb.begin() + 3 * (std::ptrdiff_t(8 + y) * sheet.size.width + 8);
    ASSERT_TRUE(std::equal(in_sheet, in_sheet + 3 * 64, brighter.begin() + 3 * 64 * y)) << y;
  }
}

TEST_F(DisplayTest, TruthIsShownSoToo) {
  const std::string pool = LIMPID_DATA "/scenes/pool.toml";
  const auto traced = [&](const Words& more) {
    Words words = {"truth", pool,    "--size", "16x9",      "--paths", "1",
                   "-o",    "t.exr", "-q",     "--preview", "t.png"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return bytes_of("t.png");
  };
  const Bytes usual = traced({}), darker = traced({"--exposure", "-1"});
  for (std::size_t i = 0; i < usual.size(); ++i) {
    if (usual[i] == 255) continue;
    ASSERT_NEAR(darker[i], 255 * srgb_from_linear(static_cast<float>(light(usual[i]) / 2)), 4);
  }
}

TEST_F(DisplayTest, AConfigOfOpenColorIoShowsIt) {
  const Bytes srgb = preview();
  const Bytes half = preview({"--ocio", "tiny.ocio"});
  const Bytes swapped = preview({"--ocio", "tiny.ocio", "--display", "swapped"});
  EXPECT_EQ(preview({"--ocio", "tiny.ocio", "--display", "screen/half"}), half);
  EXPECT_EQ(preview({"--ocio", "tiny.ocio", "--display", "wall/half"}), half);
  for (std::size_t i = 0; i < srgb.size(); ++i) {
    if (srgb[i] == 255) continue;  // clamped
    ASSERT_NEAR(half[i], 255 * light(srgb[i]) / 2, 2);
    ASSERT_NEAR(swapped[i / 3 * 3 + 2 - i % 3], 255 * light(srgb[i]), 3);
  }
  // The provenance of the preview names the display.
  preview({"--ocio", "tiny.ocio", "--display", "swapped", "--exposure", "1"});
  const std::string told = limpid({"inspect", "wet.exr"}).out;
  for (const char* line : {"exposure = 1.0\n", "ocio = \"", "view = \"screen/swapped\"\n"}) {
    EXPECT_THAT(told, HasSubstr(line));
  }
}

TEST_F(DisplayTest, TheEnvironmentsConfigIsTheUsualOne) {
  const Bytes srgb = preview(), half = preview({"--ocio", "tiny.ocio"});
  const std::string config = (folder_ / "tiny.ocio").string();
  ASSERT_EQ(with_ocio(config, {"--preview", "env.png"}).code, 0);
  EXPECT_EQ(bytes_of("env.png"), half);
  ASSERT_EQ(with_ocio(config, {"--preview", "env.png", "--display", "sRGB"}).code, 0);
  EXPECT_EQ(bytes_of("env.png"), srgb);
  ASSERT_EQ(with_ocio("", {"--preview", "env.png"}).code, 0);
  EXPECT_EQ(bytes_of("env.png"), srgb);
  // Without a preview no config is read.
  composed("wet.exr");
  const Ran ran = with_ocio("absent.ocio", {});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(text_of("env.exr"), text_of("wet.exr"));
}

TEST_F(DisplayTest, OtherPrimariesAreShownInThoseOfTheScreen) {
  const auto shown = [&](const char* space) {
    const Ran ran =
        limpid({"composite", "plate.exr", "--scene", "scene.toml", "--look", "look.toml", "-o",
                "wet.exr", "-q", "--colorspace", space, "--preview", "wet.png"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return bytes_of("wet.png");
  };
  const Bytes rec709 = shown("Rec.709"), acescg = shown("ACEScg");
  const auto most = [](const Bytes& bytes, std::size_t from) {
    double saturation = 0;
    for (std::size_t i = from; i + 2 < bytes.size(); i += 3) {
      const auto [low, high] = std::minmax({bytes[i], bytes[i + 1], bytes[i + 2]});
      saturation = std::max<double>(saturation, high - low);
    }
    return saturation;
  };
  EXPECT_GT(most(acescg, 0), most(rec709, 0)) << "the same numbers are more colorful in ACEScg";
}

TEST_F(DisplayTest, Refuses) {
  const std::string beside = "expected --preview, --contact-sheet or --show beside it";
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--exposure", "1"},
                      {"--exposure: " + beside}, 2);
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--ocio", "tiny.ocio"},
                      {"--ocio tiny.ocio: " + beside}, 2);
  const auto refused = [&](const Words& more, const Words& parts, int code) {
    Words words = {"plate.exr", "--scene", "scene.toml", "--preview", "wet.png"};
    words.insert(words.end(), more.begin(), more.end());
    expect_no_composite(words, parts, code);
  };
  refused({"--exposure", "101"}, {"--exposure", "101", "-100 ... 100"}, 2);
  refused({"--display", "screen/half"},
          {"--display screen/half: expected sRGB, or an OpenColorIO config by --ocio or $OCIO"}, 2);
  refused({"--ocio", "tiny.ocio", "--display", "sRGB"}, {"--ocio tiny.ocio: expected a view"}, 2);
  refused({"--ocio", "tiny.ocio", "--display", "wal/half"},
          {"view 'wal/half' of tiny.ocio: expected sRGB or one of screen/half, screen/swapped, "
           "wall/half; did you mean 'wall/half'?"},
          2);
  refused({"--ocio", "absent.ocio"}, {"absent.ocio", "--display sRGB needs no"}, 1);
  refused({"--ocio", "scene.toml"}, {"scene.toml", "--display sRGB needs no"}, 1);
}

TEST_F(DisplayTest, ResumeMakesAnewWhatWouldBeShownOtherwise) {
  std::filesystem::copy(folder_ / "plate.exr", folder_ / "plate.0001.exr");
  const auto resumed = [&](const Words& more) {
    Words words = {"composite", "plate.#.exr", "--scene",   "scene.toml", "--look",
                   "look.toml", "-o",          "wet.#.exr", "--preview",  "wet.#.png",
                   "--frames",  "1",           "--resume"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out + ran.err;
  };
  resumed({});
  EXPECT_THAT(resumed({}), HasSubstr("1 of 1 frames are kept"));
  EXPECT_THAT(resumed({"--exposure", "1"}),
              HasSubstr("wet.0001.exr was made differently (options)"));
  EXPECT_THAT(resumed({"--exposure", "1"}), HasSubstr("1 of 1 frames are kept"));
}

}  // namespace
}  // namespace limpid::test
