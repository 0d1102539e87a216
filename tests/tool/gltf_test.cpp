#include <gmock/gmock.h>

#include "load/gltf_files.h"
#include "tool/tool.h"

/// What the tool says of glTF files that it does not draw as they are.

namespace limpid::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class GltfToolTest : public ToolTest {
 protected:
  Ran rendered(const json& gltf, const Words& more = {}) const {
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
    Words words = {"render", "thing.toml", "--size", "32x18", "-o", "thing.exr"};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }
};

TEST_F(GltfToolTest, TellsWhatItDoesNotDrawInALineEach) {
  json gltf = square_gltf();
  gltf["animations"] = {json::object()};
  gltf["materials"] = json::parse(R"([{"extensions": {"KHR_\nior": {}}}])");
  const Ran ran = rendered(gltf);
  EXPECT_EQ(ran.code, 0) << ran.err;
  const std::string file = "limpid: " + (folder_ / "thing.gltf").string() + ": ";
  EXPECT_EQ(ran.err, file + "animations are not played, nodes stay in place\n" + file +
                         "KHR_?ior is not drawn: materials[0].extensions\n");
  EXPECT_EQ(rendered(gltf, {"-q"}).err, "");
}

}  // namespace
}  // namespace limpid::test
