#include "limpid/compositor.h"

#include <atomic>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"

#include "embed/host.h"
#include "embed/subject.h"

namespace limpid {
namespace {

using test::Buffers;
using test::busy_look;
using test::HostMemory;
using test::kNan;
using test::kSize;
using test::Picture;
using test::raw_frame;
using test::same_bits;
using test::Subject;
using test::valid_frame;
using test::wet;

TEST(Compositor, GivesTheBitsOfTheFusedRunner) {
  const Subject s;
  Compositor trusted({.trusted = true}, busy_look()), careful({}, busy_look());
  EXPECT_TRUE(same_bits(wet(trusted, test::host_frame(s.buffers.frame, s.scene)), s.expected));
  const Buffers raw = raw_frame(kSize);
  EXPECT_TRUE(same_bits(wet(careful, test::host_frame(raw.frame, s.scene)), s.expected));
  EXPECT_EQ(careful.replaced().total(), 0);
}

TEST(Compositor, TakesAnyStridesAndKeepsTheHostsMemory) {
  const Subject s;
  for (const HostMemory::Layout layout :
       {HostMemory::Layout{.interleaved = true}, HostMemory::Layout{.bottom_up = true},
        HostMemory::Layout{.interleaved = true, .bottom_up = true, .slack = 3},
        HostMemory::Layout{.slack = 5}}) {
    HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
    HostMemory memory(kPlaneCount, rect_of(kSize), layout), out(4, rect_of(kSize), layout);
    for (int i = 0; i < kPlaneCount; ++i) {
      test::fill(memory.channel(i), s.buffers.frame.planes[i]);
      frame.planes[i] = memory.channel(i);
    }
    HostPicture picture;
    for (int c = 0; c < 3; ++c) picture.color[static_cast<std::size_t>(c)] = out.channel(c);
    picture.alpha = out.channel(3);
    const std::vector<std::byte> before = memory.bytes();
    Compositor compositor({.trusted = true}, busy_look());
    compositor.run(frame, picture);
    EXPECT_EQ(memory.bytes(), before);
    Picture got(rect_of(kSize));
    for (int c = 0; c < 4; ++c) {
      const View<float> plane =
          c < 3 ? got.target.color[static_cast<std::size_t>(c)] : got.target.alpha;
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) plane.at(x, y) = test::get(out.channel(c), x, y);
      }
    }
    EXPECT_TRUE(same_bits(got.values(), s.expected))
        << layout.interleaved << layout.bottom_up << layout.slack;
  }
}

/// Input and output in half: a frame of halves is the frame of these numbers, and pictures hold the
/// nearest half.
TEST(Compositor, TakesAndGivesHalves) {
  Subject s;
  HostMemory memory(kPlaneCount, rect_of(kSize), {.sample = Sample::kHalf, .interleaved = true});
  HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
  for (int i = 0; i < kPlaneCount; ++i) {
    const HostOutput halves = memory.channel(i);
    test::fill(halves, s.buffers.frame.planes[i]);
    s.buffers.set(static_cast<PlaneId>(i), [&](int x, int y) { return test::get(halves, x, y); });
    frame.planes[i] = halves;
  }
  const std::vector<float> expected = test::judged(busy_look(), s.buffers.frame, s.scene);
  for (const std::string& simd : simd_targets()) {
    Compositor compositor({.trusted = true}, busy_look(), {.simd = simd});
    HostMemory out(4, rect_of(kSize), {.sample = Sample::kHalf, .interleaved = true});
    HostPicture picture;
    for (int c = 0; c < 3; ++c) picture.color[static_cast<std::size_t>(c)] = out.channel(c);
    picture.alpha = out.channel(3);
    compositor.run(frame, picture);
    const Picture judge = [&] {
      Picture p(rect_of(kSize));
      run_fused(make_plan(busy_look(), test::inputs_of(s.buffers.frame, s.scene)), s.buffers.frame,
                s.scene, p.target, *make_executor(1), {.simd = simd});
      return p;
    }();
    for (int c = 0; c < 4; ++c) {
      const View<float> plane =
          c < 3 ? judge.target.color[static_cast<std::size_t>(c)] : judge.target.alpha;
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
          const float nearest = imath_half_to_float(imath_float_to_half(plane.at(x, y)));
          ASSERT_EQ(test::get(out.channel(c), x, y), nearest) << simd << " " << c << " " << x;
        }
      }
    }
  }
}

/// Each kind of depth in the conventions gives the depth of make_eye_depth().
TEST(Compositor, MakesEyeDepthOfEveryKind) {
  const Subject s;
  struct Case {
    Conventions conventions;
    ClipSpace clip;
    double far;
  };
  for (const Case& c :
       {Case{{.depth = DepthKind::kRay}, ClipSpace::kGl, 1e3},
        Case{{.depth = DepthKind::kInverse}, ClipSpace::kGl, 1e3},
        Case{{.depth = DepthKind::kNormalised, .near = 0.5, .far = 90}, ClipSpace::kGl, 1e3},
        Case{{.depth = DepthKind::kDevice}, ClipSpace::kGl, 1e3},
        Case{{.depth = DepthKind::kDevice, .clip = ClipSpace::kD3d}, ClipSpace::kD3d, 1e3},
        Case{{.depth = DepthKind::kDevice, .clip = ClipSpace::kReversed},
             ClipSpace::kReversed,
             HUGE_VAL}}) {
    Scene scene = s.scene;
    scene.camera->projection = perspective(0.9, 67.0 / 41, 0.1, c.far, c.clip);
    scene.camera->clip = c.clip;
    Buffers raw = raw_frame(kSize), trusted = valid_frame(kSize), entered = valid_frame(kSize);
    for (const PlaneId id : {PlaneId::kDepth, PlaneId::kSurfaceDepth, PlaneId::kReflectionDepth,
                             PlaneId::kBelowDepth}) {
      const auto stored = [&](int x, int y) {
        const double z = s.buffers.frame.plane(id).at(x, y);
        const bool nothing = std::isinf(z);
        switch (c.conventions.depth) {
          case DepthKind::kInverse:
            return static_cast<float>(1 / z);
          case DepthKind::kNormalised:
            return nothing ? 1.0f : static_cast<float>((z - 0.5) / 89.5);
          case DepthKind::kDevice:
            return static_cast<float>(nothing ? scene.camera->far_device_depth()
                                              : scene.camera->device_from_eye_depth(z));
          default:
            return static_cast<float>(1.1 * z);
        }
      };
      raw.set(id, stored);
      trusted.set(id, stored);
      Plane plane(rect_of(kSize));
      for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) plane.view().at(x, y) = stored(x, y);
      }
      make_eye_depth(plane.view(), {.kind = c.conventions.depth,
                                    .near = c.conventions.near,
                                    .far = c.conventions.far,
                                    .camera = &*scene.camera,
                                    .display = rect_of(kSize)});
      entered.set(id, [&](int x, int y) { return plane.view().at(x, y); });
    }
    const std::vector<float> expected = test::judged(busy_look(), entered.frame, scene);
    for (const bool vouched : {false, true}) {
      Conventions conventions = c.conventions;
      conventions.trusted = vouched;
      Compositor compositor(conventions, busy_look());
      HostFrame frame = test::host_frame((vouched ? trusted : raw).frame, scene);
      frame.scene.camera->clip = ClipSpace::kGl;  // has no effect
      EXPECT_TRUE(same_bits(wet(compositor, frame), expected))
          << static_cast<int>(conventions.depth) << static_cast<int>(c.clip) << vouched;
      EXPECT_EQ(compositor.replaced().total(), 0);
    }
  }
}

TEST(Compositor, CamerasOfOtherConventionsShowTheSame) {
  const Subject s;
  HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
  const glm::dmat4 view = frame.scene.camera->view, projection = frame.scene.camera->projection;
  const glm::dmat4 turned = glm::scale(glm::dmat4(1), {1, 1, -1});
  const glm::dmat4 down = glm::scale(glm::dmat4(1), {1, -1, 1});
  Compositor plus_z({.looks_along_plus_z = true, .trusted = true}, busy_look());
  frame.scene.camera->view = turned * view;
  frame.scene.camera->projection = projection * turned;
  EXPECT_TRUE(same_bits(wet(plus_z, frame), s.expected));
  Compositor vulkan({.clip_y_down = true, .trusted = true}, busy_look());
  frame.scene.camera->view = view;
  frame.scene.camera->projection = down * projection;
  EXPECT_TRUE(same_bits(wet(vulkan, frame), s.expected));
}

TEST(Compositor, WorksInPlace) {
  for (const Sample sample : {Sample::kFloat, Sample::kHalf}) {
    const Subject s;
    HostMemory memory(4, rect_of(kSize), {.sample = sample, .interleaved = true});
    HostMemory apart(4, rect_of(kSize), {.sample = sample, .interleaved = true});
    HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
    HostPicture here, there;
    for (int c = 0; c < 4; ++c) {
      test::fill(memory.channel(c), s.buffers.frame.planes[c]);
      frame.planes[c] = memory.channel(c);
      (c < 3 ? here.color[static_cast<std::size_t>(c)] : here.alpha) = memory.channel(c);
      (c < 3 ? there.color[static_cast<std::size_t>(c)] : there.alpha) = apart.channel(c);
    }
    Compositor compositor({.trusted = true}, busy_look());
    compositor.run(frame, there);
    compositor.run(frame, here);
    EXPECT_EQ(memory.bytes(), apart.bytes());
    // The picture may lie over the depth, too: all memory belongs to the host.
    HostPicture over_depth = there;
    Plane depth(rect_of(kSize));
    test::fill(host_view(depth.view()), s.buffers.frame.plane(PlaneId::kDepth));
    for (int c = 0; c < 4; ++c) {
      test::fill(memory.channel(c), s.buffers.frame.planes[c]);
    }
    frame.plane(PlaneId::kDepth) = host_view(depth.view());
    over_depth.color[0] = host_view(depth.view());
    compositor.run(frame, over_depth);
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        const float red = depth.view().at(x, y);
        ASSERT_EQ(test::get(apart.channel(0), x, y),
                  sample == Sample::kHalf ? imath_half_to_float(imath_float_to_half(red)) : red);
      }
    }
  }
}

/// Meaningless values are replaced in a copy, counted, and make no NaN; the host's planes stay.
TEST(Compositor, ReplacesWhatMeansNothing) {
  const Scene scene = test::simple_scene(kSize);
  Buffers dirty = raw_frame(kSize), clean = valid_frame(kSize);
  const auto spoil = [&](PlaneId id, int x, int y, float bad, float good) {
    const Buffers before = raw_frame(kSize);
    const auto with = [&](float v) {
      return [&, v](int px, int py) {
        return px == x && py == y ? v : before.frame.plane(id).at(px, py);
      };
    };
    dirty.set(id, with(bad));
    clean.set(id, with(good));
  };
  spoil(PlaneId::kColorG, 66, 40, kNan, 0);
  spoil(PlaneId::kColorR, 65, 40, test::kInf, kLargestColor);
  spoil(PlaneId::kColorB, 64, 40, -test::kInf, 0);
  spoil(PlaneId::kDepth, 3, 7, kNan, test::kInf);
  spoil(PlaneId::kSurfaceDepth, 5, 35, 1e10f, test::kInf);  // nothing hit: not counted
  spoil(PlaneId::kShadow, 0, 0, -test::kInf, 1);
  spoil(PlaneId::kSurfaceShadow, 9, 9, 7, 1);  // clamped: not counted
  HostFrame frame = test::host_frame(dirty.frame, scene);
  Compositor compositor({}, busy_look());
  EXPECT_TRUE(same_bits(wet(compositor, frame), test::judged(busy_look(), clean.frame, scene)));
  EXPECT_EQ(compositor.replaced().of(PlaneId::kColorR), (Replaced{1, 2}));
  EXPECT_EQ(compositor.replaced().of(PlaneId::kDepth), (Replaced{1, 0}));
  EXPECT_EQ(compositor.replaced().of(PlaneId::kShadow), (Replaced{0, 1}));
  EXPECT_EQ(compositor.replaced().total(), 5);
  EXPECT_TRUE(std::isnan(dirty.frame.plane(PlaneId::kColorG).at(66, 40)));
  // The next frame counts from 0.
  const Subject next;
  const Buffers raw = raw_frame(kSize);
  EXPECT_TRUE(same_bits(wet(compositor, test::host_frame(raw.frame, scene)), next.expected));
  EXPECT_EQ(compositor.replaced().total(), 0);
}

TEST(Compositor, ADepthOfZeroIsNothingWhereThatIsSaid) {
  const Scene scene = test::simple_scene(kSize);
  Buffers zeros = raw_frame(kSize), clean = valid_frame(kSize);
  const auto with = [](float nothing, const Buffers& of) {
    return [=, &of](int x, int y) {
      return x > 20 && x < 30 && y > 20 ? nothing : of.frame.plane(PlaneId::kDepth).at(x, y);
    };
  };
  const Buffers raw = raw_frame(kSize), trusted = valid_frame(kSize);
  zeros.set(PlaneId::kDepth, with(0, raw));
  clean.set(PlaneId::kDepth, with(test::kInf, trusted));
  const std::vector<float> expected = test::judged(busy_look(), clean.frame, scene);
  Compositor plain({}, busy_look()), asked({.depth_nothing = 0}, busy_look());
  EXPECT_FALSE(same_bits(wet(plain, test::host_frame(zeros.frame, scene)), expected));
  EXPECT_TRUE(same_bits(wet(asked, test::host_frame(zeros.frame, scene)), expected));
  EXPECT_EQ(asked.replaced().total(), 0);

  // A depth of 0 means "nothing hit" where alpha is 0, as float and as half.
  const auto alpha = [](int x, int y) { return x > 20 && x < 30 && y > 20 ? 0.0f : 1.0f; };
  zeros.set(PlaneId::kColorA, alpha);
  clean.set(PlaneId::kColorA, alpha);
  const std::vector<float> covered = test::judged(busy_look(), clean.frame, scene);
  HostFrame frame = test::host_frame(zeros.frame, scene);
  EXPECT_TRUE(same_bits(wet(plain, frame), covered));
  HostMemory memory(1, rect_of(kSize), {.sample = Sample::kHalf});
  test::fill(memory.channel(0), zeros.frame.plane(PlaneId::kColorA));
  frame.plane(PlaneId::kColorA) = memory.channel(0);
  EXPECT_TRUE(same_bits(wet(plain, frame), covered));
  // The law holds wherever the window of the alpha begins.
  zeros.set(PlaneId::kColorA, alpha, {-7, -3, kSize.width + 7, kSize.height + 3});
  EXPECT_TRUE(same_bits(wet(plain, test::host_frame(zeros.frame, scene)), covered));
}

TEST(Compositor, LooksChangeBetweenFrames) {
  const Subject s;
  Compositor compositor({.trusted = true}, {});
  const HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
  EXPECT_FALSE(same_bits(wet(compositor, frame), s.expected));
  compositor.set_look(busy_look());
  EXPECT_THROW(compositor.plan(), Error);
  EXPECT_THROW(compositor.replaced(), Error);
  EXPECT_TRUE(same_bits(wet(compositor, frame), s.expected));
  EXPECT_TRUE(compositor.plan().keeps<WaveNormals>());
  Look bad = busy_look();
  bad.of<DepthFog>().density = -1;
  EXPECT_THROW(compositor.set_look(bad), Error);
  EXPECT_TRUE(same_bits(wet(compositor, frame), s.expected));
}

TEST(Compositor, PlansForWhatThereIs) {
  const Subject s;
  Compositor compositor({.trusted = true}, busy_look());
  HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
  wet(compositor, frame);
  const std::string with_sun = to_text(compositor.plan());
  frame.scene.sun.reset();
  wet(compositor, frame);
  EXPECT_NE(to_text(compositor.plan()), with_sun);
  frame.scene.sun = s.scene.sun;
  EXPECT_TRUE(same_bits(wet(compositor, frame), s.expected));
  EXPECT_EQ(to_text(compositor.plan()), with_sun);
}

TEST(Compositor, WritesAovs) {
  const Subject s;
  Compositor compositor({.trusted = true}, busy_look());
  Picture picture(rect_of(kSize)), judge(rect_of(kSize));
  compositor.run(test::host_frame(s.buffers.frame, s.scene),
                 test::host_picture(picture.target, {Aov::kPath, Aov::kStmapB, Aov::kNormal}));
  run_fused(make_plan(busy_look(), test::inputs_of(s.buffers.frame, s.scene), test::all_state()),
            s.buffers.frame, s.scene, judge.target, *make_executor(1));
  for (const Aov aov : {Aov::kPath, Aov::kStmapB, Aov::kNormal}) {
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        ASSERT_EQ(picture.aov(aov, x, y), judge.aov(aov, x, y)) << static_cast<int>(aov);
      }
    }
  }
  EXPECT_EQ(picture.aov(Aov::kFresnel, 20, 20), 0);  // not requested: left alone
}

TEST(Compositor, LooksUpTexturesOfTheHost) {
  Buffers b = test::noisy_frame(rect_of(kSize));
  for (const Role& role : roles()) {
    if (role.name != "surface_normal" && role.name != "reflection") continue;
    for (int i = 0; i < 3; ++i) b.frame.planes[index_of(role.first) + i] = {};
  }
  const Scene scene = test::simple_scene(kSize);
  const test::NoiseMap map(16, 8), surroundings(32, 16);
  Compositor compositor({.trusted = true}, busy_look());
  const std::vector<float> without = wet(compositor, test::host_frame(b.frame, scene));
  compositor.set_wave_map(map.texture);
  compositor.set_environment(surroundings.texture);
  const std::vector<float> with = wet(compositor, test::host_frame(b.frame, scene));
  EXPECT_FALSE(same_bits(with, without));
  b.frame.wave_map = map.texture;
  b.frame.environment = surroundings.texture;
  EXPECT_TRUE(same_bits(with, test::judged(busy_look(), b.frame, scene)));
  compositor.set_wave_map({});
  compositor.set_environment({});
  EXPECT_TRUE(same_bits(wet(compositor, test::host_frame(b.frame, scene)), without));

  Plane bad(Rect{0, 0, 16, 8});
  bad.view().at(3, 2) = kNan;
  Texture texture = map.texture;
  texture.channels[1] = bad.view();
  EXPECT_THROW(compositor.set_wave_map(texture), Error);
  texture.channels[1] = {};
  EXPECT_THROW(compositor.set_environment(texture), Error);
}

class CountingExecutor : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    tasks += count;
    for (int i = count; i-- > 0;) task(context, i);
  }
  int tasks = 0;
};

TEST(Compositor, ComputesOnTheHostsThreads) {
  const Subject s;
  CountingExecutor host;
  Compositor compositor({.trusted = true}, busy_look(), {.executor = &host});
  EXPECT_TRUE(same_bits(wet(compositor, test::host_frame(s.buffers.frame, s.scene)), s.expected));
  EXPECT_GT(host.tasks, 1);
}

/// Compositors on threads of their own, over one executor that all share, each with frames of its
/// own.
TEST(CompositorThreads, ManyAtOnceGiveTheSameBits) {
  const auto shared = make_executor(2);
  std::atomic<int> right = 0;
  constexpr int kThreads = 4, kFrames = 3;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      const Size size{67 + 8 * t, 41};
      const Subject s(size);
      const Buffers raw = raw_frame(size);
      const bool trusted = t % 2 == 0;
      const auto own = make_executor(2);
      Compositor compositor({.trusted = trusted}, busy_look(),
                            {.executor = t < 2 ? shared.get() : own.get()});
      const HostFrame host = test::host_frame((trusted ? s.buffers : raw).frame, s.scene);
      for (int frame = 0; frame < kFrames; ++frame) {
        right += same_bits(wet(compositor, host), s.expected);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, kThreads * kFrames);
}

}  // namespace
}  // namespace limpid
