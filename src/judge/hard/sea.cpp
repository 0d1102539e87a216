#include "judge/hard/sea.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace limpid {
namespace {

constexpr long double kDegree = std::numbers::pi_v<long double> / 180;

/// Without a plane of the surface, its depth is over / under: three roundings each, and one of the
/// quotient.
constexpr double kSurfaceRoundings = 7;
/// A height over the water is a sum of three numbers, each the product of a few rounded ones; the
/// heights of bottom and surface have 24 and 6 roundings.
constexpr double kHeightRoundings = 30;
/// Later roundings: the two cosines, the quotient.
constexpr double kPathRoundings = 10;
/// The slope of the reflectance over the cosine is at most 6.3, at grazing angles; the cosine has 6
/// roundings (to_viewer, its dot product), the formula 8.
constexpr double kReflectanceRoundings = 6.3 * 6 + 8;

long double sea_bound(const Sea& sea, const Sea::Pixel& p, SeaError what, long double ior) {
  switch (what) {
    case SeaError::kSurface:
      return kSurfaceRoundings * kRounding * p.surface;
    case SeaError::kReflectance:
      return kReflectanceRoundings * kRounding;
    case SeaError::kPath:
      break;
  }
  const long double refracted = refracted_cosine_of(p.cosine, ior);
  // In a turned world, heights are sums of coordinates as large as the distance from the eye.
  const long double summed =
      sea.height + sea.depth + sea.orthographic + (sea.turned ? p.bottom * p.length : 0);
  return kRounding * (kHeightRoundings * summed + kPathRoundings * sea.depth) / refracted;
}

}  // namespace

Sea::Pixel Sea::at(int x, int y) const {
  using Real = long double;
  const Real aspect = Real(size.width) / size.height * pixel_aspect;
  const Real half = orthographic > 0 ? orthographic / Real(2) : std::tan(fov * kDegree / 2);
  const Real across = (2 * (x + Real(0.5)) / size.width - 1 - shift.x) * aspect * half;
  const Real upwards = (1 - 2 * (y + Real(0.5)) / size.height - shift.y) * half;
  const Real sine = std::sin(down * kDegree), cosine = std::cos(down * kDegree);
  Real over = height, ray = -sine;
  Pixel p;
  if (orthographic > 0) {
    over += upwards * cosine;
    p.length = 1;
  } else {
    ray += upwards * cosine;
    p.length = std::sqrt(1 + across * across + upwards * upwards);
  }
  p.water = over > 0 && ray < 0;
  p.surface = over / -ray;
  p.bottom = (over + depth) / -ray;
  p.cosine = -ray / p.length;
  p.fall = -ray;
  p.forward = cosine + (orthographic > 0 ? 0 : upwards * sine);
  return p;
}

glm::dmat3 Sea::turn() const {
  if (!turned) return glm::dmat3(1.0);
  // About x by 40 degrees, then about z by 25.
  const double a = 40 * std::numbers::pi / 180, b = 25 * std::numbers::pi / 180;
  const glm::dmat3 first(1, 0, 0, 0, std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a));
  const glm::dmat3 second(std::cos(b), std::sin(b), 0, -std::sin(b), std::cos(b), 0, 0, 0, 1);
  return second * first;
}

Scene Sea::scene() const {
  const double angle = down * std::numbers::pi / 180;
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const glm::dmat3 world = turn();
  const glm::dvec3 right = world * glm::dvec3(1, 0, 0);
  const glm::dvec3 upwards = world * glm::dvec3(0, cosine, -sine);
  const glm::dvec3 back = world * glm::dvec3(0, sine, cosine);
  const glm::dvec3 eye = world * glm::dvec3(0, height, 0);
  const glm::dmat3 rows = glm::transpose(glm::dmat3(right, upwards, back));
  Camera camera;
  camera.view = glm::dmat4(rows);
  camera.view[3] = glm::dvec4(-(rows * eye), 1);
  camera.clip = clip;
  const double aspect = double(size.width) / size.height * pixel_aspect;
  camera.projection =
      orthographic > 0 ? limpid::orthographic(orthographic * aspect, orthographic, near, far, clip)
                       : perspective(fov * std::numbers::pi / 180, aspect, near, far, clip, shift);
  Scene scene;
  scene.camera = camera;
  scene.water = WaterPlane{up(), 0, {}};
  scene.sun = Sun{world * glm::dvec3(0.48, 0.6, 0.64), {3, 2.5, 2}};
  return scene;
}

HardFrame Sea::frame(bool with_surface) const {
  constexpr float kSky = std::numeric_limits<float>::infinity();
  HardFrame frame(rect_of(size));
  for (int c = 0; c < 3; ++c) {
    const auto ramp = [&](int x, int y) {
      return 0.2 + 0.1 * c + 0.4 * x / size.width + 0.2 * y / size.height;
    };
    frame.set(plane_after(PlaneId::kColorR, c), ramp);
    frame.set(plane_after(PlaneId::kReflectionR, c),
              [&](int x, int y) { return 1.2 - ramp(x, y); });
  }
  frame.fill(PlaneId::kColorA, 1);
  frame.fill(PlaneId::kShadow, 1);
  frame.set(PlaneId::kDepth, [&](int x, int y) -> long double {
    const Pixel p = at(x, y);
    return p.water ? p.bottom : kSky;
  });
  if (with_surface) {
    frame.set(PlaneId::kSurfaceDepth, [&](int x, int y) -> long double {
      const Pixel p = at(x, y);
      return p.water ? p.surface : kSky;
    });
  }
  return frame;
}

Worst sea_error(const HardWorld& world, const Sea& sea, SeaError what) {
  Worst worst;
  const Look look = calm_look(world);
  const long double ior = look.water.ior;
  const HardFrame frame = sea.frame(what == SeaError::kPath);
  for (const std::string& runner : world.runners()) {
    const HardPicture picture = world.run(runner, look, frame, sea.scene());
    for (int y = 0; y < sea.size.height; ++y) {
      for (int x = 0; x < sea.size.width; ++x) {
        const auto where = [&] { return place_text(runner, look.name, x, y); };
        const Sea::Pixel p = sea.at(x, y);
        if (picture.wet(x, y) != p.water) worst.add(HUGE_VAL, where);
        if (!p.water) continue;
        const auto error = [&]() -> long double {
          switch (what) {
            case SeaError::kSurface:
              return picture.aov(Aov::kSurfaceDepth, x, y) - p.surface;
            case SeaError::kPath:
              return picture.aov(Aov::kPath, x, y) - sea.depth / refracted_cosine_of(p.cosine, ior);
            case SeaError::kReflectance:
              return picture.aov(Aov::kFresnel, x, y) - reflectance_of(p.cosine, ior);
          }
          return HUGE_VAL;
        };
        worst.add(double(std::abs(error()) / sea_bound(sea, p, what, ior)), where);
      }
    }
  }
  return worst;
}

long double refracted_cosine_of(long double cosine, long double ior) {
  return std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
}

long double reflectance_of(long double cosine, long double ior) {
  const long double inside = refracted_cosine_of(cosine, ior);
  const long double s = (cosine - ior * inside) / (cosine + ior * inside);
  const long double p = (ior * cosine - inside) / (ior * cosine + inside);
  return (s * s + p * p) / 2;
}

}  // namespace limpid
