#include <cmath>
#include <cstring>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ops/contract.h"
#include "ops/kernels.h"

// The promises of every operator of the chain, tested in pictures of noise.

namespace limpid {
namespace {

using test::for_each_params;
using test::kContractSize;
using test::Picture;
using test::random_params;
using test::World;

/// Of the picture and the AOVs that are results, not planes that are read.
bool same_bits(const Picture& a, const Picture& b) {
  const auto same = [](const View<float>& x, const View<float>& y) {
    for (int row = x.window.y0; row < x.window.y1; ++row) {
      const std::size_t bytes = static_cast<std::size_t>(x.window.width()) * sizeof(float);
      if (std::memcmp(x.row(row), y.row(row), bytes) != 0) return false;
    }
    return true;
  };
  for (std::size_t c = 0; c < 3; ++c) {
    if (!same(a.target.color[c], b.target.color[c])) return false;
  }
  for (std::size_t i = 0; i < aovs().size(); ++i) {
    if (!aovs()[i].planes.empty()) continue;
    for (std::size_t c = 0; c < aovs()[i].suffixes.size(); ++c) {
      if (!same(a.target.aovs[i][c], b.target.aovs[i][c])) return false;
    }
  }
  return true;
}

/// A plan that keeps all operators that can run, neutral ones too.
Plan eager_plan(const Look& look, const World& world) {
  const Inputs inputs = test::inputs_of(world.buffers.frame, world.scene);
  Plan plan = make_plan(look, inputs, test::all_state());
  Kernels::for_each([&]<class Op, int I>() {
    if (plan.operators[I].verdict == Verdict::kAbsent) return;
    plan.operators[I].verdict = Verdict::kKept;
    plan.made = plan.made | Op::kMakes;
    plan.planes = plan.planes | (Op::reads(plan.look.of<Op>()) & inputs.planes);
  });
  return plan;
}

Picture run(const Plan& plan, const World& world) {
  Picture picture(world.buffers.frame.work());
  run_reference(plan, world.buffers.frame, world.scene, picture.target);
  return picture;
}

TEST(Contract, SkippingWhatIsNeutralChangesNoPictureAndNoAov) {
  std::set<std::string_view> skipped;
  for (bool plate_normals : {false, true}) {
    const World world(plate_normals);
    Kernels::for_each([&]<class Op, int I>() {
      for_each_params<Op>([&](const auto& params, const std::string& what) {
        Look look = test::article_look();
        look.of<PrismSplit>().strength = std::is_same_v<Op, Kernel<Refraction>> ? 0 : 0.01;
        look.of<Op>() = params;
        const Plan plan =
            make_plan(look, test::inputs_of(world.buffers.frame, world.scene), test::all_state());
        if (plan.keeps(I)) return;
        skipped.insert(Op::kName);
        ASSERT_TRUE(same_bits(run(plan, world), run(eager_plan(look, world), world))) << what;
      });
    });
  }
  // Refraction and fog stay, because they make the path.
  EXPECT_THAT(skipped, testing::IsSupersetOf(
                           {"wave_normals", "prism_split", "water_shadow", "sun_highlight"}));
}

TEST(Contract, ValidInputMakesNoNan) {
  for (bool plate_normals : {false, true}) {
    const World world(plate_normals);
    Kernels::for_each([&]<class Op, int>() {
      for_each_params<Op>([&](const auto& params, const std::string& what) {
        Look look = test::article_look();
        look.of<PrismSplit>().strength = 0.01;
        look.of<Op>() = params;
        for (const Picture& picture : {test::reference(look, world.buffers.frame, world.scene),
                                       test::fused(look, world.buffers.frame, world.scene)}) {
          for (float v : picture.values()) ASSERT_FALSE(std::isnan(v)) << what;
          for (int y = 0; y < kContractSize.height; ++y) {
            for (int x = 0; x < kContractSize.width; ++x) {
              const Rgb<double> c = picture.color(x, y);
              ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b)) << what;
            }
          }
        }
      });
    });
  }
}

TEST(Contract, FloatAgreesWithDoubleAndTilesWithTheWhole) {
  for (bool plate_normals : {false, true}) {
    const World world(plate_normals);
    Kernels::for_each([&]<class Op, int>() {
      for (int seed = 0; seed < 10; ++seed) {
        Look look = test::article_look();
        look.of<Op>() = random_params<Op>(seed);
        const Frame& frame = world.buffers.frame;
        const std::vector<float> judge = test::reference(look, frame, world.scene).values();
        const Picture whole = test::fused(look, frame, world.scene);
        const std::vector<float> got = whole.values();
        const std::size_t pixels = kContractSize.width * kContractSize.height;
        std::set<std::size_t> far;  // pixels
        for (std::size_t i = 0; i < judge.size(); ++i) {
          const bool near =
              judge[i] == got[i] || std::abs(judge[i] - got[i]) < 3e-4 * (1 + std::abs(judge[i]));
          if (!near) far.insert(i % pixels);
        }
        // A depth lookup on the edge of two texels may round either way.
        EXPECT_LE(far.size(), pixels / 100) << Op::kName << ", seed " << seed;
        EXPECT_TRUE(same_bits(whole, test::fused(look, frame, world.scene, {.tile = {5, 3}}, 2)))
            << Op::kName << ", seed " << seed;
      }
    });
  }
}

TEST(Contract, PlanesThatThePlanDoesNotReadDoNotMatter) {
  const World world;
  Kernels::for_each([&]<class Op, int>() {
    Look look = test::still_look();
    look.of<Op>() = typename Op::Params{};
    const Inputs all = test::inputs_of(world.buffers.frame, world.scene);
    Plan plan = make_plan(look, all, {});
    // Only this operator and the waves that it may read.
    plan.made = {};
    plan.planes =
        kColorPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kSurfaceDepth};
    Kernels::for_each([&]<class Other, int J>() {
      const bool on = std::is_same_v<Other, Op> || std::is_same_v<Other, Kernel<WaveNormals>>;
      plan.operators[J].verdict = on ? Verdict::kKept : Verdict::kUnread;
      if (!on) return;
      plan.made = plan.made | Other::kMakes;
      plan.planes = plan.planes | Other::reads(plan.look.of<Other>());
    });
    World garbage;
    for (int i = 0; i < kPlaneCount; ++i) {
      const PlaneId id = static_cast<PlaneId>(i);
      if (!plan.planes.has(id)) garbage.buffers.fill(id, 1e30f);
    }
    EXPECT_TRUE(same_bits(run(plan, world), run(plan, garbage))) << Op::kName;
  });
}

}  // namespace
}  // namespace limpid
