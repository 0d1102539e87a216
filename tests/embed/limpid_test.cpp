#include "limpid/limpid.h"

#include <cctype>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <glm/gtc/type_ptr.hpp>
#include <gmock/gmock.h>

#include "limpid/version.h"

#include "embed/host.h"
#include "embed/limpid_c.h"
#include "paths.h"

/// The C functions, called as C calls them.

namespace limpid {
namespace {

using test::Picture;
using test::c::channel;
using test::c::kSize;
using test::c::LimpidC;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(LimpidC, GivesTheBitsOfTheFusedRunner) {
  ASSERT_NE(water, nullptr);
  EXPECT_STREQ(limpid_message(water), "");
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK) << limpid_message(water);
  EXPECT_EQ(out.values(), expected({}));
}

TEST_F(LimpidC, SetsTheLookAKeyAtATime) {
  Look look;
  look.of<DepthFog>().density = 0.7;
  look.of<Refraction>().rejection = Refraction::Rejection::kSnap;
  look.of<DepthFog>().color = {0.1, 0.2, 0.4};
  look.set("wave_normals", "waves", Rows{{0.02, 1, 2, 0}, {0.01, 3, 1, 1}});
  EXPECT_EQ(limpid_set_number(water, "depth_fog", "density", 0.7), LIMPID_OK);
  EXPECT_EQ(limpid_set_word(water, "refraction", "rejection", "snap"), LIMPID_OK);
  const double rgb[3] = {0.1, 0.2, 0.4}, rows[8] = {0.02, 1, 2, 0, 0.01, 3, 1, 1};
  EXPECT_EQ(limpid_set_color(water, "depth_fog", "color", rgb), LIMPID_OK);
  EXPECT_EQ(limpid_set_rows(water, "wave_normals", "waves", rows, 2, 4), LIMPID_OK)
      << limpid_message(water);
  std::string text(limpid_look_text(water, nullptr, 0), ' ');
  EXPECT_EQ(limpid_look_text(water, text.data(), text.size() + 1), text.size());
  EXPECT_EQ(text, to_toml(look));
  char cut[6] = "?????";
  EXPECT_EQ(limpid_look_text(water, cut, sizeof cut), text.size());
  EXPECT_EQ(cut, text.substr(0, 5));
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK);
  EXPECT_EQ(out.values(), expected(look));

  EXPECT_EQ(limpid_set_number(water, "depth_fog", "density", -1), LIMPID_REFUSED);
  EXPECT_THAT(limpid_message(water), StartsWith("depth_fog.density = -1: expected"));
  EXPECT_EQ(limpid_set_number(water, "depth_fog", "densty", 1), LIMPID_REFUSED);
  EXPECT_THAT(limpid_message(water), HasSubstr("did you mean 'density'"));
  EXPECT_EQ(limpid_set_word(water, "refraction", "rejection", nullptr), LIMPID_REFUSED);
  EXPECT_EQ(limpid_set_number(water, nullptr, "density", 1), LIMPID_REFUSED);
  EXPECT_EQ(limpid_set_color(water, "depth_fog", "color", nullptr), LIMPID_REFUSED);
  EXPECT_EQ(limpid_set_rows(water, "wave_normals", "waves", nullptr, 2, 4), LIMPID_REFUSED);
  EXPECT_EQ(limpid_look_text(water, nullptr, 0), text.size());
  EXPECT_EQ(limpid_reset_look(water), LIMPID_OK);
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK);
  EXPECT_EQ(out.values(), expected({}));
}

TEST_F(LimpidC, MatricesMayLieRowAfterRow) {
  limpid_destroy(water);
  conventions.row_major = 1;
  ASSERT_EQ(limpid_create(&conventions, nullptr, &water, nullptr, 0), LIMPID_OK);
  for (double* matrix : {frame.view, frame.projection}) {
    set_matrix(matrix, glm::transpose(glm::make_mat4(matrix)));
  }
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK) << limpid_message(water);
  EXPECT_EQ(out.values(), expected({}));
}

TEST_F(LimpidC, TellsItsPlan) {
  EXPECT_EQ(limpid_plan_text(water, nullptr, 0), 0u);  // no run yet
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK);
  char text[2048];
  EXPECT_EQ(limpid_replaced_text(water, nullptr, 0), 0u);  // the frame is trusted
  EXPECT_GT(limpid_plan_text(water, text, sizeof text), 100u);
  EXPECT_THAT(text, StartsWith("wave_normals"));
}

TEST_F(LimpidC, TellsWhatItReplaced) {
  limpid_destroy(water);
  ASSERT_EQ(limpid_create(nullptr, nullptr, &water, nullptr, 0), LIMPID_OK);
  buffers.set(PlaneId::kColorB, [](int x, int) { return x == 3 ? NAN : 0.5f; });
  planes[2] = channel(2, buffers.frame.planes[2]);
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK) << limpid_message(water);
  char text[64];
  limpid_replaced_text(water, text, sizeof text);
  EXPECT_STREQ(text, "color 23 NaN");
}

TEST_F(LimpidC, RunsOnTheHostsThreads) {
  limpid_destroy(water);
  int tasks = 0;
  limpid_executor host{sizeof host, &tasks,
                       [](void* counter, int count, limpid_task task, void* c) {
                         *static_cast<int*>(counter) += count;
                         for (int i = count; i-- > 0;) task(c, i);
                       }};
  limpid_options options = LIMPID_OPTIONS;
  options.executor = &host;
  options.simd = "scalar";
  ASSERT_EQ(limpid_create(&conventions, &options, &water, nullptr, 0), LIMPID_OK);
  host = {};  // limpid_create() has copied the struct
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK) << limpid_message(water);
  EXPECT_GT(tasks, 1);
}

TEST_F(LimpidC, TexturesAndAovs) {
  // A frame without normals takes the normals of a map.
  planes.erase(planes.begin() + LIMPID_SURFACE_NORMAL_X,
               planes.begin() + LIMPID_SURFACE_NORMAL_X + 3);
  frame.planes = planes.data();
  frame.plane_count = planes.size();
  Look look;
  look.of<WaveNormals>().model = WaveNormals::Model::kFourMaps;
  limpid_set_word(water, "wave_normals", "model", "four_maps");
  std::vector<float> pixels(5 * 16 * 8);
  const test::NoiseMap map(16, 8);
  for (int i = 0; i < 16 * 8; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      pixels[5 * static_cast<std::size_t>(i) + c] = map.texture.channels[c].at(i % 16, i / 16);
    }
  }
  limpid_texture texture{sizeof texture, pixels.data(), 16, 8, 5, 0};
  ASSERT_EQ(limpid_set_wave_map(water, &texture), LIMPID_OK) << limpid_message(water);
  for (int c = 0; c < 3; ++c) {
    outputs.push_back(channel(LIMPID_OUT_NORMAL + c, out.target.of(Aov::kNormal)[c]));
  }
  picture.outputs = outputs.data();
  picture.output_count = outputs.size();
  ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK) << limpid_message(water);
  for (int c = 0; c < 3; ++c) buffers.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
  buffers.frame.wave_map = map.texture;
  const Picture judge = [&] {
    Picture p(rect_of(kSize));
    Scene scene = test::simple_scene(kSize);
    scene.sun->direction = glm::normalize(3.0 * scene.sun->direction);
    run_fused(make_plan(look, test::inputs_of(buffers.frame, scene), test::all_state()),
              buffers.frame, scene, p.target, *make_executor(1));
    return p;
  }();
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      ASSERT_EQ(out.aov(Aov::kNormal, x, y), judge.aov(Aov::kNormal, x, y));
    }
  }
  texture.data = reinterpret_cast<const float*>(reinterpret_cast<const char*>(pixels.data()) + 1);
  EXPECT_EQ(limpid_set_wave_map(water, &texture), LIMPID_REFUSED);
  texture.data = pixels.data();
  texture.channels = 2;
  EXPECT_EQ(limpid_set_wave_map(water, &texture), LIMPID_REFUSED);
  EXPECT_EQ(limpid_set_environment(water, &texture), LIMPID_REFUSED);
  EXPECT_EQ(limpid_set_environment(water, nullptr), LIMPID_OK);
  EXPECT_EQ(limpid_set_wave_map(water, nullptr), LIMPID_OK);
}

TEST_F(LimpidC, RefusesFramesThatAreNone) {
  planes[2].id = LIMPID_COLOR_R;
  expect_refused("limpid_frame.planes[2].id = 0: it is given twice");
  planes[2].id = LIMPID_BASIN + 1;
  expect_refused("limpid_frame.planes[2].id = 30");
  planes[2].id = LIMPID_COLOR_B;
  planes[2].sample = 2;
  expect_refused("limpid_frame.planes[2].sample = 2");
  planes[2].sample = LIMPID_FLOAT;
  planes[2].data = nullptr;
  expect_refused("limpid_frame.planes[2].data is NULL");
  planes[2] = channel(2, buffers.frame.planes[2]);
  frame.planes = nullptr;
  expect_refused("limpid_frame.planes is NULL");
  frame.planes = planes.data();
  frame.width = 0;
  expect_refused("display window is empty");
  frame.width = kSize.width;
  frame.water_up[1] = 0;
  expect_refused("water_up");
  frame.water_up[1] = 1;
  frame.wave_count = 2;
  expect_refused("waves is NULL");
  frame.wave_count = 0;
  std::memset(frame.sun_direction, 0, sizeof frame.sun_direction);
  expect_refused("sun");
  frame.has_sun = 0;
  std::memset(frame.projection, 0, sizeof frame.projection);
  expect_refused("projection");
  EXPECT_EQ(limpid_run(water, nullptr, &picture), LIMPID_REFUSED);
  EXPECT_EQ(limpid_run(water, &frame, nullptr), LIMPID_REFUSED);
  EXPECT_EQ(limpid_run(nullptr, &frame, &picture), LIMPID_REFUSED);
}

/// Older callers know fewer members of a struct, and newer callers more.
TEST_F(LimpidC, StructsHaveSizes) {
  limpid_destroy(water);
  water = nullptr;
  char why[128] = "";
  conventions.near_depth = 7;  // beyond the members that an older caller knows
  conventions.depth = LIMPID_DEPTH_EYE;
  conventions.size = offsetof(limpid_conventions, near_depth);
  ASSERT_EQ(limpid_create(&conventions, nullptr, &water, why, sizeof why), LIMPID_OK) << why;
  limpid_destroy(water);
  conventions.size = sizeof conventions + 8;
  EXPECT_EQ(limpid_create(&conventions, nullptr, &water, why, sizeof why), LIMPID_REFUSED);
  EXPECT_EQ(water, nullptr);
  EXPECT_THAT(why, HasSubstr("limpid_conventions.size"));
  conventions.size = 0;
  char little[8];
  EXPECT_EQ(limpid_create(&conventions, nullptr, &water, little, sizeof little), LIMPID_REFUSED);
  EXPECT_STREQ(little, "limpid_");
  conventions.size = sizeof conventions;
  conventions.clip = 3;
  EXPECT_EQ(limpid_create(&conventions, nullptr, &water, why, sizeof why), LIMPID_REFUSED);
  EXPECT_THAT(why, StartsWith("limpid_conventions.clip = 3: expected 0 ... 2"));
  conventions.clip = 0;
  EXPECT_EQ(limpid_create(&conventions, nullptr, nullptr, why, sizeof why), LIMPID_REFUSED);
  limpid_options options = LIMPID_OPTIONS;
  options.simd = "mmx";
  EXPECT_EQ(limpid_create(&conventions, &options, &water, why, sizeof why), LIMPID_REFUSED);
  EXPECT_THAT(why, HasSubstr("simd = mmx"));
  options.simd = nullptr;
  options.runner = 2;
  EXPECT_EQ(limpid_create(&conventions, &options, &water, why, sizeof why), LIMPID_REFUSED);
  EXPECT_THAT(why, StartsWith("limpid_options.runner = 2: expected LIMPID_RUNNER_FUSED or "));
  options.runner = LIMPID_RUNNER_FUSED;
  options.gpu = "H100";
  EXPECT_EQ(limpid_create(&conventions, &options, &water, why, sizeof why), LIMPID_REFUSED);
  EXPECT_THAT(why, HasSubstr("'H100': expected LIMPID_RUNNER_GPU beside it"));
  EXPECT_STREQ(limpid_version(), kVersion);
  EXPECT_EQ(limpid_create(nullptr, nullptr, &water, nullptr, 0), LIMPID_OK);
  frame.size = sizeof frame + 1;
  expect_refused("limpid_frame.size");
}

TEST_F(LimpidC, HasAColorspace) {
  limpid_destroy(water);
  water = nullptr;
  char why[256] = "";
  Look look;
  look.set("depth_fog", "water_type", "3C");
  std::vector<std::vector<float>> pictures;
  for (const char* space : {"Rec.709", "ACEScg", ".713 .293 .165 .83 .128 .044 .32168 .33767"}) {
    conventions.colorspace = space;
    ASSERT_EQ(limpid_create(&conventions, nullptr, &water, why, sizeof why), LIMPID_OK) << why;
    ASSERT_EQ(limpid_set_word(water, "depth_fog", "water_type", "3C"), LIMPID_OK);
    for (int i = 0; i < 2; ++i) {
      ASSERT_EQ(limpid_run(water, &frame, &picture), LIMPID_OK) << limpid_message(water);
    }
    pictures.push_back(out.values());
    limpid_destroy(water);
    water = nullptr;
  }
  EXPECT_EQ(pictures[0], expected(look));
  EXPECT_NE(pictures[1], pictures[0]) << "waters are fitted to the space";
  EXPECT_EQ(pictures[2], pictures[1]);
  EXPECT_EQ(pictures[1], expected(look, *find_color_space("ACEScg")));
  conventions.colorspace = "ACEScq";
  EXPECT_EQ(limpid_create(&conventions, nullptr, &water, why, sizeof why), LIMPID_REFUSED);
  EXPECT_THAT(why, StartsWith("limpid_conventions.colorspace: color space 'ACEScq': expected one"));
  conventions.colorspace = ".64 .33 .3 .6 .15 .06 .9 .05";
  EXPECT_EQ(limpid_create(&conventions, nullptr, &water, why, sizeof why), LIMPID_REFUSED);
  EXPECT_THAT(why, HasSubstr("expected x and y of red, green, blue and a white between them"));
  EXPECT_EQ(water, nullptr);
}

std::string capitals(std::string name) {
  for (char& c : name) c = c == '.' ? '_' : static_cast<char>(std::toupper(c));
  return name;
}

/// The enumerators of an enum of limpid.h: "LIMPID_COLOR_R = 0", in their order.
std::vector<std::string> enumerators(const std::string& of) {
  std::ifstream header(LIMPID_DATA "/../include/limpid/limpid.h");
  std::vector<std::string> list;
  std::string line;
  while (std::getline(header, line) && line != "typedef enum " + of + " {") continue;
  while (std::getline(header, line) && !line.starts_with("}")) {
    list.push_back(line.substr(2, line.find_first_of(",/", 2) - 2));
    while (list.back().ends_with(' ')) list.back().pop_back();
  }
  return list;
}

TEST(LimpidH, NamesThePlanesOfAllRolesInTheirOrder) {
  std::vector<std::string> expected;
  for (const Role& role : roles()) {
    const std::string name = role.first == PlaneId::kBelowR ? "below" : std::string(role.name);
    for (int i = 0; i < role.count; ++i) {
      const char letter = (role.sanitise == Sanitise::kNormal ? "xyz" : "rgba")[i];
      expected.push_back(
          capitals("limpid_" + name + (role.count > 1 ? std::string("_") + letter : "")) + " = " +
          std::to_string(index_of(role.first) + i));
    }
  }
  EXPECT_EQ(enumerators("limpid_plane"), expected);
}

TEST(LimpidH, NamesAllAovsInTheirOrder) {
  std::vector<std::string> expected{"LIMPID_OUT_R = 0", "LIMPID_OUT_G = 1", "LIMPID_OUT_B = 2",
                                    "LIMPID_OUT_A = 3"};
  for (const AovInfo& info : aovs()) {
    const auto place = static_cast<int>(&info - aovs().data());
    expected.push_back(capitals("limpid_out_" + std::string(info.name)) + " = " +
                       std::to_string(4 + 3 * place));
  }
  EXPECT_EQ(enumerators("limpid_output"), expected);
}

}  // namespace
}  // namespace limpid
