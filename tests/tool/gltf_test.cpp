#include <gmock/gmock.h>

#include "files/gltf/made_gltf.h"
#include "tool/tool.h"

/// The tool reports each part of a glTF file that it does not draw as the file has it.

namespace limpid::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class GltfToolTest : public ToolTest {
 protected:
  Ran rendered(const json& gltf, const Words& more = {}, const std::string& verb = "render") const {
    write_text("thing.gltf", gltf.dump());
    write_text("thing.toml", R"(
      geometry.gltf = "thing.gltf"
      [camera]
      view = [[1, 0, 0, -0.5], [0, 1, 0, -0.5], [0, 0, 1, -3], [0, 0, 0, 1]]
      fov_y = 45
      [water]
      up = [0, 1, 0]
      height = 0
      [sun]
      direction = [1, 2, 1]
    )");
    Words words = {verb, "thing.toml", "--size", "32x18", "-o", "thing.exr"};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
};

TEST_F(GltfToolTest, TellsWhatItDoesNotDrawInALineEach) {
  json gltf = square_gltf();
  gltf["animations"] = json::array({json::object()});
  gltf["materials"] = json::parse(R"([{"extensions": {"KHR_\nior": {}}}])");
  const Ran ran = rendered(gltf);
  EXPECT_EQ(ran.code, 0) << ran.err;
  const std::string file = "limpid: warning: " + (folder_ / "thing.gltf").string() + ": ";
  EXPECT_EQ(ran.err, file + "animations are not played, nodes stay in place\n" + file +
                         "KHR_?ior is not drawn: materials[0].extensions\n");
  EXPECT_EQ(rendered(gltf, {"-q"}).err, "");
}

TEST_F(GltfToolTest, DrawsWhatItCanWhereItIsAskedTo) {
  json gltf = square_gltf();
  ASSERT_EQ(rendered(gltf).code, 0);
  ASSERT_EQ(oiiotool({"thing.exr", "-o", "whole.exr"}).code, 0);
  gltf["nodes"].push_back({{"name", "packed"}, {"mesh", 1}});
  gltf["nodes"].push_back({{"name", "turned"}, {"mesh", 0}, {"rotation", {0, 0, 0, 3}}});
  gltf["scenes"][0]["nodes"] = {0, 1, 2};
  gltf["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  gltf["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 3}});
  gltf["meshes"].push_back(json::parse(R"({"primitives": [{"attributes": {"POSITION": 4},
    "extensions": {"KHR_draco_mesh_compression": {}}}]})"));
  EXPECT_THAT(rendered(gltf).err, HasSubstr("meshes packed by Draco are not read"));
  for (const std::string verb : {"water", "truth", "render"}) {
    const Ran ran = rendered(gltf, {"--skip-unsupported"}, verb);
    EXPECT_EQ(ran.code, 0) << verb << ran.err;
    const std::string file = "limpid: warning: " + (folder_ / "thing.gltf").string() + ": ";
    EXPECT_THAT(ran.err, HasSubstr(file + "nodes[1] 'packed' is left out: meshes[1].primitives[0]: "
                                          "is packed by Draco (KHR_draco_mesh_compression)"));
    EXPECT_THAT(ran.err, HasSubstr(file + "nodes[2] is left out, with all below it: "));
  }
  EXPECT_TRUE(same("thing.exr", "whole.exr"));
}

}  // namespace
}  // namespace limpid::test
