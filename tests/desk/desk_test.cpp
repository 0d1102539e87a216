#include "desk/desk.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>

#include "limpid/files/picture/preview.h"
#include "limpid/files/text/look_file.h"

#include "desk/pond_desk.h"
#include "files/picture/tiny_ocio.h"
#include "judge/compare/heat_map.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

PictureRequest picture(std::vector<std::string> settings = {}) {
  PictureRequest request;
  request.look = "pond";
  request.settings = std::move(settings);
  return request;
}

class DeskWindows : public PondDesk, public ::testing::WithParamInterface<PlateOptions> {};

TEST_P(DeskWindows, ShowsThePreviewsBytesAtTheWholeSize) {
  const DeskOptions options = this->options(GetParam());
  Desk desk(options, *executor_);
  const std::vector<std::uint8_t> shown = colors(desk.paint(picture()).shown);
  EXPECT_EQ(shown, previewed(options, options.looks[0].look));
  const std::string setting = "depth_fog.density=3";
  Look look = options.looks[0].look;
  apply_setting(look, setting);
  const std::vector<std::uint8_t> murky = colors(desk.paint(picture({setting})).shown);
  EXPECT_NE(murky, shown);
  EXPECT_EQ(murky, previewed(options, look));
}

/// The mean of |whole - half| over the channels of half pixels, of 255. The whole picture's value
/// is the mean light of its pixels (dx, dy) half pixels beside the half pixel.
double apart(const Shown& whole, const Shown& half, int dx, int dy) {
  const auto light = [](const Shown& shown, int x, int y, int c) {
    return linear_from_srgb(shown.rgba[(std::size_t(y) * shown.size.width + x) * 4 + c] / 255.0f);
  };
  double sum = 0;
  int count = 0;
  for (int y = 1; y < whole.size.height / 2 - 1; ++y) {
    for (int x = 1; x < whole.size.width / 2 - 1; ++x) {
      for (int c = 0; c < 3; ++c, ++count) {
        float mean = 0;
        for (int k = 0; k < 4; ++k) {
          mean += light(whole, 2 * (x + dx) + k % 2, 2 * (y + dy) + k / 2, c) / 4;
        }
        sum += std::abs(srgb_from_linear(mean) - srgb_from_linear(light(half, x, y, c)));
      }
    }
  }
  return 255 * sum / count;
}

TEST_P(DeskWindows, ShowsTheSameViewAtHalfTheSize) {
  Desk desk(options(GetParam()), *executor_);
  // Calm, because waves finer than a pixel reflect another mean light when pixels grow.
  PictureRequest request = picture({"wave_normals.strength=0"});
  const Shown whole = desk.paint(request).shown;
  request.half = true;
  const DeskPicture painted = desk.paint(request);
  const Shown& half = painted.shown;
  EXPECT_TRUE(painted.half);
  ASSERT_EQ(half.size, (Size{(whole.size.width + 1) / 2, (whole.size.height + 1) / 2}));
  const double here = apart(whole, half, 0, 0);
  RecordProperty("of_255", std::to_string(here));
  EXPECT_LT(here, 5);  // half pixels with a shore in them are wet or dry as a whole
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    EXPECT_GT(apart(whole, half, dx, dy), 1.5 * here) << dx << ", " << dy;
  }
}

PlateOptions windows(Rect data, Rect display) {
  PlateOptions options;
  options.data = data;
  options.display = display;
  return options;
}

INSTANTIATE_TEST_SUITE_P(All, DeskWindows,
                         ::testing::Values(PlateOptions{}, windows({0, 0, 63, 35}, {0, 0, 63, 35}),
                                           windows({-5, -3, 70, 40},
                                                   {0, 0, 64, 36}),  // with overscan
                                           windows({103, 55, 160, 82}, {100, 50, 164, 86})));

using DeskTest = PondDesk;

TEST_F(DeskTest, ShowsOtherTimesAsTheToolDoes) {
  const DeskOptions options = this->options();
  Desk desk(options, *executor_);
  PictureRequest request = picture();
  const std::vector<std::uint8_t> before = colors(desk.paint(request).shown);
  request.time = 2.5;
  const std::vector<std::uint8_t> after = colors(desk.paint(request).shown);
  EXPECT_NE(before, after);
  EXPECT_EQ(after, previewed(options, options.looks[0].look, {}, 2.5));
}

TEST_F(DeskTest, BrightensByStops) {
  Desk desk(options(), *executor_);
  PictureRequest request = picture();
  request.show = "dry";
  const std::vector<std::uint8_t> before = colors(desk.paint(request).shown);
  request.exposure = 1;
  const std::vector<std::uint8_t> after = colors(desk.paint(request).shown);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const float twice = std::min(1.0f, 2 * linear_from_srgb(before[i] / 255.0f));
    ASSERT_NEAR(after[i], 255 * srgb_from_linear(twice), 4);
  }
  request.exposure = std::nan("");
  EXPECT_THAT(refusal([&] { desk.paint(request); }), HasSubstr("exposure = "));
}

TEST_F(DeskTest, ShowsLightByAConfigAsTheToolDoes) {
  DeskOptions options = this->options();
  options.display = {0, write_tiny_ocio(folder_ / "tiny.ocio"), "screen/swapped"};
  const CompositeJob job = options.job_of({});
  options.job_of = [job](std::optional<int>) {
    CompositeJob acescg = job;
    acescg.primaries = find_color_space("ACEScg");
    return acescg;
  };
  Desk desk(options, *executor_);
  EXPECT_THAT(desk.displays(), ElementsAre("screen/swapped", "screen/half", "wall/half", "sRGB"));
  const Look& look = options.looks[0].look;
  const auto shown_as = [&](const std::string& display, const DisplayChoice& choice) {
    PictureRequest request = picture();
    request.exposure = choice.exposure;
    request.display = display;
    DeskOptions of_tool = options;
    of_tool.job_of = [&](std::optional<int> frame) {
      CompositeJob one = options.job_of(frame);
      one.output.display = choice;
      return one;
    };
    EXPECT_EQ(colors(desk.paint(request).shown), previewed(of_tool, look)) << display;
  };
  const std::filesystem::path& config = options.display.config;
  shown_as("", {1, config, "screen/swapped"});
  shown_as("wall/half", {0, config, "wall/half"});
  shown_as("sRGB", {-1, {}, ""});
  PictureRequest request = picture();
  request.display = "wal/half";
  EXPECT_THAT(refusal([&] { desk.paint(request); }),
              HasSubstr("display = 'wal/half': expected one of screen/swapped, screen/half, "
                        "wall/half, sRGB; did you mean 'wall/half'?"));
}

TEST_F(DeskTest, ShowsAllThatItOffers) {
  DeskOptions options = this->options();
  options.reference = [](std::optional<int>, const Primaries&) {
    return std::array<Plane, 3>{Plane(kPicture), Plane(kPicture), Plane(kPicture)};
  };
  Desk desk(options, *executor_);
  std::vector<std::string> names;
  for (const DeskShow& show : desk.shows()) {
    names.push_back(show.name);
    PictureRequest request = picture();
    request.show = show.name;
    EXPECT_EQ(desk.paint(request).shown.size, (Size{64, 36})) << show.name;
    request.half = true;
    EXPECT_EQ(desk.paint(request).shown.size, (Size{32, 18})) << show.name;
  }
  for (const AovInfo& info : aovs()) EXPECT_THAT(names, Contains(std::string(info.name)));
  PictureRequest request = picture();
  request.show = "pictur";
  EXPECT_THAT(refusal([&] { desk.paint(request); }),
              HasSubstr("show = 'pictur': expected one of picture, dry, reference, difference, "
                        "cells, transmitted"));
}

TEST_F(DeskTest, ShowsHowFarThePictureIsFromItsReference) {
  DeskOptions options = this->options();
  options.reference = [](std::optional<int>, const Primaries&) {
    return std::array<Plane, 3>{Plane(kPicture), Plane(kPicture), Plane(kPicture)};
  };
  Desk desk(options, *executor_);
  PictureRequest request = picture();
  request.show = "reference";
  const std::vector<std::uint8_t> black = colors(desk.paint(request).shown);
  EXPECT_EQ(std::count(black.begin(), black.end(), 0), std::ptrdiff_t(black.size()));
  request.show = "difference";
  request.exposure = -2;
  const DeskPicture painted = desk.paint(request);
  EXPECT_EQ(painted.shown.scale, (std::array<double, 2>{0, 1}));
  const PixelNumbers numbers = desk.pixel(request, 40, 30);
  const float largest = std::max({numbers.picture.r, numbers.picture.g, numbers.picture.b});
  EXPECT_GT(largest, 0.05);
  const std::array<float, 3> expected = heat_color(largest);
  const std::uint8_t* const at = painted.shown.rgba.data() + 4 * (30 * 64 + 40);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(at[c], 255 * expected[c], 0.51);
}

TEST_F(DeskTest, RefusesAReferenceOfAnotherSize) {
  DeskOptions options = this->options();
  options.reference = [](std::optional<int>, const Primaries&) {
    const Rect small{0, 0, 63, 36};
    return std::array<Plane, 3>{Plane(small), Plane(small), Plane(small)};
  };
  Desk desk(options, *executor_);
  PictureRequest request = picture();
  request.show = "reference";
  EXPECT_EQ(refusal([&] { desk.paint(request); }),
            "reference: expected a picture that covers the plate, 64x36 pixels");
}

TEST_F(DeskTest, TellsThePixelsNumbers) {
  Desk desk(options(), *executor_);
  const PixelNumbers numbers = desk.pixel(picture(), 40, 30);
  float red = 0;
  std::size_t channels = 0;
  for (const auto& [aov, values] : numbers.aovs) {
    channels += values.size();
    EXPECT_EQ(values.size(), aovs()[std::size_t(aov)].suffixes.size());
    const bool summed = aov == Aov::kTransmitted || aov == Aov::kInScatter ||
                        aov == Aov::kReflected || aov == Aov::kHighlight;
    if (summed) red += values[0];
  }
  EXPECT_EQ(numbers.aovs.size(), aovs().size());
  EXPECT_GT(channels, 30u);
  EXPECT_NEAR(red, numbers.picture.r, 1e-5);
  PictureRequest darker = picture();
  darker.exposure = -4;  // so that the picture is not white
  const std::vector<std::uint8_t> shown = colors(desk.paint(darker).shown);
  EXPECT_NEAR(shown[3 * (30 * 64 + 40)], 255 * srgb_from_linear(numbers.picture.r / 16), 0.51);
  EXPECT_EQ(refusal([&] { desk.pixel(picture(), 64, 0); }),
            "pixel 64, 0: expected 0 ... 63, 0 ... 35");
  EXPECT_EQ(refusal([&] { desk.pixel(picture(), 0, -1); }),
            "pixel 0, -1: expected 0 ... 63, 0 ... 35");
}

/// An executor with two threads that calls `on_run` when work begins.
class Interrupted : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    if (on_run) on_run();
    inner_->run(count, task, context);
  }
  std::function<void()> on_run;

 private:
  std::unique_ptr<Executor> inner_ = make_executor(2);
};

TEST_F(DeskTest, BreaksOffWhatNobodyWantsAnyMore) {
  Interrupted executor;
  const DeskOptions options = this->options();
  Desk desk(options, executor);
  PictureRequest half = picture();
  half.half = true;
  const std::vector<std::uint8_t> before = colors(desk.paint(half).shown);
  executor.on_run = [&] { desk.break_off(); };
  const PictureRequest murky = picture({"depth_fog.density=3"});
  EXPECT_THROW(desk.paint(murky), Stopped);
  EXPECT_THROW(desk.pixel(murky, 40, 30), Stopped);
  executor.on_run = {};
  EXPECT_EQ(colors(desk.paint(half).shown), before);
  Look look = options.looks[0].look;
  apply_setting(look, "depth_fog.density=3");
  EXPECT_EQ(colors(desk.paint(murky).shown), previewed(options, look));
  const PixelNumbers numbers = desk.pixel(murky, 40, 30);
  Desk fresh(options, *executor_);
  const PixelNumbers expected = fresh.pixel(murky, 40, 30);
  EXPECT_EQ(numbers.picture.r, expected.picture.r);
  EXPECT_EQ(numbers.aovs, expected.aovs);
}

TEST_F(DeskTest, GoesOnAfterALookThatIsWrong) {
  Desk desk(options(), *executor_);
  const std::vector<std::uint8_t> before = colors(desk.paint(picture()).shown);
  PictureRequest wrong = picture({"depth_fog.density=-1"});
  EXPECT_THAT(refusal([&] { desk.paint(wrong); }), HasSubstr("depth_fog.density = -1"));
  wrong = picture({"wave_normals.map=nowhere.exr"});
  EXPECT_THAT(refusal([&] { desk.paint(wrong); }), HasSubstr("nowhere.exr"));
  EXPECT_THAT(refusal([&] { desk.pixel(wrong, 1, 1); }), HasSubstr("nowhere.exr"));
  wrong = picture();
  wrong.look = "pnd";
  EXPECT_EQ(refusal([&] { desk.paint(wrong); }),
            "look = 'pnd': expected one of pond; did you mean 'pond'?");
  EXPECT_EQ(colors(desk.paint(picture()).shown), before);
}

TEST_F(DeskTest, RefusesAPlateThatCannotBeUsed) {
  PlateOptions plate;
  plate.depth = false;
  const DeskOptions options = this->options(plate);
  EXPECT_THAT(refusal([&] { Desk(options, *executor_); }), HasSubstr("no depth"));
}

TEST_F(DeskTest, SaysWhatTheTimeWentInto) {
  Desk desk(options(), *executor_);
  const DeskPicture painted = desk.paint(picture());
  std::vector<std::string> names;
  for (const auto& [name, time] : painted.milliseconds) {
    names.push_back(name);
    EXPECT_GE(time, 0) << name;
  }
  std::vector<std::string> expected = {"all", "read"};
  for (const OperatorInfo& op : operators()) expected.emplace_back(op.name);
  expected.emplace_back("rest");
  EXPECT_EQ(names, expected);
  ASSERT_TRUE(painted.wet);
  EXPECT_GT(*painted.wet, 0.1);
  EXPECT_LE(*painted.wet, 1);
}

TEST_F(DeskTest, NamesTheParameterWhoseLightASkyReplaces) {
  DeskOptions options = this->options();
  const PictureRequest murky =
      picture({"depth_fog.model=radiative_transfer", "depth_fog.scattering=0.1,0.1,0.1"});
  const auto shown = Desk(options, *executor_).paint(murky).unread;
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(shown[0].why, "the picture's sky lights the water");
  options.job_of = [first = options.job_of](std::optional<int> frame) {
    CompositeJob job = first(frame);
    job.scene.scene.sky = SkyLight{{0.2, 0.3, 0.4}};
    return job;
  };
  Desk desk(options, *executor_);
  EXPECT_TRUE(desk.paint(picture()).unread.empty()) << "linear fog has a color of its own";
  const DeskPicture lit = desk.paint(murky);
  ASSERT_EQ(lit.unread.size(), 1u);
  EXPECT_EQ(lit.unread[0].key, "depth_fog.ambient");
  EXPECT_EQ(lit.unread[0].why, "the scene's sky lights the water");
  PictureRequest brighter = murky;
  brighter.settings.push_back("depth_fog.ambient=0.9,0.9,0.9");
  EXPECT_EQ(desk.paint(brighter).shown.rgba, lit.shown.rgba);
}

/// Two frames; the second frame has another window, at another place.
DeskOptions two_frames(DeskOptions options, const fs::path& folder) {
  PlateOptions second;
  second.data = second.display = {10, 20, 74, 56};
  write_plate(folder / "plate.2.exr", second);
  const auto first = options.job_of;
  options.job_of = [first, folder](std::optional<int> frame) {
    CompositeJob job = first({});
    if (frame == 2) {
      job.plate.files = {folder / "plate.2.exr"};
      job.time.explicit_time = 5;
    }
    return job;
  };
  options.frames = {1, 2};
  return options;
}

TEST_F(DeskTest, ShowsEachFrameAsTheToolDoes) {
  for (const std::int64_t most_bytes : {std::int64_t{0}, std::int64_t{1} << 30}) {
    DeskOptions options = two_frames(this->options(), folder_);
    options.most_bytes = most_bytes;
    Desk desk(options, *executor_);
    EXPECT_EQ(desk.facts().frame, 1);
    for (const int frame : {2, 1, 2}) {
      PictureRequest request = picture();
      request.frame = frame;
      EXPECT_EQ(colors(desk.paint(request).shown), previewed(options, options.looks[0].look, frame))
          << frame;
    }
    PictureRequest request = picture();
    request.frame = 3;
    EXPECT_EQ(refusal([&] { desk.paint(request); }), "frame = 3: expected one of --frames");
  }
}

TEST_F(DeskTest, RefusesAFrameWhereThereIsOnePicture) {
  Desk desk(options(), *executor_);
  PictureRequest request = picture();
  request.frame = 1;
  EXPECT_EQ(refusal([&] { desk.paint(request); }),
            "frame = 1: expected none, since there is only one picture");
}

}  // namespace
}  // namespace limpid::test
