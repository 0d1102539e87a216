#include <cmath>
#include <fstream>
#include <map>

#include <gmock/gmock.h>

#include "limpid/files/gltf/gltf.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/raster/render_plate.h"

#include "paths.h"
#include "tool/tool.h"

/// The collection of tests/tools/gltf_collection.py: 60 files with features that exporters write.

namespace limpid::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Size kSize{96, 72};

class GltfCollectionTest : public ToolTest {
 protected:
  void SetUp() override {
    const Ran ran = run(folder_, {PYTHON3, LIMPID_TEST_DATA "/../tools/gltf_collection.py", "."});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }

  std::vector<std::string> names() const {
    std::ifstream in(folder_ / "names");
    return {std::istream_iterator<std::string>(in), {}};
  }

  Model model(const std::string& name) const { return load_gltf(folder_ / (name + ".gltf")); }

  RenderedPlate drawn(const std::string& name) const {
    const SceneFile file = load_scene(folder_ / (name + ".toml"));
    Scene scene = file.scene;
    scene.camera = camera_for(*file.camera, kSize);
    return render_plate(model(name), scene, {.size = kSize, .shadow_map_size = 256},
                        kColorPlanes | PlaneSet{PlaneId::kDepth}, *executor_);
  }

  std::unique_ptr<Executor> executor_ = make_executor(1);
};

const View<const float>& plane(const RenderedPlate& plate, PlaneId id) {
  return plate.frame.plane(id);
}

/// Pixels in which a color differs by more than the tolerance.
int different(const RenderedPlate& a, const RenderedPlate& b, double tolerance) {
  int count = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      bool differs = false;
      for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
        differs =
            differs || !(std::abs(plane(a, id).at(x, y) - plane(b, id).at(x, y)) <= tolerance);
      }
      count += differs;
    }
  }
  return count;
}

int covered(const RenderedPlate& plate) {
  int count = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      count += std::isfinite(plane(plate, PlaneId::kDepth).at(x, y));
    }
  }
  return count;
}

TEST_F(GltfCollectionTest, IsDrawn) {
  const std::vector<std::string> all = names();
  EXPECT_EQ(all.size(), 60u);
  for (const std::string& name : all) {
    SCOPED_TRACE(name);
    const RenderedPlate plate = drawn(name);
    EXPECT_GT(covered(plate), kSize.width * kSize.height / 40);
    EXPECT_LT(covered(plate), kSize.width * kSize.height / 2);
    for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          ASSERT_TRUE(std::isfinite(plane(plate, id).at(x, y)));
        }
      }
    }
  }
}

TEST_F(GltfCollectionTest, IsDrawnAsPlainTrianglesAre) {
  // Rounding in the file: half a step of a byte in uvs and normals, which moves a few edges. All
  // other numbers are computed in double and may differ by the last bit of a vertex.
  const std::map<std::string, double> rounded = {{"quantized_shorts", 0.01},
                                                 {"quantized_plain", 0.03},
                                                 {"skin_shorts", 0.01},
                                                 {"instances_of_shorts", 0.01}};
  std::ifstream twins(folder_ / "twins");
  int count = 0;
  for (std::string name, twin; twins >> name >> twin; ++count) {
    SCOPED_TRACE(name + " and " + twin);
    const auto found = rounded.find(name);
    const double tolerance = found == rounded.end() ? 1e-4 : found->second;
    EXPECT_LE(different(drawn(name), drawn(twin), tolerance), 12);
  }
  EXPECT_GE(count, 30);
}

TEST_F(GltfCollectionTest, ShowsWhatMakesTheDifference) {
  const std::pair<const char*, const char*> pairs[] = {{"morph", "skin"},
                                                       {"skin_morph", "skin"},
                                                       {"sparse", "strip"},
                                                       {"transform", "textured"},
                                                       {"two_sets", "textured"},
                                                       {"clamped", "repeated"},
                                                       {"mirrored", "clamped"},
                                                       {"mask", "blend"},
                                                       {"blend_of_two", "mask"},
                                                       {"mask", "textured"},
                                                       {"vertex_colors", "triangles"},
                                                       {"emission", "triangles"},
                                                       {"unlit", "triangles"},
                                                       {"no_normals", "triangles"}};
  for (const auto& [name, other] : pairs) {
    EXPECT_GT(different(drawn(name), drawn(other), 0.05), 100) << name << " and " << other;
  }
}

TEST_F(GltfCollectionTest, TellsWhatIsNotDrawn) {
  std::map<std::string, std::vector<std::string>> warnings;
  for (const std::string& name : names()) {
    const Model read = model(name);
    if (!read.warnings.empty()) warnings[name] = read.warnings;
    EXPECT_EQ(read.skipped_triangles, 0) << name;
  }
  EXPECT_THAT(warnings["points_and_lines"],
              ElementsAre("points are not drawn: meshes[0]", "lines are not drawn: meshes[0]"));
  EXPECT_THAT(warnings["no_positions"],
              ElementsAre("primitives without POSITION are not drawn: meshes[0]"));
  EXPECT_THAT(warnings["hidden"],
              ElementsAre("hidden nodes and their children are not drawn: nodes[2] 'hidden'"));
  EXPECT_THAT(warnings["animated"], ElementsAre(HasSubstr("animations are not played")));
  EXPECT_THAT(warnings["specular_glossiness"], ElementsAre(HasSubstr("SpecularGlossiness")));
  EXPECT_EQ(warnings.size(), 5u);
}

TEST_F(GltfCollectionTest, GoesThroughTheTool) {
  for (const std::string& name : names()) {
    const Ran ran = limpid({"render", name + ".toml", "--size", "32x24", "--shadow-map", "64", "-q",
                            "-o", name + ".exr"});
    EXPECT_EQ(ran.code, 0) << name << ran.err;
  }
}

}  // namespace
}  // namespace limpid::test
