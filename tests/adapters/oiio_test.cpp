#include "limpid/oiio.h"

#include <Imath/half.h>
#include <OpenImageIO/imagecache.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plain.h"

namespace limpid::test {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::TypeDesc;
using testing::HasSubstr;

constexpr Rect kWindow{0, 0, 37, 21};

ImageSpec spec_of(Rect window, Rect display, TypeDesc type, std::vector<std::string> names) {
  ImageSpec spec(window.width(), window.height(), static_cast<int>(names.size()), type);
  spec.channelnames = std::move(names);
  spec.x = window.x0;
  spec.y = window.y0;
  spec.full_x = display.x0;
  spec.full_y = display.y0;
  spec.full_width = display.width();
  spec.full_height = display.height();
  return spec;
}

/// Fills the channels from `first` on with red, green, blue ...
void fill(ImageBuf& buf, int first, std::vector<int> channels) {
  const Rect window = window_of(buf);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      for (std::size_t c = 0; c < channels.size(); ++c) {
        std::vector<float> pixel(buf.nchannels());
        buf.getpixel(x, y, pixel.data());
        pixel[first + c] = dry(x, y, channels[c]);
        buf.setpixel(x, y, pixel.data());
      }
    }
  }
}

/// The number of pixels that differ from the plain pixels, converted as OpenImageIO does, in the
/// named channels.
int pixels_that_differ(const ImageBuf& buf, const std::string& names,
                       const std::vector<std::vector<float>>& plain) {
  const Rect window = window_of(buf);
  int count = 0;
  std::size_t i = 0;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x, ++i) {
      for (std::size_t c = 0; c < names.size(); ++c) {
        float expected = plain[c][i];
        if (buf.pixeltype() == OIIO::TypeHalf) expected = Imath::half(expected);
        count += buf.getchannel(x, y, 0, channel_named(buf, {names[c]})) != expected;
      }
    }
  }
  return count;
}

TEST(Oiio, FloatsAndHalvesGiveTheBitsOfPlainArrays) {
  for (const TypeDesc& type : {OIIO::TypeFloat, OIIO::TypeHalf}) {
    SCOPED_TRACE(type.c_str());
    const Plain plain(kWindow);
    ImageBuf buf(spec_of(kWindow, kWindow, type, {"id", "Z", "A", "B", "G", "R"}));
    fill(buf, 1, {kDepth, kAlpha, kBlue, kGreen, kRed});
    EXPECT_EQ(pixels_that_differ(buf, "RGBAZ", plain.channels()), 0) << "the dry picture";
    HostFrame frame = plain.empty_frame();
    set_color(frame, buf);
    set_plane(frame, PlaneId::kDepth, buf, "Z");

    ImageBuf wet(ImageSpec(kWindow.width(), kWindow.height(), 4, type));
    composite(frame, picture_of(wet));
    EXPECT_EQ(pixels_that_differ(wet, "RGBA", plain.wet()), 0);
    EXPECT_GT(pixels_that_differ(wet, "RGBA", plain.channels()), 0) << "there is water";

    composite(frame, picture_of(buf));
    EXPECT_EQ(pixels_that_differ(buf, "RGBA", plain.wet()), 0) << "in place";
    EXPECT_EQ(buf.getchannel(3, 4, 0, 0), 0) << "the channel beside them";
  }
}

TEST(Oiio, WindowsAreThoseOfThePicture) {
  const Rect display{10, 20, 47, 41}, overscan{6, 17, 55, 49};
  const Plain plain(display, overscan);
  ImageBuf buf(spec_of(overscan, display, OIIO::TypeFloat, {"R", "G", "B", "Z"}));
  fill(buf, 0, {kRed, kGreen, kBlue, kDepth});
  EXPECT_EQ(display_of(buf), display);
  HostFrame frame = plain.empty_frame();
  set_color(frame, buf);
  set_plane(frame, PlaneId::kDepth, buf, 3);
  EXPECT_EQ(frame.plane(PlaneId::kDepth).window, overscan);
  EXPECT_FALSE(frame.plane(PlaneId::kColorA));
  composite(frame, picture_of(buf));
  EXPECT_EQ(pixels_that_differ(buf, "RGB", plain.wet(false)), 0);
  EXPECT_GT(pixels_that_differ(buf, "RGB", plain.channels()), 0) << "there is water";
}

TEST(Oiio, MemoryOfOthersHasTheirStrides) {
  // Rows from the lowest up, 5 floats a pixel; no plane reads the last float.
  const Plain plain(kWindow);
  const int width = kWindow.width(), height = kWindow.height();
  std::vector<float> memory(5 * width * height, 7);
  const OIIO::stride_t pixel = 5 * sizeof(float), row = pixel * width;
  ImageBuf buf(spec_of(kWindow, kWindow, OIIO::TypeFloat, {"R", "G", "B", "Z"}),
               memory.data() + 5 * width * (height - 1), pixel, -row);
  fill(buf, 0, {kRed, kGreen, kBlue, kDepth});
  HostFrame frame = plain.empty_frame();
  set_color(frame, buf);
  set_plane(frame, PlaneId::kDepth, buf, "Z");
  composite(frame, picture_of(buf));
  EXPECT_EQ(pixels_that_differ(buf, "RGB", plain.wet(false)), 0);
  for (std::size_t i = 4; i < memory.size(); i += 5) ASSERT_EQ(memory[i], 7);
}

TEST(Oiio, LayersGoByTheirNames) {
  ImageBuf buf(spec_of({0, 0, 1, 1}, {0, 0, 1, 1}, OIIO::TypeFloat,
                       {"R", "G", "B", "A", "mirror.R", "mirror.G", "mirror.B"}));
  const float values[] = {1, 2, 3, 4, 5, 6, 7};
  buf.setpixel(0, 0, values);
  HostFrame frame;
  set_color(frame, buf);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kColorB), 0, 0), 3);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kColorA), 0, 0), 4);
  set_colors(frame, PlaneId::kReflectionR, buf, "mirror.");
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kReflectionR), 0, 0), 5);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kReflectionB), 0, 0), 7);
  set_color(frame, buf, "mirror.");
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kColorR), 0, 0), 5);
  EXPECT_FALSE(frame.plane(PlaneId::kColorA)) << "this layer has none";
  EXPECT_EQ(sample_at(picture_of(buf, "mirror.").color[1], 0, 0), 6);
}

std::string refusal(const ImageBuf& buf) {
  try {
    channel_of(buf, 0);
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(Oiio, OtherBuffersAreRefusedInASentence) {
  EXPECT_EQ(refusal(ImageBuf("a.png", ImageSpec(2, 2, 3, OIIO::TypeUInt8))),
            "ImageBuf 'a.png': pixels of uint8, expected float or half, scene-linear");
  EXPECT_THAT(refusal(ImageBuf(ImageSpec(2, 2, 3, TypeDesc::DOUBLE))), HasSubstr("of double"));
  EXPECT_THAT(refusal(ImageBuf()), HasSubstr("no pixels in memory"));
  EXPECT_THAT(refusal(ImageBuf("no such file.exr")), HasSubstr("no pixels in memory"));
  ImageSpec volume(2, 2, 1, OIIO::TypeFloat), deep = volume;
  volume.depth = 2;
  deep.deep = true;
  EXPECT_THAT(refusal(ImageBuf(volume)), HasSubstr("deep or a volume"));
  EXPECT_THAT(refusal(ImageBuf(deep)), HasSubstr("deep or a volume"));
  EXPECT_EQ(refusal(ImageBuf(ImageSpec(2, 2, 3, OIIO::TypeHalf))), "taken");
}

TEST(Oiio, FilesMustBeReadIntoTheBuffer) {
  const std::string path = testing::TempDir() + "oiio_adapter.exr";
  ASSERT_TRUE(ImageBuf(ImageSpec(2, 2, 3, OIIO::TypeFloat)).write(path));
  const std::unique_ptr<OIIO::ImageCache, void (*)(OIIO::ImageCache*)> cache(
      OIIO::ImageCache::create(false), [](OIIO::ImageCache* c) { OIIO::ImageCache::destroy(c); });
  ImageBuf buf(path, 0, 0, cache.get());
  ASSERT_TRUE(buf.read(0, 0, false));
  EXPECT_THAT(refusal(buf), HasSubstr("expected read(0, 0, true) before"));
  ASSERT_TRUE(buf.read(0, 0, true));
  EXPECT_EQ(refusal(buf), "taken");
}

TEST(Oiio, TexturesAreTheFloatsOfALayer) {
  ImageSpec spec(3, 2, 4, OIIO::TypeFloat);
  spec.channelnames = {"sky.A", "sky.B", "sky.G", "sky.R"};
  spec.x = 5;
  ImageBuf buf(spec);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      const float at = static_cast<float>(10 * y + x);
      const std::array<float, 4> pixel{1, 200 + at, 100 + at, at};
      buf.setpixel(x + 5, y, 0, pixel);
    }
  }
  const Texture sky = texture_of(buf, "sky.");
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(sky.channels[c].window, (Rect{0, 0, 3, 2}));
    EXPECT_EQ(sky.channels[c].at(2, 1), 100 * c + 12);
  }
  EXPECT_THROW(texture_of(buf), Error);
  EXPECT_THROW(texture_of(ImageBuf(ImageSpec(2, 2, 3, OIIO::TypeHalf))), Error);
}

TEST(Oiio, ChannelsThatAreNotThereAreRefused) {
  ImageBuf buf("gray.exr", ImageSpec(2, 2, 2, OIIO::TypeFloat));
  HostFrame frame;
  EXPECT_THROW(set_color(frame, buf), Error);
  EXPECT_THROW(picture_of(buf), Error);
  EXPECT_THROW(set_plane(frame, PlaneId::kDepth, buf, 2), Error);
  EXPECT_THROW(set_plane(frame, PlaneId::kDepth, buf, -1), Error);
  try {
    set_plane(frame, PlaneId::kDepth, buf, "Z");
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("ImageBuf 'gray.exr': has no channel Z; it has "));
  }
}

}  // namespace
}  // namespace limpid::test
