#include "limpid/raster/render_plate.h"

#include <cmath>
#include <cstring>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "optics/waves.h"

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

const PlaneSet kMirror =
    kReflectionPlanes | PlaneSet{PlaneId::kReflectionValid, PlaneId::kReflectionDepth};
const PlaneSet kEverything = kColorPlanes | kMirror | kBelowPlanes | kSurfaceNormalPlanes |
                             kSunColorPlanes |
                             PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kShadow,
                                      PlaneId::kSurfaceDepth, PlaneId::kSurfaceShadow};

RenderedPlate render_basin(const Scene& scene, PlaneSet wanted = kEverything, int overscan = 0,
                           int threads = 1) {
  return render_plate(basin(), scene, {.size = kSize, .overscan = overscan}, wanted,
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

/// The basin with a wall in its middle, from below the water to above the water.
Model basin_with_wall(AlphaMode mode, double alpha) {
  Model model = basin();
  model.meshes.push_back(quad({-3, -0.8f, -3}, {6, 0, 0}, {0, 2, 0}, 4, 3));
  model.materials.push_back(model.materials[0]);
  model.materials[3].alpha_mode = mode;
  model.materials[3].alpha = alpha;
  model.instances.push_back({4, glm::dmat4(1.0), false});
  return model;
}

RenderedPlate every_plane(const Model& model) {
  return render_plate(model, over_basin(), {.size = kSize}, kEverything, *make_executor(1));
}

int different_pixels(const RenderedPlate& a, const RenderedPlate& b, PlaneId id) {
  int different = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      different += a.frame.plane(id).at(x, y) != b.frame.plane(id).at(x, y);
    }
  }
  return different;
}

TEST(RenderPlate, WhatIsMaskedAwayIsInNoPlane) {
  const RenderedPlate without = every_plane(basin());
  const RenderedPlate masked = every_plane(basin_with_wall(AlphaMode::kMask, 0.4));
  const RenderedPlate there = every_plane(basin_with_wall(AlphaMode::kMask, 0.6));
  for (int i = 0; i < kPlaneCount; ++i) {
    const PlaneId id = static_cast<PlaneId>(i);
    if (!without.frame.plane(id)) continue;
    EXPECT_EQ(different_pixels(masked, without, id), 0) << i;
  }
  for (const PlaneId id : {PlaneId::kColorR, PlaneId::kDepth, PlaneId::kShadow, PlaneId::kBelowR,
                           PlaneId::kBelowDepth, PlaneId::kReflectionR, PlaneId::kReflectionDepth,
                           PlaneId::kSurfaceShadow, PlaneId::kSunColorR}) {
    EXPECT_GT(different_pixels(there, without, id), 50) << index_of(id);
  }
}

TEST(RenderPlate, WhatIsBlendedIsInAllColorsAndByItsOpacityInTheRest) {
  const RenderedPlate without = every_plane(basin());
  const RenderedPlate opaque = every_plane(basin_with_wall(AlphaMode::kOpaque, 1));
  const RenderedPlate thin = every_plane(basin_with_wall(AlphaMode::kBlend, 0.49));
  const RenderedPlate thick = every_plane(basin_with_wall(AlphaMode::kBlend, 0.51));
  for (int i = 0; i < kPlaneCount; ++i) {
    const PlaneId id = static_cast<PlaneId>(i);
    if (!without.frame.plane(id)) continue;
    const bool color =
        (kColorPlanes | kReflectionPlanes | kBelowPlanes | kSunColorPlanes).has(id) &&
        id != PlaneId::kBelowDepth;
    if (color) {
      EXPECT_GT(different_pixels(thin, without, id), 50) << i;
      EXPECT_GT(different_pixels(thick, opaque, id), 50) << i;
    } else {
      EXPECT_EQ(different_pixels(thin, without, id), 0) << i;
      EXPECT_EQ(different_pixels(thick, opaque, id), 0) << i;
    }
  }
}

TEST(RenderPlate, ReflectionOfAFlatMirrorIsTheSceneUpsideDown) {
  const Scene scene = over_basin();
  const RenderedPlate plate = render_basin(scene);
  // The world turned over at the water, seen by the same camera through a plane that keeps the part
  // that was above.
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
      WaterPlane{{0, 1, 0}, -50};  // far below: the plane cuts nothing; the sun must stand above it
  under.sun->direction = scene.sun->direction;
  const RenderedPlate image =
      render_plate(turned, under, {.size = kSize}, PlaneSet{PlaneId::kDepth}, *make_executor(1));
  int same = 0, checked = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (!std::isfinite(plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y))) continue;
      const float mirrored = plate.frame.plane(PlaneId::kReflectionDepth).at(x, y);
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
      EXPECT_NEAR(p.y, wave.height, 2e-5);
      const glm::dvec3 n =
          glm::normalize(scene.water->up - wave.slope_x * axes.x - wave.slope_y * axes.y);
      for (int c = 0; c < 3; ++c) {
        const PlaneId id = plane_after(PlaneId::kSurfaceNormalX, c);
        EXPECT_NEAR(plate.frame.plane(id).at(x, y), n[c], 1e-5);
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
}

/// Two triangles suffice for waves; a mesh over the calm plane's waves stays where it is.
TEST(RenderPlate, WavesAreThoseOfTheSceneOnAnyMesh) {
  Scene scene = over_basin();
  scene.water->waves = {{0.05, 1.1, 0.7, 0.3, 2}, {0.01, -9, 4, 1.3, 3}};
  const auto with_water = [&](float height, int cells) {
    Model model = basin();
    model.meshes[3] = quad({-8, height, 4}, {16, 0, 0}, {0, 0, -12}, cells, 0);
    return render_plate(model, scene, {.size = kSize}, kEverything, *make_executor(1));
  };
  const RenderedPlate fine = with_water(0, 60), coarse = with_water(0, 1), high = with_water(1, 60);
  const auto depth_of = [](const RenderedPlate& plate, int x, int y) {
    return plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y);
  };
  int wet = 0, over = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const float at = depth_of(fine, x, y);
      if (!std::isfinite(at) || !std::isfinite(depth_of(coarse, x, y))) continue;
      ++wet;
      over += depth_of(high, x, y) < 0.7f * at;
      EXPECT_EQ(depth_of(coarse, x, y), at);
      for (int c = 0; c < 3; ++c) {
        const PlaneId id = plane_after(PlaneId::kSurfaceNormalX, c);
        EXPECT_EQ(coarse.frame.plane(id).at(x, y), fine.frame.plane(id).at(x, y));
      }
    }
  }
  EXPECT_GT(wet, 1000);
  EXPECT_GT(over, wet / 2);
}

TEST(RenderPlate, NormalsPointOutOfTheWaterWhicheverWayItIsWound) {
  Model turned = basin();
  std::vector<std::uint32_t>& indices = turned.meshes[3].indices;
  for (std::size_t t = 0; t < indices.size(); t += 3) std::swap(indices[t], indices[t + 1]);
  const RenderedPlate plate =
      render_plate(turned, over_basin(), {.size = kSize}, kEverything, *make_executor(1));
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
      const double depth = plate.frame.plane(PlaneId::kBelowDepth).at(x, y);
      if (!std::isfinite(depth)) continue;
      const glm::dvec3 p = scene.camera->eye() + depth * rays.ray_at(x + 0.5, y + 0.5);
      EXPECT_LT(p.y, 1e-4);
      ++found;
    }
  }
  EXPECT_GT(found, 1000);
}

/// A step in the basin, above calm water and within reach of waves of 2.5 cm.
TEST(RenderPlate, BelowReachesTheCrestsOfWaves) {
  Model model = basin();
  model.meshes.push_back(quad({-1, 0.02f, -1}, {2, 0, 0}, {0, 0, -2}, 1, 0));
  model.instances.push_back({4, glm::dmat4(1.0), false});
  Scene scene = over_basin();
  const PlaneSet wanted = kBelowPlanes | PlaneSet{PlaneId::kDepth};
  const auto render = [&](double amplitude) {
    scene.water->waves = {{amplitude, 1.1, 0.7, 0.3, 2}};
    return render_plate(model, scene, {.size = kSize}, wanted, *make_executor(1));
  };
  const RenderedPlate low = render(0.01), high = render(0.025);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  int step = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const float seen = low.frame.plane(PlaneId::kDepth).at(x, y);
      const double height = (scene.camera->eye() + double(seen) * rays.ray_at(x + 0.5, y + 0.5)).y;
      if (std::abs(height - 0.02) > 1e-4) continue;
      ++step;
      EXPECT_GT(low.frame.plane(PlaneId::kBelowDepth).at(x, y), seen) << x << ", " << y;
      EXPECT_EQ(high.frame.plane(PlaneId::kBelowDepth).at(x, y), seen) << x << ", " << y;
    }
  }
  EXPECT_GT(step, 30);
}

TEST(RenderPlate, DrawsOnlyWhatIsWanted) {
  const RenderedPlate all = render_basin(over_basin());
  EXPECT_EQ(all.frame.present(), kEverything);
  for (const Role& role : roles()) {
    if (!kEverything.covers(role.planes())) continue;  // other programs make these planes
    const RenderedPlate plate = render_basin(over_basin(), role.planes());
    ASSERT_EQ(plate.frame.present(), role.planes()) << role.name;
    for (int i = 0; i < role.count; ++i) {
      const PlaneId id = plane_after(role.first, i);
      for (int y = 0; y < kSize.height; ++y) {
        EXPECT_EQ(std::memcmp(plate.frame.plane(id).row(y), all.frame.plane(id).row(y),
                              sizeof(float) * kSize.width),
                  0)
            << role.name;
      }
    }
  }
}

TEST(RenderPlate, TheSunsShareIsNoMoreThanTheColorAndNoneInShadow) {
  const RenderedPlate plate = every_plane(basin_with_wall(AlphaMode::kOpaque, 1));
  int dark = 0, less = 0, sky = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const bool seen = std::isfinite(plate.frame.plane(PlaneId::kDepth).at(x, y));
      const bool shadow = plate.frame.plane(PlaneId::kShadow).at(x, y) == 0;
      for (int c = 0; c < 3; ++c) {
        const float color = plate.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
        const float sun = plate.frame.plane(plane_after(PlaneId::kSunColorR, c)).at(x, y);
        EXPECT_LE(sun, color);
        if (!seen || shadow) {
          EXPECT_EQ(sun, 0) << x << ", " << y;
          EXPECT_GT(color, 0);
        } else {
          EXPECT_GT(sun, 0) << x << ", " << y;
          EXPECT_LT(sun, color);
        }
      }
      dark += seen && shadow;
      less += seen && !shadow;
      sky += !seen;
    }
  }
  EXPECT_GT(dark, 100);
  EXPECT_GT(less, 1000);
  EXPECT_GT(sky, 100);
}

/// The basin with a glossy wall, in sunlight alone.
Model sunlit_basin(AlphaMode mode) {
  Model model = basin_with_wall(mode, 0.4);
  for (Material& m : model.materials) m.ambient = {0, 0, 0};
  model.materials[3].shading = Shading::kPhong;
  model.materials[3].specular = {0.5, 0.4, 0.3};
  model.materials[2].shading = Shading::kToon;
  model.background = {0, 0, 0};
  return model;
}

TEST(RenderPlate, TheSunsShareIsAllWhereNothingElseShines) {
  for (const AlphaMode mode : {AlphaMode::kOpaque, AlphaMode::kMask, AlphaMode::kBlend}) {
    const RenderedPlate plate = every_plane(sunlit_basin(mode));
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < kSize.height; ++y) {
        EXPECT_EQ(std::memcmp(plate.frame.plane(plane_after(PlaneId::kColorR, c)).row(y),
                              plate.frame.plane(plane_after(PlaneId::kSunColorR, c)).row(y),
                              sizeof(float) * kSize.width),
                  0);
      }
    }
  }
}

TEST(RenderPlate, TheSunsShareHasNothingThatShinesByItself) {
  Model dull = sunlit_basin(AlphaMode::kOpaque), bright = dull;
  for (Model* model : {&dull, &bright}) model->materials[1].shading = Shading::kFlat;
  dull.materials[1].base_color = {0, 0, 0};
  bright.materials[3].emission = {2, 3, 4};
  bright.background = {1, 1, 1};
  const RenderedPlate sun = every_plane(dull), all = every_plane(bright);
  EXPECT_EQ(different_pixels(sun, all, PlaneId::kSunColorR), 0);
  EXPECT_GT(different_pixels(sun, all, PlaneId::kColorR), 500);
}

TEST(RenderPlate, WithoutASunItHasNoShare) {
  Scene scene = over_basin();
  scene.sun.reset();
  EXPECT_FALSE(render_basin(scene).frame.plane(PlaneId::kSunColorR));
  EXPECT_FALSE(renderable(basin(), scene).meets(kSunColorPlanes));
  EXPECT_TRUE(renderable(basin(), over_basin()).covers(kSunColorPlanes));
}

TEST(RenderPlate, OverscanContinuesThePicture) {
  const RenderedPlate tight = render_basin(over_basin());
  const RenderedPlate wide = render_basin(over_basin(), kEverything, 9);
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
                      two = render_basin(over_basin(), kEverything, 0, 2);
  for (int i = 0; i < kPlaneCount; ++i) {
    const View<const float>&a = one.frame.planes[i], &b = two.frame.planes[i];
    ASSERT_EQ(static_cast<bool>(a), static_cast<bool>(b));
    if (!a) continue;
    for (int y = 0; y < kSize.height; ++y) {
      EXPECT_EQ(std::memcmp(a.row(y), b.row(y), sizeof(float) * kSize.width), 0);
    }
  }
}

/// A camera in the water of the basin, which looks up through the water at the slab.
Scene under_water() {
  Scene scene = over_basin();
  scene.camera->view =
      glm::lookAt(glm::dvec3(0.5, -0.6, 1), glm::dvec3(0, 0.5, -2.5), glm::dvec3(0, 1, 0));
  return scene;
}

TEST(RenderPlate, TheSurfaceIsSeenFromBelow) {
  Scene scene = under_water();
  scene.water->waves = {{0.05, 1.1, 0.7, 0.3, 2}};
  const RenderedPlate plate = render_basin(scene);
  EXPECT_EQ(plate.frame.present(), kEverything);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  const PlaneAxes axes = plane_axes(scene.water->up);
  int seen = 0, dry_behind = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double depth = plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y);
      if (!std::isfinite(depth)) continue;
      const glm::dvec3 p = scene.camera->eye() + depth * rays.ray_at(x + 0.5, y + 0.5);
      const WaveHeight wave =
          wave_height(scene.water->waves, glm::dot(p, axes.x), glm::dot(p, axes.y), scene.time);
      EXPECT_NEAR(p.y, wave.height, 2e-5);
      const glm::dvec3 n =
          glm::normalize(scene.water->up - wave.slope_x * axes.x - wave.slope_y * axes.y);
      for (int c = 0; c < 3; ++c) {
        const PlaneId id = plane_after(PlaneId::kSurfaceNormalX, c);
        EXPECT_NEAR(plate.frame.plane(id).at(x, y), n[c], 1e-5);
      }
      ++seen;
      const double dry = plate.frame.plane(PlaneId::kDepth).at(x, y);
      dry_behind += std::isfinite(dry) && dry > depth;
    }
  }
  EXPECT_GT(seen, 2000);
  EXPECT_GT(dry_behind, 100);  // the slab above
}

TEST(RenderPlate, TheUndersideMirrorsWhatIsInTheWater) {
  const Scene scene = under_water();
  const RenderedPlate plate = render_basin(scene);
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  int floor = 0, wall = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const glm::dvec3 eye = scene.camera->eye(), ray = rays.ray_at(x + 0.5, y + 0.5);
      // In the mirror the floor is at y = 1, and the wall goes from the water up to the floor.
      if (eye.y + (-6 - eye.z) / ray.z * ray.y < 0.01) continue;
      const double to_floor = (1 - eye.y) / ray.y, to_wall = (-6 - eye.z) / ray.z;
      const double depth = plate.frame.plane(PlaneId::kReflectionDepth).at(x, y);
      const double blue = plate.frame.plane(PlaneId::kReflectionB).at(x, y);
      const double red = plate.frame.plane(PlaneId::kReflectionR).at(x, y);
      if (to_wall > 0 && to_wall < 0.99 * to_floor && std::abs(eye.x + to_wall * ray.x) < 4.9) {
        EXPECT_NEAR(depth, to_wall, 1e-4 * to_wall);
        EXPECT_GT(blue, red);
        ++wall;
      } else if (to_floor < 0.99 * to_wall && std::abs(eye.x + to_floor * ray.x) < 7.9) {
        EXPECT_NEAR(depth, to_floor, 1e-4 * to_floor);
        EXPECT_GT(red, blue);
        ++floor;
      }
    }
  }
  EXPECT_GT(floor, 500);
  EXPECT_GT(wall, 500);
}

TEST(RenderPlate, AnEyeInTheWaterPlaneSeesTheDrySceneAndNoMirror) {
  for (const double height : {-1e-10, 0.0, 1e-10}) {
    Scene scene = over_basin();
    scene.camera->view =
        glm::lookAt(glm::dvec3(0.5, height, 3), glm::dvec3(0, height, -3), glm::dvec3(0, 1, 0));
    const RenderedPlate plate = render_basin(scene);
    EXPECT_EQ(plate.frame.present(), kEverything - kMirror) << height;
    const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
    const View<const float>& depth = plate.frame.plane(PlaneId::kDepth);
    const int x = kSize.width / 2, y = kSize.height / 2;  // the wall at z = -6
    EXPECT_NEAR(3 + depth.at(x, y) * rays.ray_at(x + 0.5, y + 0.5).z, -6, 1e-4) << height;
  }
  Scene above = over_basin();
  above.water->waves = {{2.5, 0.3, 0, 0, 0}};  // a crest over the eye, which is above the plane
  EXPECT_EQ(render_basin(above).frame.present(), kEverything);
}

// The slab spans x -1 ... 1 and z -2 ... -3 at a height of 1 ... 1.3; with the sun at 45 degrees in
// +x its shadow on the water reaches from x = -2 (-2.3 at the far end) to 0 (-0.3).
void expect_shadow_of_the_slab(const Scene& scene, const RenderedPlate& plate, double height) {
  const Rays rays = rays_of(*scene.camera, {kSize.width, kSize.height});
  const glm::dvec3 eye = scene.camera->eye();
  int dark = 0, lit = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const float shadow = plate.frame.plane(PlaneId::kSurfaceShadow).at(x, y);
      const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
      const glm::dvec3 p = eye + (height - eye.y) / ray.y * ray;
      const bool water = (height - eye.y) / ray.y > 0 && std::abs(p.x) < 4 && p.z > -5.5;
      if (!water) continue;
      const double far = (-2 - p.z), slab = 1 + 0.3 * far - height;  // its height above the water
      const double edge =
          std::min({far, 1 - far, p.x + 1 + slab, 1 - slab - p.x});  // how far within the shadow
      if (std::abs(edge) < 0.1) continue;
      EXPECT_EQ(shadow, edge > 0 ? 0 : 1) << p.x << ' ' << p.z;
      ++(edge > 0 ? dark : lit);
    }
  }
  EXPECT_GT(dark, 40);
  EXPECT_GT(lit, 500);
}

TEST(RenderPlate, WhatStandsOverTheWaterShadowsItsSurface) {
  for (Scene scene : {over_basin(), under_water()}) {
    scene.sun->direction = glm::normalize(glm::dvec3(1, 1, 0));
    const RenderedPlate plate = render_basin(scene);
    expect_shadow_of_the_slab(scene, plate, 0);
    const RenderedPlate alone = render_basin(scene, PlaneSet{PlaneId::kSurfaceShadow});
    expect_shadow_of_the_slab(scene, alone, 0);

    Model no_mesh = basin();
    no_mesh.instances.pop_back();
    const RenderedPlate calm =
        render_plate(no_mesh, scene, {.size = kSize}, kEverything, *make_executor(2));
    EXPECT_FALSE(calm.frame.plane(PlaneId::kSurfaceDepth));
    expect_shadow_of_the_slab(scene, calm, 0);

    // The lifted surface meets the same rays of the sun elsewhere: a wave without slope lifts it.
    scene.water->waves = {{0.4, 0, 0, 1.5707963267948966, 0}};
    expect_shadow_of_the_slab(scene, render_basin(scene), 0.4);
  }
}

TEST(RenderPlate, TheSurfaceIsLitWhereThereIsNoneAndHasNoShadowWithoutSun) {
  Scene scene = over_basin();
  const RenderedPlate plate = render_basin(scene);
  int none = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (std::isfinite(plate.frame.plane(PlaneId::kSurfaceDepth).at(x, y))) continue;
      EXPECT_EQ(plate.frame.plane(PlaneId::kSurfaceShadow).at(x, y), 1);
      ++none;
    }
  }
  EXPECT_GT(none, 100);
  scene.sun.reset();
  EXPECT_FALSE(render_basin(scene).frame.plane(PlaneId::kSurfaceShadow));
}

TEST(RenderPlate, RefusesScenesThatMeanNothing) {
  const auto refused = [](const Scene& scene, RenderOptions options, const char* why) {
    try {
      render_plate(basin(), scene, options, kEverything, *make_executor(1));
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
