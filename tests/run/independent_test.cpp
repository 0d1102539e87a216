#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iostream>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "paths.h"
#include "support.h"

// Both runners against the look `realistic` as tests/tools/realistic_numpy.py computes it, from the
// descriptions of the models, not from this code. That script documents the format of the file.

namespace limpid {
namespace {

using test::Buffers;
using test::Picture;

class Fixture {
 public:
  Fixture() : file_(LIMPID_TEST_DATA "/realistic_64x36.bin", std::ios::binary) {
    char magic[8] = {};
    file_.read(magic, sizeof magic);
    if (std::memcmp(magic, "limpid-1", sizeof magic) != 0) throw Error("not a fixture");
    const int width = next<std::int32_t>(), height = next<std::int32_t>();
    size = {width, height};
    plate = Buffers(rect_of(size));
    scene.camera = Camera{matrix(), matrix(), ClipSpace::kGl};
    scene.water = WaterPlane{vector(), 0};
    scene.sun = Sun{};
    scene.sun->direction = vector();
    scene.sun->color = {next<double>(), next<double>(), next<double>()};
    for (const Role& role : roles()) {
      if (role.first > PlaneId::kSurfaceNormalX) break;  // no model of this look reads more
      for (int i = 0; i < role.count; ++i) {
        const PlaneId id = plane_after(role.first, i);
        if (id != PlaneId::kColorA) plate.set(id, [&](int, int) { return next<float>(); });
      }
    }
    for (int i = 0; i < 3 * width * height; ++i) beauty.push_back(next<float>());
    if (!file_) throw Error("the fixture is too short");
    normalise_normals();
  }

  Size size;
  Buffers plate{Rect{}};
  Scene scene;
  std::vector<float> beauty;  ///< all red, all green, all blue

 private:
  template <class T>
  T next() {
    T value{};
    file_.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  }
  glm::dvec3 vector() {
    glm::dvec3 v;
    for (int i = 0; i < 3; ++i) v[i] = next<double>();
    return v;
  }
  glm::dmat4 matrix() {
    glm::dmat4 m;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) m[column][row] = next<double>();
    }
    return m;
  }
  /// The entry of a plate: unit normals, up for zero normals.
  void normalise_normals() {
    std::array<View<const float>, 3> raw;
    for (int c = 0; c < 3; ++c) {
      raw[c] = plate.frame.plane(plane_after(PlaneId::kSurfaceNormalX, c));
    }
    std::vector<std::array<float, 3>> unit;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const Vec3<double> up{scene.water->up.x, scene.water->up.y, scene.water->up.z};
        const Vec3<double> n =
            normalize_or<double>({raw[0].at(x, y), raw[1].at(x, y), raw[2].at(x, y)}, up);
        unit.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
      }
    }
    for (int c = 0; c < 3; ++c) {
      plate.set(plane_after(PlaneId::kSurfaceNormalX, c), [&](int x, int y) {
        return unit[static_cast<std::size_t>(y * size.width + x)][static_cast<std::size_t>(c)];
      });
    }
  }

  std::ifstream file_;
};

Look realistic_look() {
  Look look;
  look.water.edges = Water::Edges::kHard;
  look.of<Caustics>() = {.strength = 0, .sunlight = Caustics::Sunlight::kStraight};
  look.of<Refraction>() = {Refraction::Model::kNormalOffset, 0.03, Refraction::Rejection::kSnap, 0,
                           Refraction::OffFrame::kClamp};
  look.of<PrismSplit>() = {PrismSplit::Model::kAxis, 0.004};
  look.of<DepthFog>() = {
      DepthFog::Model::kLinear, DepthFog::Distance::kEye, 0.15, 0, {0.02, 0.10, 0.12}, 0.9};
  look.of<WaterShadow>() = {WaterShadow::Model::kDarken, 0.5};
  FresnelReflection::Params& mirror = look.of<FresnelReflection>();
  mirror.reflectance = FresnelReflection::Reflectance::kRim;
  mirror.power = 3;
  mirror.lookup = FresnelReflection::Lookup::kOffset;
  mirror.strength = 0.02;
  look.of<SunHighlight>() = {SunHighlight::Model::kBlinnPhong, 200, 1};
  return look;
}

struct Differences {
  double max = 0, mean = 0;
  std::vector<double> by_pixel;  ///< largest of the three channels

  double share_within(double tolerance) const {
    const auto inside = [=](double d) { return d <= tolerance; };
    return static_cast<double>(std::ranges::count_if(by_pixel, inside)) /
           static_cast<double>(by_pixel.size());
  }
  friend std::ostream& operator<<(std::ostream& out, const Differences& d) {
    return out << "max " << d.max << ", mean " << d.mean;
  }
};

Differences compare(const Fixture& f, const Picture& picture) {
  Differences d;
  const std::size_t pixels = f.beauty.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    const int x = static_cast<int>(i) % f.size.width, y = static_cast<int>(i) / f.size.width;
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = std::abs(picture.target.color[c].at(x, y) - f.beauty[c * pixels + i]);
      worst = std::max(worst, off);
      d.mean += off / static_cast<double>(f.beauty.size());
    }
    d.by_pixel.push_back(worst);
    d.max = std::max(d.max, worst);
  }
  return d;
}

TEST(Independent, TheFixtureExercisesEveryPartOfTheLook) {
  const Fixture f;
  const Picture all = test::reference(realistic_look(), f.plate.frame, f.scene);
  int wet = 0, snapped = 0, bottomless = 0, glint = 0;
  for (int y = 0; y < f.size.height; ++y) {
    for (int x = 0; x < f.size.width; ++x) {
      if (std::isinf(all.aov(Aov::kSurfaceDepth, x, y))) continue;
      ++wet;
      snapped += all.aov(Aov::kConfidence, x, y) == 0;
      bottomless += std::isinf(all.aov(Aov::kPath, x, y));
      glint += all.aov(Aov::kHighlight, x, y) > 0.01;
    }
  }
  EXPECT_GT(wet, 1500);
  EXPECT_LT(wet, 2200);
  EXPECT_GT(snapped, 20);
  EXPECT_GT(bottomless, 20);
  EXPECT_GT(glint, 20);
}

TEST(Independent, ReferenceAgrees) {
  const Fixture f;
  const Differences d = compare(f, test::reference(realistic_look(), f.plate.frame, f.scene));
  EXPECT_GE(d.share_within(1e-5), 0.999) << d;
  RecordProperty("max", std::to_string(d.max));
  std::cout << "reference against numpy: " << d << "\n";
}

TEST(Independent, FusedAgreesOnEveryInstructionSet) {
  const Fixture f;
  for (const std::string& simd : simd_targets()) {
    const Differences d =
        compare(f, test::fused(realistic_look(), f.plate.frame, f.scene, {.simd = simd}));
    EXPECT_LT(d.mean, 2e-6) << simd << ": " << d;
    EXPECT_GE(d.share_within(3e-4), 0.9999) << simd << ": " << d;
    std::cout << simd << " against numpy: " << d << "\n";
  }
}

}  // namespace
}  // namespace limpid
