#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"

#include "raster/shadow_map.h"
#include "raster_scenes.h"

namespace limpid {
namespace {

using namespace test;

/// Runs the tasks in an order of its own.
class Shuffled : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    for (int i = 0; i < count; ++i) task(context, static_cast<int>((i * 7919LL + 13) % count));
  }
};

TEST(Rasteriser, BitsDependNeitherOnThreadsNorOnTheOrderOfTiles) {
  // 7919 is a prime and no count of tasks is a multiple of it: each task runs once.
  const Model model = mixed_model();
  const RasterView view = mixed_view(203, 131);
  const ShadowMap map = make_shadow_map(model, low_sun().sun, std::nullopt, 128, *make_executor(1));
  const RasterLighting light{low_sun().sun, &map};
  const std::vector<float> expected =
      values(rasterise(model, view, light, kEverything, *make_executor(1)));
  EXPECT_EQ(values(rasterise(model, view, light, kEverything, *make_executor(2))), expected);
  Shuffled shuffled;
  EXPECT_EQ(values(rasterise(model, view, light, kEverything, shuffled)), expected);
}

TEST(Rasteriser, ASecondDrawEqualsTheFirst) {
  const Model model = mixed_model();
  const auto executor = make_executor(1);
  Rasteriser rasteriser(model);
  RasterImage image;
  rasteriser.draw(mixed_view(90, 70), low_sun(), kEverything, *executor, image);
  const std::vector<float> first = values(image);
  rasteriser.draw(mixed_view(33, 140), low_sun(), {.depth = true}, *executor, image);
  EXPECT_FALSE(image.color[0]);
  rasteriser.draw(mixed_view(90, 70), low_sun(), kEverything, *executor, image);
  EXPECT_EQ(values(image), first);
}

TEST(Rasteriser, OnlyWhatIsWantedIsMadeAndIsTheSame) {
  const Model model = mixed_model();
  const RasterView view = mixed_view(50, 40);
  const RasterImage all = drawn(model, view, low_sun());
  const RasterImage depth = drawn(model, view, low_sun(), {.depth = true});
  EXPECT_FALSE(depth.color[0] || depth.coverage || depth.shadow || depth.normal[0]);
  const RasterImage normal = drawn(model, view, low_sun(), {.normal = true});
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 50; ++x) {
      ASSERT_EQ(at(depth.depth, x, y), at(all.depth, x, y));
      for (int c = 0; c < 3; ++c) ASSERT_EQ(at(normal.normal[c], x, y), at(all.normal[c], x, y));
    }
  }
}

TEST(Rasteriser, InstructionSetsAgree) {
  const Model model = mixed_model();
  const RasterView view = mixed_view(160, 120);
  const RasterImage judge = drawn(model, view, low_sun(), kEverything, "scalar");
  for (const std::string& simd : simd_targets()) {
    const RasterImage image = drawn(model, view, low_sun(), kEverything, simd);
    int other = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        // A corner may be snapped to the next 1/256 pixel and give a pixel to its neighbour.
        const double depth = at(judge.depth, x, y), got = at(image.depth, x, y);
        const bool same = depth == got || std::abs(depth - got) < 1e-6 * depth;
        bool near = true;
        for (int c = 0; c < 3; ++c) {
          near = near && std::abs(at(judge.color[c], x, y) - at(image.color[c], x, y)) < 2e-3;
          near = near && std::abs(at(judge.normal[c], x, y) - at(image.normal[c], x, y)) < 1e-4;
        }
        other += !(same && near);
      }
    }
    EXPECT_LE(other, 40) << simd;
  }
}

TEST(Rasteriser, OverscanAndWindowsOfAwkwardSizesShowTheSamePicture) {
  const Model model = mixed_model();
  RasterView view = mixed_view(120, 90);
  const RasterImage whole = drawn(model, view, low_sun());
  std::vector<Rect> windows{{-37, -11, 141, 130}, {17, 23, 101, 77}};
  for (const Size size : {Size{1, 1}, {1, 67}, {103, 1}, {63, 65}, {64, 64}, {65, 63}, {97, 17}}) {
    windows.push_back({9, 5, 9 + size.width, 5 + size.height});
  }
  for (const Rect& window : windows) {
    view.window = window;
    const RasterImage part = drawn(model, view, low_sun());
    EXPECT_EQ(part.depth.view().window, window);
    for (float value : values(part)) ASSERT_FALSE(std::isnan(value));
    const Rect common = intersection(window, view.display);
    int other = 0;
    for (int y = common.y0; y < common.y1; ++y) {
      for (int x = common.x0; x < common.x1; ++x) {
        const double a = at(whole.depth, x, y), b = at(part.depth, x, y);
        other += !(a == b || std::abs(a - b) < 1e-6 * a) ||
                 std::abs(at(whole.color[1], x, y) - at(part.color[1], x, y)) > 1e-3;
      }
    }
    EXPECT_LE(other, 8);
  }
}

TEST(Rasteriser, EmptyModelShowsTheBackground) {
  Model model = model_of({});
  const RasterImage image = drawn(model, mixed_view(70, 3), low_sun());
  for (int x = 0; x < 70; ++x) {
    EXPECT_FLOAT_EQ(at(image.color[0], x, 1), 0.25f);
    EXPECT_FLOAT_EQ(at(image.color[2], x, 1), 0.75f);
    EXPECT_EQ(at(image.depth, x, 1), kInfinity);
    EXPECT_EQ(at(image.coverage, x, 1), 0);
    EXPECT_EQ(at(image.shadow, x, 1), 1);
    EXPECT_EQ(at(image.normal[1], x, 1), 0);
  }
}

TEST(Rasteriser, WaterIsDrawnAloneOrNotAtAll) {
  Model model = model_of({hills(4, 20, 0), hills(4, 20, 0)});
  model.instances[1].water = true;
  model.instances[1].world_from_mesh = glm::translate(glm::dmat4(1), glm::dvec3(0, 1, 0));
  RasterView view = perspective_view(20, 20, {0, 5, 0.01}, {0, 0, 0});
  EXPECT_NEAR(at(drawn(model, view).depth, 10, 10), 5, 0.2);
  view.subject = RasterSubject::kWater;
  EXPECT_NEAR(at(drawn(model, view).depth, 10, 10), 4, 0.2);
}

TEST(Rasteriser, DegenerateTrianglesAreCountedAndLeftOut) {
  const Mesh mesh = triangles({{0, 0, 0},
                               {0, 0, 0},
                               {5, 5, 0},  // two corners at one point
                               {-3, -3, 0},
                               {0, 0, 0},
                               {3, 3, 0},  // on a line
                               {-1, -1, -9},
                               {1, -1, -9},
                               {0, 1, -9}});
  const Model model = model_of({mesh});
  EXPECT_EQ(Rasteriser(model).degenerate_triangles(), 2);
  RasterView view = perspective_view(64, 64, {0, 0, 5}, {0, 0, 0});
  view.cull = false;
  const RasterImage image = drawn(model, view);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_TRUE(at(image.coverage, x, y) == 0 || std::abs(at(image.depth, x, y) - 14) < 1e-4);
    }
  }
  EXPECT_EQ(at(image.coverage, 32, 32), 1);
}

TEST(Rasteriser, FlattenedInstancesAreDrawn) {
  // A singular transform: flattened hills still show, and their normals are the plane's.
  Model model = model_of({hills(8, 10, 1)});
  model.meshes[0].normals.clear();
  model.instances[0].world_from_mesh = glm::scale(glm::dmat4(1), glm::dvec3(1, 0, 1));
  const RasterImage image = drawn(model, perspective_view(40, 40, {0, 6, 0.01}, {0, 0, 0}));
  EXPECT_NEAR(at(image.depth, 20, 20), 6, 0.1);
  EXPECT_NEAR(at(image.normal[1], 20, 20), 1, 1e-6);
}

TEST(Rasteriser, ExtremeUvsGiveNoNaN) {
  Model model = mixed_model();
  for (Mesh& mesh : model.meshes) {
    for (glm::vec2& uv : mesh.uvs) uv *= 3e37f;
  }
  for (float value : values(drawn(model, mixed_view(40, 30), low_sun()))) {
    ASSERT_FALSE(std::isnan(value));
  }
}

TEST(Rasteriser, FarAwayScenesKeepTheirShape) {
  // The same picture 1e6 units from the origin: the matrices cancel in double.
  Model model = mixed_model();
  RasterView view = mixed_view(80, 60);
  const RasterImage here = drawn(model, view, low_sun());
  const glm::dvec3 away(1e6, -2e6, 3e6);
  for (Instance& i : model.instances) i.world_from_mesh[3] += glm::dvec4(away, 0);
  view.camera.view = glm::translate(view.camera.view, -away);
  const RasterImage there = drawn(model, view, low_sun());
  int other = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const double a = at(here.depth, x, y), b = at(there.depth, x, y);
      other += !(a == b || std::abs(a - b) < 1e-6 * a);
    }
  }
  EXPECT_LE(other, 5);
}

TEST(Rasteriser, RefusesWhatItCannotDraw) {
  const auto executor = make_executor(1);
  const auto refused = [&](const Model& model, const RasterView& view, const std::string& part,
                           const std::string& simd = "") {
    try {
      rasterise(model, view, {}, kEverything, *executor, simd);
      ADD_FAILURE() << "expected an error about " << part;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  const RasterView view = flat_view(8, 8);
  const Model good = model_of({hills(2, 2, 0)});
  Model model = good;
  model.materials.clear();
  refused(model, view, "materials");
  model = good;
  model.meshes[0].indices[4] = 99;
  refused(model, view, "index = 99");
  model = good;
  model.meshes[0].indices.pop_back();
  refused(model, view, "three a triangle");
  model = good;
  model.meshes[0].normals.pop_back();
  refused(model, view, "normals");
  model = good;
  model.meshes[0].material = 1;
  refused(model, view, "material = 1");
  model = good;
  model.instances[0].mesh = 7;
  refused(model, view, "mesh = 7");
  model = good;
  model.textures = {{2, 2, {1, 2, 3}}};
  refused(model, view, "2x2");
  RasterView bad = view;
  bad.window = {3, 3, 3, 8};
  refused(good, bad, "window of 0x5");
  bad = view;
  bad.display = {0, 0, 40000, 1};
  refused(good, bad, "display of 40000x1");
  bad = view;
  bad.camera.view[0][0] = 3;
  refused(good, bad, "camera");
  bad = view;
  bad.clip_plane = glm::dvec4(0, 0, 0, kInfinity);
  refused(good, bad, "clip plane");
  refused(good, view, "mmx", "mmx");
}

}  // namespace
}  // namespace limpid
