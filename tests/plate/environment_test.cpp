#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include <OpenEXR/ImfEnvmap.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/scene.h"
#include "limpid/files/exr/exr_writer.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/plate/texture.h"

#include "files/exr/written.h"
#include "plate/primaries.h"

namespace limpid {
namespace {

using test::error_of;
using test::own_folder;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

namespace fs = std::filesystem;

using Pixels = std::function<glm::dvec3(int x, int y)>;

struct Written {
  std::string envmap = {};  ///< byte of the attribute; empty: no attribute
  std::vector<std::string> channels = {"R", "G", "B"};
  glm::ivec2 corner = {0, 0};
  std::optional<Primaries> primaries = {};  ///< told by the file
};

fs::path write_picture(Size size, const Pixels& pixels, const Written& how = {}) {
  ExrOutput output;
  output.data = output.display = {how.corner.x, how.corner.y, how.corner.x + size.width,
                                  how.corner.y + size.height};
  std::deque<Plane> planes;
  for (std::size_t c = 0; c < how.channels.size(); ++c) {
    Plane& plane = planes.emplace_back(output.data);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        plane.view().at(how.corner.x + x, how.corner.y + y) =
            static_cast<float>(pixels(x, y)[static_cast<glm::length_t>(c)]);
      }
    }
    output.channels.push_back({how.channels[c], plane.view(), false});
  }
  if (!how.envmap.empty()) {
    output.inherited["envmap"] = {"envmap", {how.envmap.begin(), how.envmap.end()}};
  }
  if (how.primaries) tell_primaries(output.inherited, *how.primaries);
  const fs::path path = own_folder() / "sky.exr";
  write_exr(path, output);
  return path;
}

glm::dvec3 texel(const LoadedTexture& map, int x, int y) {
  const auto c = [&](std::size_t i) { return map.texture.channels[i].at(x, y); };
  return {c(0), c(1), c(2)};
}

Size size_of(const LoadedTexture& map) { return map.texture.channels[0].window.size(); }

/// The world direction of a texel's centre in the layout of Frame::environment.
glm::dvec3 direction_of(const glm::dvec3& up, Size size, int x, int y) {
  const PlaneAxes axes = plane_axes(up);
  const double around = 2 * std::numbers::pi * ((x + 0.5) / size.width - 0.5);
  const double polar = std::numbers::pi * (y + 0.5) / size.height;
  return std::cos(polar) * up +
         std::sin(polar) * (std::cos(around) * axes.x + std::sin(around) * axes.y);
}

glm::dvec3 own_place(int x, int y) { return {x, y, 100 * x + y}; }

TEST(Environment, LatLongLooksAsInBlenderWithZUp) {
  const Size size{16, 8};
  const LoadedTexture map = load_environment(write_picture(size, own_place), 0);
  ASSERT_EQ(size_of(map), size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 d = direction_of({0, 0, 1}, size, x, y);
      const double u = 0.5 - std::atan2(d.y, d.x) / (2 * std::numbers::pi);
      const double v = std::acos(d.z) / std::numbers::pi;
      const glm::dvec3 expected =
          own_place(static_cast<int>(u * size.width), static_cast<int>(v * size.height));
      EXPECT_EQ(texel(map, x, y), expected) << x << ' ' << y;
    }
  }
}

TEST(Environment, AQuarterTurnClockwiseLooksAsInOpenExrWithYUp) {
  // OpenEXR's texel centres lie on the poles and on the seam, so places agree to half a texel.
  const Size size{64, 32};
  const LoadedTexture map =
      load_environment(write_picture(size, own_place), -0.5 * std::numbers::pi);
  const Imath::Box2i window({0, 0}, {size.width - 1, size.height - 1});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 d = direction_of({0, 1, 0}, size, x, y);
      const Imath::V2f place = Imf::LatLongMap::pixelPosition(
          window,
          Imath::V3f(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)));
      EXPECT_NEAR(texel(map, x, y).x, place.x, 0.5001) << x << ' ' << y;
      EXPECT_NEAR(texel(map, x, y).y, place.y, 0.5001) << x << ' ' << y;
    }
  }
}

TEST(Environment, TurningByPartsOfATexelMixesNeighbours) {
  const Size size{8, 4};
  const auto path = write_picture(size, [](int x, int) { return glm::dvec3(x == 3 ? 1 : 0); });
  const auto row = [&](double texels) {
    const LoadedTexture map = load_environment(path, texels / 8 * 2 * std::numbers::pi);
    std::vector<float> values;
    for (int x = 0; x < 8; ++x) values.push_back(map.texture.channels[0].at(x, 1));
    return values;
  };
  using Row = std::vector<float>;
  EXPECT_EQ(row(0), (Row{0, 0, 0, 0, 1, 0, 0, 0}));  // mirrored: columns run the other way
  EXPECT_EQ(row(1), (Row{0, 0, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(row(-5), (Row{0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(row(8001), row(1));
  const Row mixed = row(0.25);
  EXPECT_NEAR(mixed[4], 0.75, 1e-6);
  EXPECT_NEAR(mixed[5], 0.25, 1e-6);
}

/// The point of the unit cube that OpenEXR says each texel of a cube map shows: linear in a face,
/// so that bilinear filtering gives the point back exactly.
glm::dvec3 point_of_cube(int side, int x, int y) {
  const Imath::Box2i window({0, 0}, {side - 1, 6 * side - 1});
  const auto face = static_cast<Imf::CubeMapFace>(y / side);
  // direction() takes the place within the face: find the place that pixelPosition() maps to (x, y)
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const Imath::V2f in_face(static_cast<float>(i), static_cast<float>(j));
      const Imath::V2f place = Imf::CubeMap::pixelPosition(face, window, in_face);
      if (place != Imath::V2f(static_cast<float>(x), static_cast<float>(y))) continue;
      const Imath::V3f d = Imf::CubeMap::direction(face, window, in_face);
      const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      return glm::dvec3(d.x, d.y, d.z) / largest;
    }
  }
  ADD_FAILURE() << "no place in the face for " << x << ' ' << y;
  return {};
}

TEST(Environment, CubesAreThoseOfOpenExr) {
  const int side = 7;
  const auto path =
      write_picture({side, 6 * side}, [&](int x, int y) { return point_of_cube(side, x, y); });
  const LoadedTexture map = load_environment(path, 0);
  const Size size{4 * side, 2 * side};
  ASSERT_EQ(size_of(map), size);
  const glm::dvec3 up(0, 0, 1);
  const PlaneAxes axes = plane_axes(up);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 p = glm::normalize(texel(map, x, y));
      // The file's Y is up, its Z along the plane's x; right-handed, so its X along the plane's y.
      const glm::dvec3 seen = p.y * up + p.z * axes.x + p.x * axes.y;
      EXPECT_LT(glm::distance(seen, direction_of(up, size, x, y)), 1e-5) << x << ' ' << y;
    }
  }
}

TEST(Environment, CubesTurnLikeLatLongMaps) {
  const int side = 5;
  const auto path =
      write_picture({side, 6 * side}, [&](int x, int y) { return point_of_cube(side, x, y); },
                    {.envmap = std::string(1, '\1')});
  const LoadedTexture still = load_environment(path, 0);
  const LoadedTexture turned = load_environment(path, 0.5 * std::numbers::pi);
  for (int y = 0; y < 2 * side; ++y) {
    for (int x = 0; x < 4 * side; ++x) {
      const glm::dvec3 moved = texel(turned, (x + side) % (4 * side), y);
      EXPECT_LT(glm::distance(texel(still, x, y), moved), 1e-5);
    }
  }
}

TEST(Environment, TheSmallestOnes) {
  const LoadedTexture cube =
      load_environment(write_picture({1, 6}, [](int, int y) { return glm::dvec3(y); }), 0);
  ASSERT_EQ(size_of(cube), (Size{4, 2}));
  for (int x = 0; x < 4; ++x) {
    // The direction 45 degrees up and 45 aside just falls into the top face. +Y is face 2, -Y 3.
    EXPECT_EQ(texel(cube, x, 0).x, 2);
    EXPECT_EQ(texel(cube, x, 1).x, 3);
  }
  const LoadedTexture flat = load_environment(write_picture({2, 1}, own_place), 0);
  EXPECT_EQ(texel(flat, 0, 0).x, 1);
  EXPECT_EQ(texel(flat, 1, 0).x, 0);
}

TEST(Environment, WindowsMayLieAnywhereAndValuesAreFinite) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const auto path = write_picture(
      {4, 2}, [&](int x, int) { return glm::dvec3(x == 0 ? nan : 5, x == 1 ? -inf : 6, -7); },
      {.envmap = std::string(1, '\0'), .corner = {-3, 11}});
  const LoadedTexture map = load_environment(path, 0);
  EXPECT_EQ(map.texture.channels[0].window, (Rect{0, 0, 4, 2}));
  EXPECT_EQ(texel(map, 3, 0), glm::dvec3(0, 6, -7));
  EXPECT_EQ(texel(map, 2, 0), glm::dvec3(5, 0, -7));
  EXPECT_EQ(texel(map, 0, 1), glm::dvec3(5, 6, -7));
}

/// Red of Rec. ITU-R BT.2020-2 in the primaries of BT.709, by the matrix of ITU-R BT.2087-0.
TEST(Environment, LightBecomesOfThePrimariesThatAreAskedFor) {
  constexpr Primaries kRec2020{{.708, .292}, {.170, .797}, {.131, .046}, {.3127, .3290}};
  const auto red = [](int, int) { return glm::dvec3(1, 0, 0); };
  const fs::path path = write_picture({4, 2}, red, {.primaries = kRec2020});
  const glm::dvec3 converted = texel(load_environment(path, 0), 1, 1);
  EXPECT_NEAR(converted.x, 1.6605, 5e-5);
  EXPECT_NEAR(converted.y, -0.1246, 5e-5);
  EXPECT_NEAR(converted.z, -0.0182, 5e-5);
  EXPECT_EQ(texel(load_environment(path, 0, kRec2020), 1, 1), glm::dvec3(1, 0, 0));
  const fs::path silent = write_picture({4, 2}, red);
  EXPECT_EQ(texel(load_environment(silent, 0, kRec2020), 1, 1), glm::dvec3(1, 0, 0));
}

TEST(Environment, OtherFormatsAreReadAsWell) {
  Plane gray(Rect{0, 0, 4, 2});
  gray.view().at(1, 1) = 1;
  const fs::path path = own_folder() / "sky.png";
  write_image8(path, {gray.view(), gray.view(), gray.view()});
  const LoadedTexture map = load_environment(path, 0);
  EXPECT_EQ(texel(map, 2, 1), glm::dvec3(1));
  EXPECT_EQ(texel(map, 1, 1), glm::dvec3(0));
}

TEST(Environment, RefusesOtherShapesAndWhatContradictsItself) {
  const auto refusal = [](Size size, const Written& how, const Limits& limits = {}) {
    const fs::path path = write_picture(size, own_place, how);
    const std::string sentence = error_of([&] { load_environment(path, 0, kRec709, limits); });
    EXPECT_THAT(sentence, StartsWith(path.string() + ": "));
    return sentence;
  };
  const char* expected =
      "expected a lat-long map, twice as wide as high, or the six faces of a cube, one below the "
      "other";
  EXPECT_THAT(refusal({8, 5}, {}), EndsWith(std::string("8x5 pixels: ") + expected));
  EXPECT_THAT(refusal({6, 1}, {}), EndsWith(expected));
  EXPECT_THAT(refusal({8, 4}, {.envmap = std::string(1, '\1')}),
              EndsWith(std::string("the attribute envmap says cube and 8x4 pixels: ") + expected));
  EXPECT_THAT(refusal({2, 12}, {.envmap = std::string(1, '\0')}),
              HasSubstr("the attribute envmap says lat-long and 2x12 pixels"));
  EXPECT_THAT(refusal({8, 4}, {.channels = {"R", "G"}}),
              EndsWith("an environment needs the channels R, G and B"));
  EXPECT_THAT(refusal({10, 60}, {}, {.max_pixels = 600}),
              EndsWith("becomes a lat-long map of 40x20 pixels, more than the limit"));
  EXPECT_THAT(refusal({30, 180}, {}, {.max_memory = 12 * 6000}), EndsWith("more than the limit"));
  EXPECT_THAT(refusal({40, 20}, {}, {.max_pixels = 700}), EndsWith("expected at most 700"));
  EXPECT_THAT(error_of([] { load_environment(own_folder() / "absent.exr", 0); }),
              HasSubstr("absent.exr: cannot be opened"));
}

}  // namespace
}  // namespace limpid
