#include "limpid/files/text/scene_file.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/text/scene_keys.h"

#include "files/exr/written.h"
#include "paths.h"

namespace limpid {
namespace {

using test::error_of;
using test::own_folder;
using test::written;
using testing::HasSubstr;
using testing::StartsWith;

namespace fs = std::filesystem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::string kView = "view = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n";
const std::string kGlRow = "[0, 0, -1.5, -2.5]";        // near 1, far 5
const std::string kReversedRow = "[0, 0, 0.25, 1.25]";  // the same, reversed

std::string projection_with(const std::string& z_row) {
  return "projection = [[2, 0, 0, 0], [0, 3, 0, 0], " + z_row + ", [0, 0, -1, 0]]\n";
}

SceneFile scene_of(const std::string& text) { return load_scene(written("scene.toml", text)); }

Camera camera_of(const std::string& keys, Size display = {200, 100}, double pixel_aspect = 1) {
  const SceneFile file = scene_of("[camera]\n" + kView + keys);
  return camera_for(file.camera.value(), display, pixel_aspect);
}

glm::dvec3 device_point(const Camera& camera, glm::dvec3 world) {
  const glm::dvec4 clip = camera.projection * camera.view * glm::dvec4(world, 1);
  return glm::dvec3(clip) / clip.w;
}

TEST(SceneFile, ReadsAPathTracedPlate) {
  const fs::path path = fs::path(LIMPID_TEST_DATA) / "scenes/lagoon.toml";
  const SceneFile file = load_scene(path);
  const fs::path folder = path.parent_path();
  EXPECT_EQ(file.plates.size(), 6u);
  EXPECT_EQ(file.plates.at("color"), (folder / "dry_color.exr").string());
  EXPECT_EQ(file.plates.at("depth"), (folder / "dry_depth.exr:Z").string());
  EXPECT_EQ(file.depth, DepthKind::kEye);
  EXPECT_EQ(file.near, 0.1);
  EXPECT_EQ(file.far, 500);
  EXPECT_EQ(file.scene.water->up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(file.scene.water->height, 0);
  EXPECT_NEAR(file.scene.sun->direction.y, 0.871535897, 1e-8);
  EXPECT_EQ(file.scene.sun->color.b, 0.819999993);
  EXPECT_FALSE(file.scene.camera);

  const Camera camera = camera_for(file.camera.value(), {960, 540});
  // Rows: x' = 0.99 x - 0.137 y - 0.0457.
  EXPECT_EQ(camera.view[1][0], -0.137153089);
  EXPECT_EQ(camera.view[3][0], -0.04571791);
  EXPECT_NEAR(camera.device_from_eye_depth(0.1), -1, 1e-6);
  EXPECT_NEAR(camera.device_from_eye_depth(500), 1, 1e-6);
  EXPECT_GT(camera.eye().z, 0);  // above the water
  EXPECT_NO_THROW(file.scene.validate());
}

TEST(SceneFile, EmptyFileHasNothing) {
  const SceneFile file = scene_of("");
  EXPECT_TRUE(file.plates.empty());
  EXPECT_FALSE(file.camera || file.scene.water || file.scene.sun || file.near || file.far);
  EXPECT_EQ(file.depth, DepthKind::kEye);
}

TEST(SceneFile, DirectionsAreMadeUnit) {
  const SceneFile file =
      scene_of("[water]\nup = [0, 0, 4]\nheight = 1.5\n[sun]\ndirection = [3e300, 0, 4e300]\n");
  EXPECT_EQ(file.scene.water->up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(file.scene.water->height, 1.5);
  EXPECT_NEAR(glm::distance(file.scene.sun->direction, glm::dvec3(0.6, 0, 0.8)), 0, 1e-15);
  EXPECT_EQ(file.scene.sun->color, (Rgb<double>{1, 1, 1}));
  EXPECT_EQ(file.scene.sun->diameter, 0.533);
  EXPECT_EQ(scene_of("[sun]\ndirection = [0, 1, 0]\ndiameter = 2.5\n").scene.sun->diameter, 2.5);
  EXPECT_EQ(scene_of("[water]\n").scene.water->up, glm::dvec3(0, 1, 0));
}

TEST(SceneFile, SkyIsEvenLight) {
  EXPECT_FALSE(scene_of("").scene.sky);
  const SceneFile file = scene_of("[sky]\nradiance = [0.2, 0.3, 0.5]\n");
  EXPECT_EQ(file.scene.sky->radiance, (Rgb<double>{0.2, 0.3, 0.5}));
  EXPECT_EQ(scene_of(to_toml(file.scene)).scene.sky->radiance, file.scene.sky->radiance);
}

TEST(SceneFile, PlatesAreRelativeToTheFile) {
  const SceneFile file = scene_of(
      "[plates]\ncolor = \"../in/beauty.%04d.exr\"\ndepth = \"/a:b/depth.exr\"\n"
      "shadow = \"z.exr:ViewLayer.Shadow.R\"\nreflection = \"a:b/c.exr:R,G,B\"\n");
  const fs::path folder = own_folder();
  EXPECT_EQ(file.plates.at("color"), (folder / "../in/beauty.%04d.exr").lexically_normal());
  EXPECT_EQ(file.plates.at("depth"), "/a:b/depth.exr");
  EXPECT_EQ(file.plates.at("shadow"),
            (folder / "z.exr:ViewLayer.Shadow.R").lexically_normal().string());
  EXPECT_EQ(file.plates.at("reflection"), (folder / "a:b/c.exr:R,G,B").lexically_normal().string());
}

TEST(SceneFile, TheEnvironmentIsAFileAndAnAngle) {
  const SceneFile file = scene_of(
      "[plates]\nenvironment = \"../sky:2.exr\"\nenvironment_rotation = -90\n"
      "color = \"a.exr\"\n");
  EXPECT_EQ(file.environment, (own_folder() / "../sky:2.exr").lexically_normal());
  EXPECT_NEAR(file.environment_rotation, -std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(file.plates.size(), 1u);
  const SceneFile plain = scene_of("[plates]\nenvironment = \"/sky.hdr\"\n");
  EXPECT_EQ(plain.environment, "/sky.hdr");
  EXPECT_EQ(plain.environment_rotation, 0);
  EXPECT_TRUE(scene_of("").environment.empty());
}

TEST(SceneFile, PlateNamesSplitAtTheLastColonThatNoSlashFollows) {
  const auto parts = [](const char* text) {
    const PlateName name = split_plate(text);
    return name.file + "|" + name.channels;
  };
  EXPECT_EQ(parts("a.exr"), "a.exr|");
  EXPECT_EQ(parts("a.exr:Z"), "a.exr|Z");
  EXPECT_EQ(parts("a:b.exr:R,G"), "a:b.exr|R,G");
  EXPECT_EQ(parts("/a:b/c.exr"), "/a:b/c.exr|");
  EXPECT_EQ(parts("/a:b/c.exr:my layer.Z"), "/a:b/c.exr|my layer.Z");
}

TEST(SceneFile, FieldsOfViewFitThePicture) {
  // At distance 1 a field of view of 90 degrees reaches 1 to either side.
  const Camera across = camera_of("fov_x = 90\n");
  EXPECT_NEAR(glm::distance(glm::dvec2(device_point(across, {1, 0.5, -1})), glm::dvec2(1, 1)), 0,
              1e-12);
  const Camera up = camera_of("fov_y = 90.0\n");
  EXPECT_NEAR(glm::distance(glm::dvec2(device_point(up, {2, 1, -1})), glm::dvec2(1, 1)), 0, 1e-12);
  // Pixels twice as wide as high make the picture twice as wide.
  const Camera wide = camera_of("fov_x = 90\n", {200, 100}, 2);
  EXPECT_NEAR(device_point(wide, {1, 0.25, -1}).y, 1, 1e-12);
  const Camera flat = camera_of("orthographic = 8\n");
  EXPECT_TRUE(flat.orthographic());
  EXPECT_NEAR(glm::distance(glm::dvec2(device_point(flat, {4, 2, -7})), glm::dvec2(1, 1)), 0,
              1e-12);
}

TEST(SceneFile, NearFarAndClipReachTheProjection) {
  const Camera gl = camera_of("fov_y = 40\nnear = 0.5\nfar = 20\n");
  EXPECT_NEAR(gl.device_from_eye_depth(0.5), -1, 1e-12);
  EXPECT_NEAR(gl.device_from_eye_depth(20), 1, 1e-12);
  const Camera reversed =
      camera_of("fov_y = 40\nnear = 0.5\nfar = inf\nclip = \"reversed\"\ndepth = \"device\"\n");
  EXPECT_EQ(reversed.clip, ClipSpace::kReversed);
  EXPECT_NEAR(reversed.device_from_eye_depth(0.5), 1, 1e-12);
  EXPECT_NEAR(reversed.device_from_eye_depth(1e12), 0, 1e-11);
  const Camera d3d = camera_of("orthographic = 1\nnear = -2\nfar = 6\nclip = \"d3d\"\n");
  EXPECT_NEAR(d3d.device_from_eye_depth(-2), 0, 1e-12);
  EXPECT_NEAR(d3d.device_from_eye_depth(6), 1, 1e-12);
}

TEST(SceneFile, ProjectionsMustRunAsTheClipSpaceSays) {
  EXPECT_EQ(camera_of(projection_with(kGlRow)).projection[3][2], -2.5);
  EXPECT_NO_THROW(camera_of(projection_with(kReversedRow) + "clip = \"reversed\"\n"));
  EXPECT_THAT(error_of([] { camera_of(projection_with(kReversedRow)); }),
              HasSubstr(":3:14: camera: the projection's device depth falls with distance"));
  EXPECT_THAT(error_of([] { camera_of(projection_with(kReversedRow) + "clip = \"d3d\"\n"); }),
              HasSubstr("falls with distance"));
  EXPECT_THAT(error_of([] { camera_of(projection_with(kGlRow) + "clip = \"reversed\"\n"); }),
              HasSubstr("grows with distance"));
  EXPECT_THAT(error_of([] { camera_of(projection_with("[0, 0, -1, 0]")); }),
              HasSubstr("every distance the same device depth"));
  const std::string flat = "projection = [[1, 0, 0, 0], [0, 1, 0, 0], ";
  EXPECT_NO_THROW(camera_of(flat + "[0, 0, -0.1, 0], [0, 0, 0, 1]]\n"));
  EXPECT_THAT(error_of([&] { camera_of(flat + "[0, 0, 0.1, 0], [0, 0, 0, 1]]\n"); }),
              HasSubstr("falls with distance"));
}

TEST(SceneFile, DepthKindsByName) {
  EXPECT_EQ(scene_of("[camera]\ndepth = \"ray\"\n").depth, DepthKind::kRay);
  EXPECT_EQ(scene_of("[camera]\ndepth = \"inverse\"\n").depth, DepthKind::kInverse);
  EXPECT_EQ(scene_of("[camera]\ndepth = \"device\"\n").depth, DepthKind::kDevice);
  const SceneFile file = scene_of("[camera]\ndepth = \"normalised\"\nnear = 1\nfar = 9\n");
  EXPECT_EQ(file.depth, DepthKind::kNormalised);
  EXPECT_EQ(file.near, 1);
  EXPECT_FALSE(file.camera);
  EXPECT_EQ(scene_of("[camera]\nfar = inf\n").far, kInfinity);
  for (const char* word : {"eye", "ray", "inverse", "normalised", "device"}) {
    const std::string range = "near = 1\nfar = 9\n";
    EXPECT_EQ(scene_of("[camera]\n" + range + "depth = \"" + word + "\"\n").depth,
              depth_kind_named(word));
  }
  EXPECT_EQ(error_of([] { depth_kind_named("normalized"); }),
            "depth kind 'normalized': expected one of eye, ray, inverse, normalised, device; did "
            "you mean 'normalised'?");
}

TEST(SceneFile, ErrorsGivePlaceAndWhatWasExpected) {
  struct Case {
    std::string text;
    const char* place;
    const char* says;
  };
  const std::string camera = "[camera]\n" + kView;
  const Case cases[] = {
      {"[geometry]\nglft = \"a.gltf\"\n", ":2:1:", "did you mean 'gltf'?"},
      {"[geometry]\n", ":1:", "expected gltf = FILE"},
      {"[water]\nwaves = [[0.1, 1, 2]]\n", ":2:10:", "water.waves[0]"},
      {"[water]\nwaves = {a = 1}\n", ":2:9: ", "water.waves = a table: expected a list of [ampl"},
      {"[watr]\n",
       ":1:", "unknown table 'watr': expected one of geometry, plates, camera, water, sun"},
      {"water = 3\n", ":1:9: ", "water = 3: expected a table"},
      {"[plates]\ncolour = \"a.exr\"\n", ":2:1: ", "did you mean 'color'?"},
      {"[plates]\ncolor = 3\n", ":2:9: ", "plates.color = 3: expected a string"},
      {"[plates]\ncolor = \"\"\n", ":2:9: ", "expected FILE or FILE:CHANNELS"},
      {"[plates]\ncolor = \":Z\"\n", ":2:9: ", "expected FILE or FILE:CHANNELS"},
      {"[plates]\ncolor = \"a.exr:\"\n", ":2:9: ", "expected FILE or FILE:CHANNELS"},
      {"[plates]\nenvironment = \"\"\n", ":2:15: ", "environment = \"\": expected FILE"},
      {"[plates]\nenvironment = 3\n", ":2:15: ", "plates.environment = 3: expected a string"},
      {"[plates]\nenviroment = \"a\"\n", ":2:1: ", "did you mean 'environment'?"},
      {"[plates]\nenvironment_rotation = 3\n",
       ":2:1: ", "plates.environment_rotation: expected an environment beside it"},
      {"[plates]\nenvironment = \"a\"\nenvironment_rotation = inf\n",
       ":3:24: ", "environment_rotation = inf: expected a finite number"},
      {"[water]\nupp = [0, 1, 0]\n", ":2:1: ", "did you mean 'up'?"},
      {"[water]\nup = [0, 0, 0]\n", ":2:6: ", "= [0, 0, 0]: expected a vector that is not zero"},
      {"[water]\nup = [0, nan, 0]\n", ":2:10: ", "water.up[1] = nan: expected a finite number"},
      {"[water]\nup = [0, 1]\n", ":2:6: ", "water.up = [0, 1]: expected a list of 3 numbers"},
      {"[water]\nup = \"y\"\n", ":2:6: ", "water.up = \"y\": expected a list of 3 numbers"},
      {"[water]\nheight = inf\n", ":2:10: ", "water.height = inf: expected a finite number"},
      {"[sun]\ncolor = [1, 1, 1]\n", ":1:", "sun: expected a direction"},
      {"[sun]\ndirection = [0, 1, 0]\ndiameter = 0\n",
       ":3:12: ", "sun.diameter = 0: expected 0.01 ... 90 (degrees)"},
      {"[sky]\n", ":1:", "sky: expected its radiance"},
      {"[sky]\nradiance = [1, 1, -1]\n",
       ":2:12: ", "sky.radiance = [1, 1, -1]: expected three numbers, each 0 ... 1e+09"},
      {"[sun]\ndirection = [0, inf, 0]\n", ":2:17: ", "expected a finite number"},
      {"[sun]\ndirection = [0, 1, 0]\ncolor = [1, -1, 1]\n",
       ":3:9: ", "three numbers, each 0 ... 1e+09"},
      {"[sun]\ndirection = [0, 1, 0]\ncolor = [1, 1, 1.001e9]\n",
       ":3:9: ", "three numbers, each 0 ... 1e+09"},
      {"[camera]\nfovx = 40\n", ":2:1: ", "did you mean 'fov_x'?"},
      {"[camera]\nview = 1\n", ":2:1: ", "camera.view: expected one of projection, fov_x, fov_y"},
      {"[camera]\nfov_x = 40\n", ":2:1: ", "camera.fov_x: expected a view beside it"},
      {"[camera]\nclip = \"gl\"\n", ":2:1: ", "camera.clip: expected a projection beside it"},
      {camera + "fov_x = 40\nfov_y = 30\n", ":4:1: ", "expected only one of projection, fov_x"},
      {camera + "fov_x = 180\n", ":3:9: ", "camera.fov_x = 180: expected degrees above 0"},
      {camera + "fov_y = nan\n", ":3:9: ", "camera.fov_y = nan: expected a finite number"},
      {camera + "orthographic = 0\n", ":3:16: ", "orthographic extent 0"},
      {camera + "fov_x = 40\nnear = 0\n", ":3:9: ", "camera: near 0"},
      {camera + "orthographic = 4\nfar = inf\n", ":3:16: ", "both finite"},
      {camera + "fov_x = 40\nclip = \"vulkan\"\n", ":4:8: ", "expected one of gl, d3d, reversed"},
      {camera + "fov_x = 40\nclip = 1\n", ":4:8: ", "expected one of gl, d3d, reversed"},
      {camera + "fov_x = 40\ndepth = \"device\"\n", ":4:9: ", "expected near and far beside fov_x"},
      {camera + "projection = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]\n",
       ":3:14: ", "camera.projection = a list of 3: expected a list of 4 rows of 4 numbers"},
      {camera + "projection = [[1, 0, 0, 0], [0, 1, 0], [0, 0, 1, 0], [0, 0, -1, 0]]\n",
       ":3:29: ", "camera.projection[1] = [0, 1, 0]: expected a list of 4 numbers"},
      {camera + projection_with("[0, 0, inf, 0]"), ":3:50: ", "camera.projection[2][2] = inf"},
      {camera + "projection = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 0]]\n",
       ":3:14: ", "the last row of the projection is neither"},
      {"[camera]\nfov_x = 40\nview = [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]]\n",
       ":3:8: ", "the view matrix scales or shears"},
      {"[camera]\ndepth = \"z\"\n", ":2:9: ", "expected one of eye, ray, inverse, normalised"},
      {"[camera]\ndepth = \"normalised\"\nnear = 1\n", ":2:9: ", "near and a finite far"},
      {"[camera]\ndepth = \"normalised\"\nnear = 1\nfar = inf\n", ":2:9: ", "a finite far"},
      {"[camera]\nnear = 2\nfar = 1\n", ":3:7: ", "camera.far = 1: expected more than near"},
      {"[camera]\nnear = inf\n", ":2:8: ", "camera.near = inf: expected a finite number"},
      {"[camera]\nfar = nan\n", ":2:7: ", "camera.far = nan: expected a number or inf"},
      {"[camera]\nfar = -inf\n", ":2:7: ", "camera.far = -inf: expected a number or inf"},
      {"[camera]\nfar = \"inf\"\n", ":2:7: ", "camera.far = \"inf\": expected a number or inf"},
  };
  for (const Case& c : cases) {
    const fs::path path = written("bad.toml", c.text);
    const std::string sentence = error_of([&] { load_scene(path); });
    EXPECT_THAT(sentence, StartsWith(path.string() + c.place)) << c.text;
    EXPECT_THAT(sentence, HasSubstr(c.says)) << c.text;
  }
}

/// Values of a wrong type and, by the kind of the key, NaN, infinity and other shapes.
TEST(SceneFile, EveryKeyRefusesWhatItsDeclarationDoes) {
  int values = 0;
  for (const SceneTable& table : scene_tables()) {
    for (const SceneKey& key : table.keys) {
      const std::string name = std::string(table.name) + "." + std::string(key.name);
      // What other keys must stand beside it.
      std::string beside = "[" + std::string(table.name) + "]\n";
      if (key.name == "environment_rotation") beside += "environment = \"a\"\n";
      if (table.name == "sun" && key.name != "direction") beside += "direction = [0, 1, 0]\n";
      const bool lens =
          key.name == "projection" || key.name == "orthographic" || key.name.starts_with("fov_");
      if (lens || key.name == "clip") beside += kView;
      if (key.name == "view" || key.name == "clip") beside += "fov_x = 40\n";
      const auto refused = [&](const std::string& value) {
        ++values;
        EXPECT_THAT(error_of([&] { scene_of(beside + std::string(key.name) + " = " + value); }),
                    HasSubstr(": " + name))
            << name << " = " << value;
      };
      refused("true");
      refused(key.kind == FieldKind::kFile ? "\"\"" : "\"nonesuch\"");
      if (key.kind == FieldKind::kReal) refused("nan");
      if (key.kind == FieldKind::kReal && key.name != "far") refused("inf");
      if (key.kind == FieldKind::kColor) refused("[1, 1, 1.001e9]");
      if (key.kind == FieldKind::kDirection) refused("[0, 0, 0]");
      if (key.kind == FieldKind::kMatrix) refused("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
      if (key.kind == FieldKind::kTable) refused("[[1, 2, 3, inf]]");
    }
  }
  EXPECT_GT(values, 60);
}

TEST(SceneFile, TheExampleOfThePageIsRead) {
  std::ifstream page(fs::path(LIMPID_DATA) / "../docs/files.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  const std::size_t begin = text.find("```toml\n"), end = text.find("\n```\n", begin);
  ASSERT_LT(end, text.size());
  const SceneFile file = scene_from_toml(text.substr(begin + 8, end - begin - 8), "page");
  EXPECT_EQ(file.plates.at("depth"), "beauty.####.exr:ViewLayer.Depth.Z");
  EXPECT_TRUE(file.camera && file.scene.sun);
  EXPECT_TRUE(file.scene.has_waves());
}

TEST(CameraFor, RefusesPicturesWithoutShape) {
  const SceneFile file = scene_of("[camera]\n" + kView + "fov_x = 90\n");
  EXPECT_THAT(error_of([&] { camera_for(*file.camera, {0, 540}); }), HasSubstr("0x540"));
  EXPECT_THAT(error_of([&] {
                camera_for(*file.camera, {960, 540}, 0);
              }),
              HasSubstr("pixel aspect 0"));
  EXPECT_THAT(error_of([&] {
                camera_for(*file.camera, {960, 540}, std::nan(""));
              }),
              HasSubstr("pixel aspect nan"));
}

TEST(SceneFile, WrittenOutReadsBackToTheBit) {
  Scene scene;
  Camera camera;
  camera.view[3] = {0.1, -1.0 / 3, 5e-9, 1};
  camera.projection = perspective(0.7, 1.7, 0.1, 333, ClipSpace::kReversed, {0.1, 0});
  camera.clip = ClipSpace::kReversed;
  scene.camera = camera;
  scene.water =
      WaterPlane{glm::normalize(glm::dvec3(0.1, 0.9, -0.3)), 1.0 / 7, {{0.1, 2, 3, 4, 5}}};
  scene.sun = Sun{glm::normalize(glm::dvec3(3, 1, 2)), {1.0 / 3, 2, 0}};
  const SceneFile back = scene_from_toml(to_toml(scene), "text");
  const Camera read = camera_for(*back.camera, {170, 100});
  EXPECT_EQ(read.view, camera.view);
  EXPECT_EQ(read.projection, camera.projection);
  EXPECT_EQ(read.clip, camera.clip);
  EXPECT_EQ(back.scene.water->up, scene.water->up);
  EXPECT_EQ(back.scene.water->height, scene.water->height);
  ASSERT_EQ(back.scene.water->waves.size(), 1u);
  EXPECT_EQ(back.scene.water->waves[0].omega, 5);
  EXPECT_EQ(back.scene.sun->direction, scene.sun->direction);
  EXPECT_EQ(back.scene.sun->color, scene.sun->color);
}

TEST(SceneFile, ASceneOfAnyOriginKeepsTheSunWithinItsRange) {
  Scene scene;
  scene.sun = Sun{{0, 1, 0}, {0, Sun::kBrightest, 1}};
  EXPECT_NO_THROW(scene.validate());
  scene.sun->color.b = 2e9;
  EXPECT_EQ(error_of([&] { scene.validate(); }),
            "sun.color has a channel 2e+09, expected 0 ... 1e+09");
  scene.sun->color.b = std::nan("");
  EXPECT_EQ(error_of([&] { scene.validate(); }),
            "sun.color has a channel nan, expected 0 ... 1e+09");
}

TEST(SceneFile, WavesGetTheSpeedOfDeepWater) {
  const SceneFile file = scene_from_toml("[water]\nwaves = [[0.1, 3, 4, 0.5]]\n", "text");
  EXPECT_NEAR(file.scene.water->waves[0].omega, std::sqrt(9.81 * 5), 1e-12);
}

/// 9.81 |k| is beyond the largest double here, and its root is not.
TEST(SceneFile, WavesOfAnyFiniteNumbersCanBeWrittenAndRead) {
  const Scene scene =
      scene_from_toml("[water]\nwaves = [[1e308, 1.7e308, 1.7e308, 1e308]]\n", "text").scene;
  const SineWave& wave = scene.water->waves[0];
  EXPECT_NEAR(wave.omega / std::sqrt(1.7e308), std::sqrt(9.81 * std::numbers::sqrt2), 1e-12);
  EXPECT_NO_THROW(scene.validate());
  EXPECT_EQ(scene_from_toml(to_toml(scene), "again").scene.water->waves[0].omega, wave.omega);
}

/// The longest texts that numbers have.
TEST(SceneFile, AsManyWavesAsMayBeReadAgain) {
  const std::string number = "-1.2345678901234567e-300";
  const std::string wave =
      "[" + number + ", " + number + ", " + number + ", " + number + ", " + number + "],\n";
  std::string waves;
  for (std::size_t i = 0; i < kMaxWaves; ++i) waves += wave;
  Scene scene = scene_from_toml("[water]\nwaves = [\n" + waves + "]\n", "text").scene;
  ASSERT_EQ(scene.water->waves.size(), kMaxWaves);
  EXPECT_EQ(to_toml(scene_from_toml(to_toml(scene), "text").scene), to_toml(scene));
  // With the longest of all else.
  const glm::dmat4 matrix(std::stod(number));
  scene.camera = Camera{matrix, matrix, ClipSpace::kReversed};
  scene.sun = Sun{};
  EXPECT_LT(to_toml(scene).size(), std::size_t{255} << 10);

  EXPECT_EQ(error_of([&] { scene_from_toml("[water]\nwaves = [" + waves + wave + "]\n", "text"); }),
            "text:2:9: water.waves: 1025 waves: expected at most 1024");
  scene.water->waves.emplace_back();
  EXPECT_EQ(error_of([&] { to_toml(scene); }), "water.waves: 1025 waves: expected at most 1024");
}

TEST(SceneFile, TimeAndNothingAreKnownAsGiven) {
  const SceneFile bare = scene_of("[camera]\ndepth = \"eye\"\n");
  EXPECT_FALSE(bare.time.has_value());
  EXPECT_FALSE(bare.depth_nothing.has_value());
  const SceneFile file = scene_of("[camera]\ndepth_nothing = 0\n[scene]\ntime = 0\n");
  EXPECT_EQ(file.time, 0.0);
  EXPECT_EQ(file.depth_nothing, 0.0);
  EXPECT_THAT(error_of([] { scene_of("[camera]\ndepth_nothing = inf\n"); }),
              HasSubstr("camera.depth_nothing"));
}

TEST(SceneFile, Primaries) {
  EXPECT_EQ(scene_of("[scene]\ntime = 1\n").primaries, std::nullopt);
  EXPECT_EQ(scene_of("[scene]\ncolorspace = \"ACEScg\"\n").primaries, find_color_space("ACEScg"));
  EXPECT_EQ(scene_of("[scene]\ncolorspace = \"Rec.709\"\n").primaries, kRec709);
  EXPECT_THAT(error_of([] { scene_of("[scene]\ncolorspace = \"sRGB\"\n"); }),
              HasSubstr("scene.toml:2:14: scene.colorspace: color space 'sRGB': expected one of "));
  // Written where they are not the usual ones, and read back to the bit.
  Scene scene;
  EXPECT_THAT(to_toml(scene), testing::Not(HasSubstr("colorspace")));
  for (const char* text : {"ACES2065-1", "0.6 0.3 0.2 0.7 0.15 0.06 0.31 0.330001"}) {
    scene.primaries = color_space_named(text);
    EXPECT_EQ(scene_from_toml(to_toml(scene), "scene").scene.primaries, scene.primaries);
  }
}

}  // namespace
}  // namespace limpid
