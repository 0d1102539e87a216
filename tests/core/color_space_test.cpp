#include "limpid/core/color_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/core/scene.h"

/// Primaries of color spaces: matrices against published matrices, names, refusals.

namespace limpid {
namespace {

using testing::HasSubstr;

Primaries space(const char* name) { return find_color_space(name).value(); }

/// Matrices by rows, as in publications.
using Rows = double[3][3];
void expect_near(const glm::dmat3& m, const Rows& rows, double tolerance) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(m[c][r], rows[r][c], tolerance) << r << ", " << c;
  }
}

TEST(ColorSpace, ToXyzAsPublished) {
  // ITU-R BT.709-6 with CIE's D65, as IEC 61966-2-1 rounds it.
  expect_near(xyz_from(kRec709),
              {{.4124, .3576, .1805}, {.2126, .7152, .0722}, {.0193, .1192, .9505}}, 6e-5);
  // SMPTE ST 2065-1.
  expect_near(xyz_from(space("ACES2065-1")),
              {{.9525523959, 0, .0000936786},
               {.3439664498, .7281660966, -.0721325464},
               {0, 0, 1.0088251844}},
              1e-10);
  // Academy S-2014-004.
  expect_near(xyz_from(space("ACEScg")),
              {{.6624541811, .1340042065, .1561876870},
               {.2722287168, .6740817658, .0536895174},
               {-.0055746495, .0040607335, 1.0103391003}},
              1e-10);
}

TEST(ColorSpace, FromOneToAnotherAsPublished) {
  // Academy S-2014-004.
  expect_near(rgb_from_rgb(space("ACES2065-1"), space("ACEScg")),
              {{.6954522414, .1406786965, .1638690622},
               {.0447945634, .8596711185, .0955343182},
               {-.0055258826, .0040252103, 1.0015006723}},
              1e-9);
  // ITU-R BT.2087-0.
  expect_near(rgb_from_rgb(space("Rec.2020"), kRec709),
              {{.6274, .3293, .0433}, {.0691, .9195, .0114}, {.0164, .0880, .8956}}, 6e-5);
  // Between D65 and the white of ACES by Bradford, as OpenColorIO's built-in transforms have it.
  expect_near(rgb_from_rgb(space("ACEScg"), kRec709),
              {{.61309732, .33952285, .04737928},
               {.07019422, .91635557, .01345259},
               {.02061560, .10956983, .86981512}},
              5e-6);
}

TEST(ColorSpace, WhiteStaysWhiteAndTheWayBackIsTheWayBack) {
  for (const std::string& from : color_space_names()) {
    for (const std::string& to : color_space_names()) {
      const glm::dmat3 there = rgb_from_rgb(*find_color_space(to), *find_color_space(from));
      const glm::dmat3 back = rgb_from_rgb(*find_color_space(from), *find_color_space(to));
      const glm::dvec3 white = there * glm::dvec3(1), again = back * (there * glm::dvec3(1, 2, 3));
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(white[c], 1, 1e-12) << from << " to " << to;
        EXPECT_NEAR(again[c], c + 1, 1e-12) << from << " to " << to;
      }
    }
  }
}

TEST(ColorSpace, NamesReadBack) {
  for (const std::string& name : color_space_names()) {
    EXPECT_EQ(to_string(color_space_named(name)), name);
  }
  EXPECT_EQ(to_string(kRec709), "Rec.709");
  EXPECT_EQ(to_string(Scene{}.primaries), "Rec.709");
}

TEST(ColorSpace, NumbersReadBackToTheBit) {
  const Primaries own{{.6, .3}, {.2, 1. / 3 + .3}, {.15, .06}, {.31, .33}};
  EXPECT_EQ(color_space_named(to_string(own)), own);
  EXPECT_EQ(color_space_named(" 0.6 0.3  0.2 0.7 0.15 0.06 0.3127 0.329 ").green,
            (Chromaticity{.2, .7}));
  // Primaries that a file has rounded are the space itself.
  EXPECT_EQ(to_string(color_space_named("0.7130 0.2930 0.1650 0.83 0.128 0.044 0.3217 0.3377")),
            "ACEScg");
}

TEST(ColorSpace, OthersNamesForThem) {
  const std::pair<const char*, const char*> names[] = {{"ACES - ACEScg", "ACEScg"},
                                                       {"acescg", "ACEScg"},
                                                       {"lin_ap1_scene", "ACEScg"},
                                                       {"Linear Rec.709 (sRGB)", "Rec.709"},
                                                       {"Utility - Linear - sRGB", "Rec.709"},
                                                       {"lin_rec2020", "Rec.2020"},
                                                       {"Linear P3-D65", "P3-D65"},
                                                       {"lin_ap0", "ACES2065-1"},
                                                       {"Linear", "Rec.709"},
                                                       {"Linear ACEScg", "ACEScg"},
                                                       {"Linear ACES", "ACES2065-1"}};
  for (const auto& [theirs, ours] : names) {
    ASSERT_TRUE(find_color_space(theirs)) << theirs;
    EXPECT_EQ(to_string(*find_color_space(theirs)), ours) << theirs;
  }
  for (const char* encoded : {"sRGB", "ACEScct", "Output - Rec.709", "", "-"}) {
    EXPECT_FALSE(find_color_space(encoded)) << encoded;
  }
}

std::string refusal(const std::string& text) {
  try {
    color_space_named(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ColorSpace, RefusesWhatIsNone) {
  EXPECT_THAT(refusal("ACESgc"),
              HasSubstr("color space 'ACESgc': expected one of Rec.709, Rec.2020, ACEScg, "
                        "ACES2065-1, P3-D65, DCI-P3, Adobe RGB, or eight numbers"));
  EXPECT_THAT(refusal("ACESgc"), HasSubstr("; did you mean 'ACEScg'?"));
  EXPECT_THAT(refusal("sRGB"), HasSubstr("color space 'sRGB': expected"));
  EXPECT_THAT(refusal(".64 .33 .3 .6 .15 .06 .3127"), HasSubstr("or eight numbers"));
  EXPECT_THAT(refusal(".64 .33 .3 .6 .15 .06 .3127 .329 1"), HasSubstr("or eight numbers"));
  for (const char* flat : {"0 0 0 0 0 0 0 0", "0.1 0.1 0.2 0.2 0.3 0.3 0.3127 0.329",
                           "0.64 0.33 0.3 0.6 0.15 0.06 0.7 0.2", "nan 0 0 1 0 0 0.3 0.3",
                           "0.64 0.33 0.3 0.6 0.15 0.06 0.3 0"}) {
    EXPECT_THAT(refusal(flat), HasSubstr("expected x and y of red, green, blue and a white "
                                         "between them"))
        << flat;
  }
  Scene scene;
  scene.primaries.white = {.7, .2};
  EXPECT_THROW(scene.validate(), Error);
}

}  // namespace
}  // namespace limpid
