#include <cmath>
#include <map>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "op/caustics_table.h"
#include "ops/contract.h"
#include "plan/landscape.h"
#include "shade/bundled.h"
#include "shade/recorded.h"
#include "shade/symbol.h"

/// Recordings of operators: the program computes the values of run_reference(), and contains no
/// number of the frame.

namespace limpid {
namespace {

using test::Below;
using test::Buffers;
using test::Recorded;

/// All models, and parameters from their whole ranges, between the other operators with their
/// defaults.
TEST(Recording, OfEveryOperatorWithEveryModelIsTheReference) {
  Chain::for_each([]<class Op, int I>() {
    for (int seed = 0; seed < 24; ++seed) {
      const test::World world(seed % 2 == 0);
      Look look;
      look.of<Op>() = test::random_params<Op>(seed);
      const Recorded recorded(look, world.buffers.frame, world.scene);
      recorded.expect_reference(5);
      if (HasFatalFailure()) FAIL() << Op::kName << ", seed " << seed;
    }
  });
}

/// A landscape under waves that focus light: a small frame of noise has room for no table.
struct Shallows {
  explicit Shallows(int seed)
      : size{60, 34},
        scene(scene_of(size)),
        buffers(test::landscape(rect_of(size), scene, seed, seed % 2 == 0,
                                seed % 3 == 0 ? Below::kNone : Below::kHoles)),
        map(16, 8) {
    buffers.frame.wave_map = map.texture;
    const auto noisy = [&](PlaneId plane, int of) {
      buffers.set(plane, [=](int x, int y) { return test::noise(x / 3, y / 3, of); });
    };
    if (seed % 4 > 0) noisy(PlaneId::kShadow, seed);
    if (seed % 4 > 1) noisy(PlaneId::kSurfaceShadow, seed + 1);
  }
  static Scene scene_of(Size size) {
    Scene scene = test::simple_scene(size);
    scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0.1, 1.4, -1), {0, 1, 0});
    scene.water->waves = {{0.02, 3, 1, 0.4, 2}, {0.01, -1, 5, 1.4, 3}};
    scene.time = 1.7;
    return scene;
  }
  Size size;
  Scene scene;
  Buffers buffers;
  test::NoiseMap map;
};

/// How many levels of the tables of sunlight a recording looks up, of those that hold light.
struct Tables {
  int of_bottom = 0, in_water = 0;
};

Tables tables_of(const Recorded& recorded) {
  Tables found;
  const Recording& recording = recorded.recording();
  for (std::size_t i = 0; i < recording.nodes.size(); ++i) {
    const Node& node = recording.nodes[i];
    if (!recording.live[i] || node.op != NodeOp::kGrid) continue;
    const int place = node.what - static_cast<int>(TextureId::kCaustics);
    for (const CausticsTable* table = recorded.pass().caustics; table; table = table->in_water) {
      const bool has = place >= table->first && place < table->first + table->count;
      (table == recorded.pass().caustics ? found.of_bottom : found.in_water) += has;
    }
  }
  return found;
}

TEST(Recording, OfEveryOperatorIsTheReferenceWhereWavesFocusLight) {
  Tables all;
  Chain::for_each([&]<class Op, int I>() {
    for (int seed = 0; seed < 6; ++seed) {
      const Shallows shallows(seed);
      Look look = test::shipped_look("physical");
      look.of<WaveNormals>().model = WaveNormals::Model::kSines;
      look.of<Caustics>().strength = seed % 5 == 0 ? 0 : 1;
      look.of<WaterShadow>().shafts = 0.3;
      look.of<Op>() = test::random_params<Op>(seed);
      const Recorded recorded(look, shallows.buffers.frame, shallows.scene);
      recorded.expect_reference(11);
      if (HasFatalFailure()) FAIL() << Op::kName << ", seed " << seed;
      const Tables tables = tables_of(recorded);
      all.of_bottom += tables.of_bottom > 0, all.in_water += tables.in_water > 0;
    }
  });
  EXPECT_GE(all.of_bottom, 25);
  EXPECT_GE(all.in_water, 25);
}

TEST(Recording, OfShippedLooksIsTheReferenceOverLandscapes) {
  int seed = 0;
  for (const char* name : test::kShippedLooks) {
    for (const Below below : {Below::kNone, Below::kHoles}) {
      for (const bool surface : {false, true}) {
        ++seed;
        const Size size{72, 40};
        Scene scene = test::simple_scene(size);
        scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0.1, 1.6, -1), {0, 1, 0});
        scene.sky = SkyLight{{0.4, 0.5, 0.6}};
        scene.time = 1.7;
        Buffers b = test::landscape(rect_of(size), scene, seed, surface, below);
        const test::NoiseMap map(16, 8);
        b.frame.wave_map = map.texture;
        const Recorded recorded(test::shipped_look(name), b.frame, scene);
        recorded.expect_reference(2);
        if (HasFatalFailure()) FAIL() << name << ", landscape " << seed;
      }
    }
  }
}

TEST(Recording, OfShippedLooksIsTheReferenceOverBundledScenes) {
  test::for_each_bundled({96, 54}, [](const std::string& name, Subject& subject) {
    for (const char* look_name : test::kShippedLooks) {
      const Look look = test::shipped_look(look_name);
      const Frame frame = subject.frame_for(subject.plan(look));
      const Recorded recorded(look, frame, subject.scene());
      recorded.expect_reference(static_cast<int>(frame.work().area() / 700));
      if (HasFatalFailure()) FAIL() << look_name << ", " << name;
    }
  });
}

TEST(Recording, OfAViewThatBeginsInTheWaterIsTheReference) {
  for (const char* name : test::kShippedLooks) {
    const Size size{60, 40};
    Scene scene = test::simple_scene(size);
    scene.water->waves = {{0.02, 3, 1, 0.4, 2}, {0.01, -1, 5, 1.4, 3}};
    scene.camera->view = glm::lookAt(glm::dvec3(0, 0.03, 0), glm::dvec3(0.1, 0.02, -1), {0, 1, 0});
    scene.time = 2.5;
    Buffers b(rect_of(size));
    for (int c = 0; c < 3; ++c) {
      b.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) { return test::noise(x, y, c); });
    }
    b.set(PlaneId::kDepth, [](int x, int y) { return 1 + 6 * test::noise(x / 3, y / 3, 9); });
    const test::NoiseMap map(16, 8);
    b.frame.wave_map = map.texture;
    const Recorded recorded(test::shipped_look(name), b.frame, scene);
    EXPECT_TRUE(recorded.pass().submersible);
    recorded.expect_reference();
    if (HasFatalFailure()) FAIL() << name;
  }
}

}  // namespace
}  // namespace limpid
