#include "limpid/raster/render_plate.h"

#include <cmath>
#include <cstring>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/optics/waves.h"

namespace limpid {
namespace {

constexpr Size kSize{97, 61};

/// A quad by its corner and two edges, counter-clockwise seen from edge_u x edge_v.
Mesh quad(glm::vec3 corner, glm::vec3 edge_u, glm::vec3 edge_v, int cells, int material) {
  Mesh mesh;
  mesh.material = material;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const float u = float(i) / float(cells), v = float(j) / float(cells);
      mesh.positions.push_back(corner + u * edge_u + v * edge_v);
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      for (auto k :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)}) {
        mesh.indices.push_back(k);
      }
    }
  }
  return mesh;
}

/// A floor at y = -1, a wall at z = -6 from -1 to 3, a roof-like slab over the water, and the
/// water.
Model basin() {
  Model model;
  for (Rgb<double> color : {Rgb<double>{0.8, 0.6, 0.3}, {0.2, 0.4, 0.9}, {0.9, 0.1, 0.1}}) {
    Material m;
    m.shading = Shading::kLambert;
    m.base_color = color;
    m.double_sided = true;
    model.materials.push_back(m);
  }
  model.meshes.push_back(quad({-8, -1, 4}, {16, 0, 0}, {0, 0, -12}, 4, 0));
  model.meshes.push_back(quad({-5, -1, -6}, {10, 0, 0}, {0, 4, 0}, 4, 1));
  model.meshes.push_back(quad({-1, 1, -2}, {2, 0, 0}, {0, 0.3f, -1}, 1, 2));
  model.meshes.push_back(quad({-8, 0, 4}, {16, 0, 0}, {0, 0, -12}, 60, 0));
  for (int i = 0; i < 4; ++i) model.instances.push_back({i, glm::dmat4(1.0), i == 3});
  model.background = {0.3, 0.5, 0.8};
  return model;
}

Scene over_basin() {
  Scene scene;
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(0.5, 2, 3), glm::dvec3(0, 0.3, -3), glm::dvec3(0, 1, 0));
  camera.projection =
      perspective(0.9, double(kSize.width) / kSize.height, 0.1, 100, ClipSpace::kGl);
  scene.camera = camera;
  scene.water = WaterPlane{};
  scene.sun = Sun{glm::normalize(glm::dvec3(0.3, 1, 0.4)), {2, 2, 2}};
  return scene;
}

const PlaneSet kEverything =
    kColorPlanes | kReflectionPlanes | kSurfaceNormalPlanes |
    PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kShadow, PlaneId::kSurfaceDepth};

RenderedPlate render_basin(const Scene& scene, PlaneSet wanted = kEverything, bool extras = true,
                           int overscan = 0, int threads = 1) {
  return render_plate(basin(), scene, {.size = kSize, .overscan = overscan}, wanted, extras,
                      *make_executor(threads));
}

TEST(RenderPlate, DepthIsThatOfThePlanes) {
  const Scene scene = over_basin();
  const RenderedPlate plate = render_basin(scene);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  const glm::dvec3 eye = scene.camera->eye();
  int floor_pixels = 0, water_pixels = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
      const double depth = plate.frame.plane(PlaneId::kDepth).at(x, y);
      const double floor = (-1 - eye.y) / ray.y;
      if (std::abs(depth - floor) < 1e-5 * depth) ++floor_pixels;
      const double water = plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y);
      if (std::isfinite(water)) {
        EXPECT_NEAR(water, -eye.y / ray.y, 1e-5 * water);
        ++water_pixels;
      }
    }
  }
  EXPECT_GT(floor_pixels, 500);
  EXPECT_GT(water_pixels, 1000);
}

TEST(RenderPlate, ReflectionOfAFlatMirrorIsTheSceneUpsideDown) {
  const Scene scene = over_basin();
  const RenderedPlate plate = render_basin(scene);
  // The world turned over at the water, seen by the same camera through a plane that keeps what was
  // above.
  Model turned = basin();
  for (Mesh& mesh : turned.meshes) {
    for (glm::vec3& p : mesh.positions) p.y = -p.y;
  }
  for (std::size_t i = 0; i < 2;
       ++i) {  // nothing of the pool itself is above the water but the wall
    for (glm::vec3& p : turned.meshes[i].positions) p.y = std::min(p.y, 0.0f);
  }
  turned.instances.erase(turned.instances.begin());
  Scene under = scene;
  under.sun->direction.y = -under.sun->direction.y;
  under.water =
      WaterPlane{{0, 1, 0}, -50};  // far below: it cuts nothing, and the sun must be above it
  under.sun->direction = scene.sun->direction;
  const RenderedPlate image = render_plate(turned, under, {.size = kSize},
                                           PlaneSet{PlaneId::kDepth}, false, *make_executor(1));
  int same = 0, checked = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (!std::isfinite(plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y))) continue;
      const float mirrored =
          plate.extras[static_cast<std::size_t>(ExtraPlane::kReflectionDepth)].view().at(x, y);
      const float expected = image.frame.plane(PlaneId::kDepth).at(x, y);
      ++checked;
      same += mirrored == expected || std::abs(mirrored - expected) < 1e-4f * expected;
    }
  }
  EXPECT_GT(checked, 1000);
  EXPECT_GE(same, checked - checked / 100);  // edges may fall to either side of a pixel's centre
}

TEST(RenderPlate, WavesMoveTheSurfaceAndGiveItsTrueNormals) {
  Scene scene = over_basin();
  scene.water->waves = {{0.05, 1.1, 0.7, 0.3, 2}};
  scene.time = 0.4;
  const RenderedPlate plate = render_basin(scene);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  const PlaneAxes axes = plane_axes(scene.water->up);
  int checked = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double depth = plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y);
      if (!std::isfinite(depth)) continue;
      const glm::dvec3 p = scene.camera->eye() + depth * rays.ray_at(x + 0.5, y + 0.5);
      const WaveHeight wave =
          wave_height(scene.water->waves, glm::dot(p, axes.x), glm::dot(p, axes.y), scene.time);
      EXPECT_NEAR(p.y, wave.height, 0.002);  // the mesh is flat between its vertices
      const glm::dvec3 n =
          glm::normalize(scene.water->up - wave.slope_x * axes.x - wave.slope_y * axes.y);
      for (int c = 0; c < 3; ++c) {
        const PlaneId id = plane_after(PlaneId::kSurfaceNormalX, c);
        EXPECT_NEAR(plate.frame.plane(id).at(x, y), n[c], 0.01);
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
}

TEST(RenderPlate, NormalsPointOutOfTheWaterWhicheverWayItIsWound) {
  Model turned = basin();
  std::vector<std::uint32_t>& indices = turned.meshes[3].indices;
  for (std::size_t t = 0; t < indices.size(); t += 3) std::swap(indices[t], indices[t + 1]);
  const RenderedPlate plate =
      render_plate(turned, over_basin(), {.size = kSize}, kEverything, false, *make_executor(1));
  int wet = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (!std::isfinite(plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y))) continue;
      EXPECT_NEAR(plate.frame.plane(PlaneId::kSurfaceNormalY).at(x, y), 1, 1e-6);
      ++wet;
    }
  }
  EXPECT_GT(wet, 1000);
}

TEST(RenderPlate, BelowHoldsOnlyWhatIsUnderTheWater) {
  const Scene scene = over_basin();
  const RenderedPlate plate = render_basin(scene);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  int found = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double depth =
          plate.extras[static_cast<std::size_t>(ExtraPlane::kBelowDepth)].view().at(x, y);
      if (!std::isfinite(depth)) continue;
      const glm::dvec3 p = scene.camera->eye() + depth * rays.ray_at(x + 0.5, y + 0.5);
      EXPECT_LT(p.y, 1e-4);
      ++found;
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(RenderPlate, DrawsOnlyWhatIsWanted) {
  const PlaneSet wanted = kColorPlanes | PlaneSet{PlaneId::kDepth};
  const RenderedPlate plate = render_basin(over_basin(), wanted, false);
  EXPECT_EQ(plate.frame.present(), wanted);
  for (const Plane& extra : plate.extras) EXPECT_FALSE(extra);
}

TEST(RenderPlate, OverscanContinuesThePicture) {
  const RenderedPlate tight = render_basin(over_basin());
  const RenderedPlate wide = render_basin(over_basin(), kEverything, true, 9);
  EXPECT_EQ(wide.frame.plane(PlaneId::kDepth).window,
            (Rect{-9, -9, kSize.width + 9, kSize.height + 9}));
  EXPECT_EQ(wide.frame.work(), rect_of(kSize));
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      EXPECT_EQ(tight.frame.plane(PlaneId::kDepth).at(x, y),
                wide.frame.plane(PlaneId::kDepth).at(x, y));
    }
  }
}

TEST(RenderPlate, SameBitsForAnyThreadCount) {
  const RenderedPlate one = render_basin(over_basin()),
                      two = render_basin(over_basin(), kEverything, true, 0, 2);
  for (int i = 0; i < kPlaneCount; ++i) {
    const View<const float>&a = one.frame.planes[i], &b = two.frame.planes[i];
    ASSERT_EQ(static_cast<bool>(a), static_cast<bool>(b));
    if (!a) continue;
    for (int y = 0; y < kSize.height; ++y) {
      EXPECT_EQ(std::memcmp(a.row(y), b.row(y), sizeof(float) * kSize.width), 0);
    }
  }
}

TEST(RenderPlate, RefusesScenesThatMeanNothing) {
  const auto refused = [](const Scene& scene, RenderOptions options, const char* why) {
    try {
      render_plate(basin(), scene, options, kEverything, false, *make_executor(1));
      ADD_FAILURE() << "accepted: " << why;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  const Scene good = over_basin();
  Scene scene = good;
  scene.camera.reset();
  refused(scene, {.size = kSize}, "no camera");
  scene = good;
  scene.water.reset();
  refused(scene, {.size = kSize}, "no water");
  scene = good;
  scene.water->height = 2;
  refused(scene, {.size = kSize}, "water");
  scene.water->height = 2.5;
  refused(scene, {.size = kSize}, "in the water");
  scene = good;
  scene.water->waves = {{2.5, 1, 0, 0, 0}};
  refused(scene, {.size = kSize}, "below its highest crest");
  refused(good, {.size = kSize, .overscan = 2147483640}, "overscan 2147483640");
  scene = good;
  scene.sun->direction = {0, -1, 0};
  refused(scene, {.size = kSize}, "below the horizon");
  refused(good, {.size = {0, 5}}, "size 0x5");
  refused(good, {.size = {40000, 5}}, "size 40000x5");
  refused(good, {.size = {32000, 32000}}, "1024000000 pixels");
  refused(good, {.size = kSize, .overscan = -1}, "overscan -1");
}

}  // namespace
}  // namespace limpid
