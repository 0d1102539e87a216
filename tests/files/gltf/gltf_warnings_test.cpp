#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/gltf/gltf.h"

#include "files/exr/written.h"
#include "files/gltf/made_gltf.h"

/// What a model says of a file that it does not draw.

namespace limpid {
namespace {

using nlohmann::json;
using test::square_gltf;
using test::written;
using testing::ElementsAre;

std::vector<std::string> warnings_of(const json& gltf) {
  return load_gltf(written("scene.gltf", gltf.dump())).warnings;
}

TEST(GltfWarnings, TellsOfAnimationsOnce) {
  json gltf = square_gltf();
  gltf["animations"] = {json::object(), json::object()};
  EXPECT_THAT(warnings_of(gltf), ElementsAre("animations are not played, nodes stay in place"));
}

TEST(GltfWarnings, NamesTheFirstPlacesOfMany) {
  json gltf = square_gltf();
  for (int i = 0; i < 7; ++i) {
    gltf["materials"].push_back(
        json::parse(R"({"extensions": {"KHR_materials_unlit": {}, "KHR_materials_ior": {}}})"));
  }
  EXPECT_THAT(warnings_of(gltf),
              ElementsAre("KHR_materials_ior is not drawn: materials[0].extensions, "
                          "materials[1].extensions, materials[2].extensions, "
                          "materials[3].extensions and 3 more"));
}

TEST(GltfWarnings, AreNotWithoutEnd) {
  json gltf = square_gltf();
  json extensions;
  for (int i = 0; i < 150; ++i) extensions["X" + std::to_string(i)] = json::object();
  gltf["materials"].push_back({{"extensions", extensions}});
  const std::vector<std::string> warnings = warnings_of(gltf);
  EXPECT_EQ(warnings.size(), 100u);
  EXPECT_EQ(warnings.back(), "and 51 more warnings");
}

}  // namespace
}  // namespace limpid
