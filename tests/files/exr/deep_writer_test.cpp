#include "limpid/files/exr/deep_writer.h"

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <map>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompositeDeepScanLine.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepImageStateAttribute.h>
#include <OpenEXR/ImfDeepScanLineInputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "limpid/core/error.h"
#include "limpid/files/exr/deep.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kMaxAlpha = 1 - 0x1p-24f;
const Rect kData{-3, 2, 8, 7};
const Rect kDisplay{0, 0, 6, 6};
constexpr double kExtinction[] = {0.4, 0.1, 0.05};

fs::path folder() {
  const fs::path path =
      fs::path(testing::TempDir()) /
      (std::string("deep_writer_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

std::vector<char> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Water of 1 + x/2 units, 5 + y deep in the view, on every second pixel; Beer-Lambert.
struct Pool {
  static bool wet(int x, int y) { return (x + y) % 2 == 0; }
  static float thickness(int x) { return 3 + 0.5f * static_cast<float>(x); }

  Pool() : front(kData), back(kData) {
    for (int c = 0; c < 3; ++c) {
      transmittance.emplace_back(kData);
      in_scatter.emplace_back(kData);
    }
    for (int y = kData.y0; y < kData.y1; ++y) {
      for (int x = kData.x0; x < kData.x1; ++x) {
        front.view().at(x, y) = wet(x, y) ? 5 + static_cast<float>(y) : kInf;
        back.view().at(x, y) = wet(x, y) ? 5 + static_cast<float>(y) + thickness(x) : 1;
        for (int c = 0; c < 3; ++c) {
          const double share = std::exp(-kExtinction[c] * thickness(x));
          transmittance[c].view().at(x, y) = wet(x, y) ? static_cast<float>(share) : kNan;
          in_scatter[c].view().at(x, y) =
              wet(x, y) ? static_cast<float>((1 - share) * (c + 1)) : kNan;
        }
      }
    }
  }

  DeepWater water() const {
    DeepWater water;
    water.data = kData;
    water.display = kDisplay;
    water.front = front.view();
    water.back = back.view();
    for (int c = 0; c < 3; ++c) {
      water.transmittance[c] = transmittance[c].view();
      water.in_scatter[c] = in_scatter[c].view();
    }
    return water;
  }

  Plane front, back;
  std::vector<Plane> transmittance, in_scatter;
};

/// One sample, by channel name; empty where a pixel has none.
using Sample = std::map<std::string, float>;

/// Every sample of a file with at most one a pixel, read by OpenEXR.
std::map<std::pair<int, int>, Sample> samples_of(const fs::path& path) {
  Imf::DeepScanLineInputFile file(path.c_str());
  const Imath::Box2i data = file.header().dataWindow();
  const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<unsigned> counts(pixels);
  std::map<std::string, std::vector<float>> values;
  std::map<std::string, std::vector<float*>> pointers;
  const std::ptrdiff_t first = data.min.x + std::ptrdiff_t{data.min.y} * width;
  const auto row = [&](std::size_t bytes) { return bytes * static_cast<std::size_t>(width); };
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data() - first), 4, row(4)));
  for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
    values[c.name()].resize(pixels, kNan);
    for (float& value : values[c.name()]) pointers[c.name()].push_back(&value);
    frame.insert(
        c.name(),
        Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers[c.name()].data() - first),
                       sizeof(float*), row(sizeof(float*)), sizeof(float)));
  }
  file.setFrameBuffer(frame);
  file.readPixelSampleCounts(data.min.y, data.max.y);
  for (unsigned count : counts) EXPECT_LE(count, 1u);
  file.readPixels(data.min.y, data.max.y);
  std::map<std::pair<int, int>, Sample> samples;
  for (std::size_t i = 0; i < pixels; ++i) {
    Sample& sample = samples[{data.min.x + static_cast<int>(i) % width,
                              data.min.y + static_cast<int>(i) / width}];
    if (counts[i] == 0) continue;
    for (const auto& [name, plane] : values) sample[name] = plane[i];
  }
  return samples;
}

/// Alpha of the part of a sample in front of z, by "Interpreting Deep Pixels", Splitting.
double alpha_until(const Sample& sample, const char* alpha, double z) {
  const double front = sample.at("Z"), back = sample.at("ZBack");
  return 1 - std::pow(1 - static_cast<double>(sample.at(alpha)), (z - front) / (back - front));
}

TEST(DeepWriter, OneVolumeSampleWhereThereIsWaterAndNoneElsewhere) {
  const fs::path path = folder() / "a.exr";
  const Pool pool;
  for (const char* compression : {"zips", "none", "rle", "zips:9"}) {
    DeepWater water = pool.water();
    water.compression = compression;
    water.half = false;
    write_deep_water(path, water);
    int wet = 0;
    for (const auto& [pixel, sample] : samples_of(path)) {
      const auto [x, y] = pixel;
      ASSERT_EQ(!sample.empty(), Pool::wet(x, y)) << x << " " << y << " " << compression;
      if (sample.empty()) continue;
      ++wet;
      EXPECT_EQ(sample.size(), 9u);
      EXPECT_EQ(sample.at("Z"), pool.front.view().at(x, y));
      EXPECT_EQ(sample.at("ZBack"), pool.back.view().at(x, y));
      double coverage = 0;
      for (int c = 0; c < 3; ++c) {
        const float alpha = sample.at(std::vector{"AR", "AG", "AB"}[c]);
        EXPECT_EQ(alpha, 1 - pool.transmittance[c].view().at(x, y));
        EXPECT_EQ(sample.at(std::vector{"R", "G", "B"}[c]), pool.in_scatter[c].view().at(x, y));
        coverage += alpha;
      }
      EXPECT_FLOAT_EQ(sample.at("A"), static_cast<float>(coverage / 3));
    }
    EXPECT_EQ(wet, 3 * 5 + 2 * 6);
  }
}

TEST(DeepWriter, APartOfTheSampleAbsorbsByBeerAndLambert) {
  const fs::path path = folder() / "a.exr";
  write_deep_water(path, Pool().water());
  for (const auto& [pixel, sample] : samples_of(path)) {
    if (sample.empty()) continue;
    const double thickness = Pool::thickness(pixel.first);
    for (double share : {0.25, 0.5, 0.9}) {
      const double z = sample.at("Z") + share * thickness;
      for (int c = 0; c < 3; ++c) {
        const double through = 1 - alpha_until(sample, std::vector{"AR", "AG", "AB"}[c], z);
        EXPECT_NEAR(through, std::exp(-kExtinction[c] * share * thickness), 1e-6);
      }
    }
  }
}

TEST(DeepWriter, OpenExrFlattensItToItsAlphaAndColor) {
  const fs::path path = folder() / "a.exr";
  const Pool pool;
  DeepWater water = pool.water();
  water.half = false;
  write_deep_water(path, water);
  Imf::DeepScanLineInputFile file(path.c_str());
  Imf::CompositeDeepScanLine composite;
  composite.addSource(&file);
  Plane a(kData), r(kData);
  Imf::FrameBuffer frame;
  for (auto [name, plane] : {std::pair{"A", &a}, std::pair{"R", &r}}) {
    const View<float> view = plane->view();
    float* origin = view.data - kData.x0 - kData.y0 * view.y_stride;
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(origin), sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(view.y_stride)));
  }
  composite.setFrameBuffer(frame);
  composite.readPixels(kData.y0, kData.y1 - 1);
  for (const auto& [pixel, sample] : samples_of(path)) {
    const auto [x, y] = pixel;
    EXPECT_EQ(a.view().at(x, y), sample.empty() ? 0 : sample.at("A"));
    EXPECT_EQ(r.view().at(x, y), sample.empty() ? 0 : sample.at("R"));
  }
}

TEST(DeepWriter, OurReaderSplitsItByBeerAndLambert) {
  const fs::path path = folder() / "a.exr";
  const Pool pool;
  DeepWater water = pool.water();
  water.half = false;
  write_deep_water(path, water);
  Plane middle(kData);
  for (int y = kData.y0; y < kData.y1; ++y) {
    std::fill_n(middle.view().row(y), kData.width(), 6.5f + static_cast<float>(y));
  }
  const DeepLayers layers = read_deep_layers(ExrFile::open(path), 0, std::as_const(middle).view());
  EXPECT_EQ(layers.replaced.total(), 0);
  for (int y = kData.y0; y < kData.y1; ++y) {
    for (int x = kData.x0; x < kData.x1; ++x) {
      const bool wet = Pool::wet(x, y);
      EXPECT_EQ(layers.depth.view().at(x, y), pool.front.view().at(x, y));
      const double below = Pool::thickness(x) - 1.5;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(layers.color[c].view().at(x, y), wet ? pool.in_scatter[c].view().at(x, y) : 0,
                    1e-6);
        EXPECT_NEAR(layers.below_color[c].view().at(x, y),
                    wet && below > 0 ? (1 - std::exp(-kExtinction[c] * below)) * (c + 1) : 0, 2e-6);
      }
      EXPECT_EQ(layers.below_depth.view().at(x, y),
                wet && below > 0 ? middle.view().at(x, y) : kInf);
    }
  }
}

TEST(DeepWriter, ColorsAreHalfByDefaultAndNothingElse) {
  const fs::path path = folder() / "a.exr";
  Pool pool;
  pool.in_scatter[0].view().at(0, 2) = 1e6f;
  write_deep_water(path, pool.water());
  const ExrFile file = ExrFile::open(path);
  for (const ExrChannel& channel : file.parts()[0].channels) {
    const bool color = channel.name == "R" || channel.name == "G" || channel.name == "B";
    EXPECT_EQ(channel.type, color ? SampleType::kHalf : SampleType::kFloat) << channel.name;
  }
  const auto samples = samples_of(path);
  EXPECT_EQ(samples.at({0, 2}).at("R"), 65504);
  EXPECT_NEAR(samples.at({2, 2}).at("R"), pool.in_scatter[0].view().at(2, 2), 5e-4);
}

TEST(DeepWriter, AlphaStaysBelowOneSoThatItCanBeSplit) {
  const fs::path path = folder() / "a.exr";
  Pool pool;
  for (int c = 0; c < 3; ++c) pool.transmittance[c].view().at(0, 2) = 0;
  pool.transmittance[1].view().at(2, 2) = 1.5f;
  write_deep_water(path, pool.water());
  const auto samples = samples_of(path);
  for (const char* alpha : {"A", "AR", "AG", "AB"}) {
    EXPECT_EQ(samples.at({0, 2}).at(alpha), kMaxAlpha);
    EXPECT_LT(alpha_until(samples.at({0, 2}), alpha, 8.5), 0.9999);
  }
  EXPECT_EQ(samples.at({2, 2}).at("AG"), 0);
}

TEST(DeepWriter, EndlessWaterEndsWhereItsClearestLightIsGone) {
  const fs::path path = folder() / "a.exr";
  Pool pool;
  for (float endless : {kInf, 1e9f, 3e10f}) {
    pool.back.view().at(0, 2) = endless;
    for (int c = 0; c < 3; ++c) pool.transmittance[c].view().at(0, 2) = 0;
    DeepWater water = pool.water();
    water.extinction = {0.4, 0, 0.05};
    write_deep_water(path, water);
    const Sample sample = samples_of(path).at({0, 2});
    EXPECT_NEAR(sample.at("ZBack"), 7 + std::log(std::pow(2, 24)) / 0.05, 1e-4);
    EXPECT_EQ(sample.at("AB"), kMaxAlpha);
    EXPECT_NEAR(1 - alpha_until(sample, "AB", 17), std::exp(-0.05 * 10), 1e-5);
  }
  DeepWater water = pool.water();
  water.extinction = {1e-30, 0, 0};
  write_deep_water(path, water);
  EXPECT_LT(samples_of(path).at({0, 2}).at("ZBack"), 1e9f);
  water.extinction = {1e30, 0, 0};
  write_deep_water(path, water);
  EXPECT_GT(samples_of(path).at({0, 2}).at("ZBack"), 7);
}

TEST(DeepWriter, WaterWithoutThicknessIsNone) {
  const fs::path path = folder() / "a.exr";
  Pool pool;
  pool.back.view().at(0, 2) = pool.front.view().at(0, 2);
  pool.front.view().at(2, 2) = 1e9f;  // what other programs write for infinity
  write_deep_water(path, pool.water());
  const auto samples = samples_of(path);
  EXPECT_TRUE(samples.at({0, 2}).empty());
  EXPECT_TRUE(samples.at({2, 2}).empty());
  EXPECT_FALSE(samples.at({4, 2}).empty());
}

TEST(DeepWriter, TheHeaderSaysWhatAFlatOneWouldAndThatPixelsAreTidy) {
  const fs::path path = folder() / "a.exr";
  const Pool pool;
  DeepWater water = pool.water();
  water.pixel_aspect = 2;
  water.inherited = {{"studio/secret", {"no_such_type", {1, 0, -1, 7}}},
                     {"comments", {"string", {'o', 'l', 'd'}}},
                     {"deepImageState", {"deepImageState", {0}}},
                     {"type", {"string", {'x'}}}};
  water.text = {{"comments", "ours"}};
  std::array<float, 16> matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[i] = static_cast<float>(i);
  water.matrices = {{"worldToCamera", matrix}};
  write_deep_water(path, water);

  const ExrFile file = ExrFile::open(path);
  ASSERT_EQ(file.parts().size(), 1u);
  const ExrPart& part = file.parts()[0];
  EXPECT_TRUE(part.deep);
  EXPECT_FALSE(part.tiled);
  EXPECT_EQ(part.data, kData);
  EXPECT_EQ(part.display, kDisplay);
  EXPECT_EQ(part.pixel_aspect, 2);
  EXPECT_EQ(part.compression, "zips");
  EXPECT_EQ(file.text_attribute(0, "comments"), "ours");
  EXPECT_EQ(file.matrix_attribute(0, "worldToCamera"), matrix);
  EXPECT_EQ(file.number_attribute(0, "maxSamplesPerPixel"), 1);
  EXPECT_EQ(file.attributes(0).at("studio/secret").bytes, (std::vector<char>{1, 0, -1, 7}));
  EXPECT_EQ(Imf::deepImageState(Imf::DeepScanLineInputFile(path.c_str()).header()), Imf::DIS_TIDY);
}

TEST(DeepWriter, BytesDependOnTheArgumentsAlone) {
  const fs::path here = folder();
  const Pool pool;
  set_file_threads(0);
  write_deep_water(here / "one.exr", pool.water());
  set_file_threads(3);
  write_deep_water(here / "many.exr", pool.water());
  set_file_threads(0);
  EXPECT_EQ(bytes_of(here / "one.exr"), bytes_of(here / "many.exr"));
}

TEST(DeepWriter, AWholeFileIsToldFromAPartOfIt) {
  const fs::path path = folder() / "a.exr";
  write_deep_water(path, Pool().water());
  EXPECT_TRUE(ExrFile::open(path).is_whole());
  fs::resize_file(path, fs::file_size(path) - 1);
  EXPECT_FALSE(ExrFile::open(path).is_whole());
}

TEST(DeepWriter, RefusesWhatItCannotWrite) {
  const fs::path here = folder(), path = here / "a.exr";
  const auto error = [&](auto change) -> std::string {
    Pool pool;
    DeepWater water = pool.water();
    change(water, pool);
    try {
      write_deep_water(path, water);
    } catch (const Error& caught) {
      EXPECT_THAT(caught.what(), StartsWith(path.string() + ": "));
      return caught.what();
    }
    return "";
  };
  EXPECT_EQ(
      error([](DeepWater& w, Pool&) { w.compression = "piz"; }),
      path.string() + ": compression 'piz': deep pixels are stored with one of none, rle, zips");
  EXPECT_THAT(error([](DeepWater& w, Pool&) { w.compression = "zip"; }), HasSubstr("none, rle"));
  EXPECT_THAT(error([](DeepWater& w, Pool&) { w.compression = "zops"; }), HasSubstr("did you"));
  EXPECT_THAT(error([](DeepWater& w, Pool&) { w.data.x1 += 1; }),
              HasSubstr("front depth does not cover the data window"));
  EXPECT_THAT(error([](DeepWater& w, Pool&) { w.in_scatter[2] = {}; }),
              HasSubstr("in-scatter does not cover"));
  EXPECT_THAT(error([](DeepWater& w, Pool&) { w.data = {}; }), HasSubstr("window is empty"));
  EXPECT_THAT(error([](DeepWater& w, Pool&) { w.text["chunkCount"] = ""; }),
              HasSubstr("attribute name 'chunkCount'"));
  EXPECT_THAT(error([](DeepWater& w, Pool&) { w.extinction[1] = -1; }), HasSubstr("extinction -1"));
  EXPECT_THAT(error([](DeepWater&, Pool& p) { p.front.view().at(0, 2) = kNan; }),
              HasSubstr("front depth nan at pixel (0, 2)"));
  EXPECT_THAT(error([](DeepWater&, Pool& p) { p.front.view().at(0, 2) = -kInf; }),
              HasSubstr("front depth -inf"));
  EXPECT_THAT(error([](DeepWater&, Pool& p) { p.back.view().at(0, 2) = kNan; }),
              HasSubstr("back depth nan at pixel (0, 2)"));
  EXPECT_THAT(error([](DeepWater&, Pool& p) { p.back.view().at(0, 2) = 6; }),
              HasSubstr("back depth 6.000000 at pixel (0, 2): expected at least the front, 7"));
  EXPECT_THAT(error([](DeepWater&, Pool& p) { p.back.view().at(0, 2) = kInf; }),
              HasSubstr("back depth is infinite at pixel (0, 2): expected extinction"));
  EXPECT_THAT(error([](DeepWater&, Pool& p) { p.transmittance[1].view().at(0, 2) = kNan; }),
              HasSubstr("transmittance is nan at pixel (0, 2)"));
  EXPECT_THAT(error([](DeepWater&, Pool& p) { p.in_scatter[1].view().at(0, 2) = kInf; }),
              HasSubstr("in-scatter inf at pixel (0, 2)"));
  EXPECT_TRUE(fs::is_empty(here));
}

TEST(DeepWriter, AFailedWriteLeavesTheOldFileAndNoOther) {
  const fs::path path = folder() / "a.exr";
  const Pool pool;
  write_deep_water(path, pool.water());
  const std::vector<char> old = bytes_of(path);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  std::vector<std::string> errors;
  for (std::size_t limit : {std::size_t{0}, old.size() / 2, old.size() - 1}) {
    const rlimit small{limit, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    try {
      write_deep_water(path, pool.water());
    } catch (const Error& error) {
      errors.push_back(error.what());
    }
    setrlimit(RLIMIT_FSIZE, &before);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(errors, std::vector(3, path.string() + ": cannot be written (file too large)"));
  EXPECT_EQ(bytes_of(path), old);
  EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace limpid
