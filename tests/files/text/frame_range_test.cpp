#include "limpid/files/text/frame_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

using testing::ElementsAre;

TEST(FrameRange, ReadsWhatOiiotoolReads) {
  EXPECT_THAT(frames_of("7"), ElementsAre(7));
  EXPECT_THAT(frames_of("1-5"), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(frames_of("1-100x33"), ElementsAre(1, 34, 67, 100));
  EXPECT_THAT(frames_of("10-1y3"), ElementsAre(9, 8, 6, 5, 3, 2));
  EXPECT_THAT(frames_of("1,3,7-9"), ElementsAre(1, 3, 7, 8, 9));
  EXPECT_THAT(frames_of("-2-1"), ElementsAre(-2, -1, 0, 1));
}

TEST(FrameRange, RefusesTheRest) {
  for (const char* text :
       {"", "a", "1-", "1-5x", "1-5x0", "1,,2", "1-5z2", "1 5", "0-99999999", "1-5y1"}) {
    EXPECT_THROW(frames_of(text), Error) << text;
  }
}

std::string refusal(const char* range) {
  try {
    frames_of(range);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::kUsage);
    return error.what();
  }
  return "not refused";
}

TEST(FrameRange, NamesTheCountThatIsTooLarge) {
  EXPECT_EQ(frames_of("1-1000000").size(), 1'000'000u);
  EXPECT_EQ(frames_of("1-2000000x2").size(), 1'000'000u);
  EXPECT_EQ(frames_of("-2147483647-2147483647x2147483647"),
            (std::vector<int>{-2147483647, 0, 2147483647}));
  EXPECT_EQ(refusal("0-1000000"), "frames '0-1000000' are 1000001: expected at most 1000000");
  EXPECT_EQ(refusal("1-600000,1-400000,7"),
            "frames '1-600000,1-400000,7' are 1000001: expected at most 1000000");
  EXPECT_EQ(refusal("-2147483647-2147483647y2"),
            "frames '-2147483647-2147483647y2' are 2147483647: expected at most 1000000");
  EXPECT_EQ(refusal("1-99999999999"),
            "frames '1-99999999999': 99999999999: expected numbers -2147483647 ... 2147483647");
  EXPECT_THAT(refusal("-2147483648"), testing::HasSubstr("': -2147483648: expected numbers"));
  EXPECT_THAT(refusal("5-5y1"), testing::HasSubstr("5-5y1"));
}

TEST(FrameRange, PutsTheNumberIntoNames) {
  EXPECT_EQ(name_of_frame("wet.%04d.exr", 12), "wet.0012.exr");
  EXPECT_EQ(name_of_frame("wet.%d.exr", 12), "wet.12.exr");
  EXPECT_EQ(name_of_frame("wet.#.exr", 12), "wet.0012.exr");
  EXPECT_EQ(name_of_frame("wet.####.exr", 12), "wet.0012.exr");
  EXPECT_EQ(name_of_frame("wet.######.exr", 12), "wet.000012.exr");
  EXPECT_EQ(name_of_frame("wet.##.exr", 123), "wet.123.exr");
  EXPECT_EQ(name_of_frame("wet.@@.exr", 7), "wet.07.exr");
  EXPECT_EQ(name_of_frame("wet#", 12), "wet0012");
  EXPECT_EQ(name_of_frame("wet.exr", 7), "wet.exr");
  EXPECT_EQ(name_of_frame("wet.%04d.exr", -3), "wet.-0003.exr");
  EXPECT_THROW(name_of_frame("wet.%s.exr", 1), Error);
  EXPECT_TRUE(has_frame_number("a.#.exr"));
  EXPECT_FALSE(has_frame_number("a.exr"));
}

}  // namespace
}  // namespace limpid
