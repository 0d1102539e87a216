#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/ops/look.h"

#include "ops/probe_strip.h"
#include "support.h"

// What every operator of the chain promises, tested by the act of being in the chain.

namespace limpid {
namespace {

using test::Buffers;
using test::Picture;
using test::ProbeStrip;
using testing::HasSubstr;

constexpr Size kSize{19, 7};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Op>
std::string label(std::string_view field = "") {
  return std::string(Op::kName) + "." + std::string(field);
}

/// Values that a parameter may have: its ends, its default, and what is often special.
template <class P>
std::vector<Value> candidates(const Field<P>& field) {
  std::vector<Value> values = {field.get(P{})};
  const auto inside = [&](double x) { return x >= field.range.min && x <= field.range.max; };
  switch (field.kind) {
    case FieldKind::kReal:
      for (double x : {field.range.min, field.range.max, 0.0, 1.0}) {
        if (inside(x)) values.emplace_back(x);
      }
      break;
    case FieldKind::kColor:
      for (double x : {field.range.min, field.range.max, 0.0, 1.0}) {
        if (inside(x)) values.emplace_back(Rgb<double>{x, x, x});
      }
      break;
    case FieldKind::kChoice:
      for (std::string_view word : field.choices) values.emplace_back(std::string(word));
      break;
    case FieldKind::kText:
      break;
  }
  return values;
}

/// Calls fn(params, text) for the defaults with every pair of parameters at every candidate.
template <class Op, class Fn>
void for_each_params(Fn&& fn) {
  for (const auto& first : Op::fields()) {
    for (const auto& second : Op::fields()) {
      for (const Value& a : candidates(first)) {
        for (const Value& b : candidates(second)) {
          typename Op::Params params;
          assign(Op::kName, first, params, a);
          assign(Op::kName, second, params, b);
          fn(params, label<Op>(first.name) + " = " + to_string(a) + ", " +
                         std::string(second.name) + " = " + to_string(b));
        }
      }
    }
  }
}

/// Within the range, but no larger than a picture of noise can be compared in float.
template <class Op>
typename Op::Params random_params(int seed) {
  typename Op::Params params;
  int next = 0;
  const auto random = [&] { return static_cast<double>(test::noise(seed, next++, 91)); };
  for (const auto& field : Op::fields()) {
    const double widest = field.unit == "uv per unit tilt" ? 0.2 : 40;
    const double least = field.range.min > 0 ? 0.5 : -widest;
    const double low = std::max(field.range.min, least), high = std::min(field.range.max, widest);
    const auto number = [&] { return low + (high - low) * random(); };
    if (field.kind == FieldKind::kReal) assign(Op::kName, field, params, number());
    if (field.kind == FieldKind::kColor) {
      assign(Op::kName, field, params, Rgb<double>{number(), number(), number()});
    }
    if (field.kind == FieldKind::kChoice) {
      const double count = static_cast<double>(field.choices.size());
      const auto index = static_cast<std::size_t>(std::min(random() * count, count - 1));
      assign(Op::kName, field, params, std::string(field.choices[index]));
    }
  }
  return params;
}

Context probe_context(StateSet made) {
  static const Buffers buffers = test::noisy_frame(rect_of(kSize));
  static const test::NoiseMap map(16, 8);
  Frame frame = buffers.frame;
  frame.wave_map = map.texture;
  Scene scene = test::simple_scene(kSize);
  scene.time = 3.7;
  return Context(scene, frame, 1.333, made);
}

/// All inputs that there are; the plate's normals only if asked for, so that the maps get a turn.
struct World {
  explicit World(bool plate_normals = true)
      : buffers(test::noisy_frame(rect_of(kSize))), map(16, 8), scene(test::simple_scene(kSize)) {
    buffers.frame.wave_map = map.texture;
    if (!plate_normals) {
      for (int c = 0; c < 3; ++c) {
        buffers.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
      }
    }
    scene.time = 3.7;
  }
  Buffers buffers;
  test::NoiseMap map;
  Scene scene;
};

bool same_bits(const Picture& a, const Picture& b) {
  const std::vector<float> x = a.values(), y = b.values();
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
}

// --- what operators declare ---------------------------------------------------------------------

TEST(Contract, NamesAndSentences) {
  std::set<std::string_view> names, sentences;
  const auto identifier = [](std::string_view name) {
    return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") ==
                                std::string_view::npos;
  };
  Chain::for_each([&]<class Op, int>() {
    EXPECT_TRUE(identifier(Op::kName)) << Op::kName;
    EXPECT_TRUE(names.insert(Op::kName).second) << Op::kName;
    EXPECT_TRUE(std::string_view(Op::kAbout).ends_with(".")) << Op::kName;
    EXPECT_TRUE(sentences.insert(Op::kAbout).second) << Op::kName;
    std::set<std::string_view> fields;
    EXPECT_FALSE(Op::fields().empty()) << Op::kName;
    for (const auto& field : Op::fields()) {
      EXPECT_TRUE(identifier(field.name)) << label<Op>(field.name);
      EXPECT_TRUE(fields.insert(field.name).second) << label<Op>(field.name);
      EXPECT_TRUE(field.about.ends_with(".")) << label<Op>(field.name);
    }
  });
  EXPECT_EQ(names.count("water"), 0u) << "the table of the water itself";
}

TEST(Contract, DefaultsAreInRangeAndValuesRoundTrip) {
  EXPECT_NO_THROW(Look().validate());
  Chain::for_each([&]<class Op, int>() {
    for (const auto& field : Op::fields()) {
      for (const Value& value : candidates(field)) {
        Look look;
        EXPECT_NO_THROW(look.set(Op::kName, field.name, value)) << label<Op>(field.name);
        EXPECT_EQ(field.get(look.of<Op>()), value) << label<Op>(field.name);
        for (const auto& other : Op::fields()) {
          if (other.name == field.name) continue;
          EXPECT_EQ(other.get(look.of<Op>()), other.get(typename Op::Params{}))
              << label<Op>(field.name) << " changed " << other.name;
        }
      }
    }
  });
}

TEST(Contract, OutOfRangeIsRefusedByName) {
  const auto refused = [](std::string_view owner, std::string_view field, const Value& value) {
    Look look;
    try {
      look.set(owner, field, value);
      ADD_FAILURE() << owner << "." << field << " took " << to_string(value);
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::StartsWith(std::string(owner) + "." + std::string(field)));
      EXPECT_THAT(e.what(), HasSubstr("expected"));
    }
    EXPECT_NO_THROW(look.validate());
  };
  const auto beyond = [](Range range) {
    return std::vector<double>{std::nextafter(range.min, -kInfinity),
                               std::nextafter(range.max, kInfinity), kNan, kInfinity, -kInfinity};
  };
  Chain::for_each([&]<class Op, int>() {
    for (const auto& field : Op::fields()) {
      if (field.kind == FieldKind::kReal) {
        EXPECT_LT(field.range.min, field.range.max) << label<Op>(field.name);
        for (double x : beyond(field.range)) refused(Op::kName, field.name, x);
        refused(Op::kName, field.name, "much");
      }
      if (field.kind == FieldKind::kColor) {
        const double ok = field.range.min;
        for (double x : beyond(field.range)) {
          refused(Op::kName, field.name, Rgb<double>{x, ok, ok});
          refused(Op::kName, field.name, Rgb<double>{ok, ok, x});
        }
      }
      if (field.kind == FieldKind::kChoice) refused(Op::kName, field.name, "nonesuch");
      if (field.kind != FieldKind::kReal) refused(Op::kName, field.name, 1.0);
    }
  });
}

TEST(Contract, NeedsArePlanesThatAreRead) {
  Chain::for_each([&]<class Op, int>() {
    for_each_params<Op>([](const auto& params, const std::string& what) {
      EXPECT_TRUE(Op::reads(params).covers(Op::needs(params).planes)) << what;
    });
  });
}

// --- what they do, alone ------------------------------------------------------------------------

/// Applies to 32 pixels whose state is random in all parts.
template <class Op>
ProbeStrip probed(const typename Op::Params& params, StateSet random, StateSet made) {
  ProbeStrip strip;
  for (int i = 0; i < 32; ++i) strip.pixels.push_back(test::random_pixel(i, random));
  Op::apply(params, probe_context(made), strip);
  return strip;
}

StateSet everything() {
  StateSet all;
  for (StatePart part : test::kStateParts) all = all | StateSet{part};
  return all;
}

TEST(Contract, OnlyDeclaredStateIsMade) {
  Chain::for_each([&]<class Op, int>() {
    StateSet may_change = Op::kMakes;
    // Snap uses the prism up: where it goes back to the pixel itself, no later operator may split.
    if (std::is_same_v<Op, Refraction>) may_change = may_change | StateSet{StatePart::kPrism};
    for_each_params<Op>([&](const auto& params, const std::string& what) {
      const ProbeStrip strip = probed<Op>(params, everything(), everything());
      for (int i = 0; i < 32; ++i) {
        const Pixel<double> before = test::random_pixel(i, everything());
        for (StatePart part : test::kStateParts) {
          if (may_change.has(part)) continue;
          ASSERT_EQ(test::values_of(before, part), test::values_of(strip.pixels[i], part))
              << what << " changed state " << static_cast<int>(part);
        }
      }
    });
  });
}

TEST(Contract, OnlyDeclaredStateIsUsed) {
  Chain::for_each([&]<class Op, int>() {
    StateSet hidden;  // neither used nor made: what it holds must not matter
    for (StatePart part : test::kStateParts) {
      if (!Op::kUses.has(part) && !Op::kMakes.has(part)) hidden = hidden | StateSet{part};
    }
    for_each_params<Op>([&](const auto& params, const std::string& what) {
      ProbeStrip plain, disturbed;
      for (int i = 0; i < 32; ++i) {
        plain.pixels.push_back(test::random_pixel(i, StateSet(Op::kUses)));
        Pixel<double> p = plain.pixels.back();
        const Pixel<double> other = test::random_pixel(i + 1000, everything());
        if (hidden.has(StatePart::kNormal)) p.normal = other.normal, p.tilt = other.tilt;
        if (hidden.has(StatePart::kPrism)) p.prism_r = p.prism_g = p.prism_b = other.prism_g;
        if (hidden.has(StatePart::kPosition)) p.shift = other.shift, p.hit_depth = other.hit_depth;
        if (hidden.has(StatePart::kPath)) p.path = other.path;
        if (hidden.has(StatePart::kTransmitted)) p.transmitted = other.transmitted;
        if (hidden.has(StatePart::kInScatter)) p.in_scatter = other.in_scatter;
        if (hidden.has(StatePart::kFresnel)) p.fresnel = other.fresnel;
        if (hidden.has(StatePart::kReflected)) p.reflected = other.reflected;
        if (hidden.has(StatePart::kHighlight)) p.highlight = other.highlight;
        if (hidden.has(StatePart::kConfidence)) p.confidence = other.confidence;
        disturbed.pixels.push_back(p);
      }
      Op::apply(params, probe_context(everything()), plain);
      Op::apply(params, probe_context(everything()), disturbed);
      for (int i = 0; i < 32; ++i) {
        for (StatePart part : test::kStateParts) {
          if (!StateSet(Op::kMakes).has(part)) continue;
          ASSERT_EQ(test::values_of(plain.pixels[i], part),
                    test::values_of(disturbed.pixels[i], part))
              << what << ", state " << static_cast<int>(part);
        }
      }
    });
  });
}

TEST(Contract, OnlyDeclaredPlanesAreTapped) {
  Chain::for_each([&]<class Op, int>() {
    for_each_params<Op>([&](const auto& params, const std::string& what) {
      const ProbeStrip strip = probed<Op>(params, everything(), everything());
      EXPECT_TRUE(Op::reads(params).covers(strip.tapped)) << what;
      EXPECT_TRUE(strip.tapped.covers(Op::reads(params))) << what << " declares more than it taps";
      EXPECT_EQ(Op::needs(params).wave_map, strip.map_tapped) << what;
    });
  });
}

// Reaches add up along the chain: shifts are made by one operator and used by later ones.
TEST(Contract, TapsStayWithinTheDeclaredReach) {
  for (int seed = 0; seed < 200; ++seed) {
    Look look;
    ProbeStrip strip;
    double reach = 0;
    for (int i = 0; i < 8; ++i) strip.pixels.push_back(test::random_pixel(100 * seed + i, {}));
    const Context context = probe_context(everything());
    Chain::for_each([&]<class Op, int>() {
      const typename Op::Params params = random_params<Op>(seed);
      EXPECT_GE(Op::reach(params), 0) << Op::kName;
      reach += Op::reach(params);
      Op::apply(params, context, strip);
      for (Pixel<double>& p : strip.pixels) {  // plate normals of the probe are noise, not unit
        const Vec3<double> n = normalize_or<double>(p.normal, {0, 1, 0});
        if (std::is_same_v<Op, WaveNormals>) p.normal = n, p.tilt = {n.x, n.z};
      }
      EXPECT_LE(strip.farthest, reach + 1e-9) << Op::kName;
    });
  }
}

TEST(Contract, NeutralParametersAreTheIdentity) {
  std::set<std::string_view> seen;
  StateSet made;  // by the operators before, once none of them and once all
  Chain::for_each([&]<class Op, int>() {
    for (StateSet before : {StateSet{}, made}) {
      for_each_params<Op>([&](const auto& params, const std::string& what) {
        if (!Op::neutral(params, before)) return;
        seen.insert(Op::kName);
        // Refraction reads the pixel's own depth and color again, which the probe cannot know: see
        // the pictures below.
        if (std::is_same_v<Op, Refraction>) return;
        const ProbeStrip strip = probed<Op>(params, before, before);
        for (int i = 0; i < 32; ++i) {
          for (StatePart part : test::kStateParts) {
            if (part == StatePart::kPath) continue;  // measured all the same
            ASSERT_EQ(test::values_of(test::random_pixel(i, before), part),
                      test::values_of(strip.pixels[i], part))
                << what << ", state " << static_cast<int>(part);
          }
        }
      });
    }
    made = made | Op::kMakes;
  });
  EXPECT_THAT(seen, testing::IsSupersetOf({"wave_normals", "prism_split", "refraction", "depth_fog",
                                           "water_shadow", "sun_highlight"}));
}

// --- what they do in pictures -------------------------------------------------------------------

/// The plan with all operators kept that can be, neutral ones too.
Plan eager_plan(const Look& look, const World& world) {
  const Inputs inputs = test::inputs_of(world.buffers.frame, world.scene);
  Plan plan = make_plan(look, inputs, test::all_state());
  Chain::for_each([&]<class Op, int I>() {
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

TEST(Contract, DroppingWhatIsNeutralChangesNoPictureAndNoAov) {
  std::set<std::string_view> dropped;
  for (bool plate_normals : {false, true}) {
    const World world(plate_normals);
    Chain::for_each([&]<class Op, int I>() {
      for_each_params<Op>([&](const auto& params, const std::string& what) {
        Look look;
        look.of<PrismSplit>().strength = std::is_same_v<Op, Refraction> ? 0 : 0.01;
        look.of<Op>() = params;
        const Plan plan =
            make_plan(look, test::inputs_of(world.buffers.frame, world.scene), test::all_state());
        if (plan.keeps(I)) return;
        dropped.insert(Op::kName);
        ASSERT_TRUE(same_bits(run(plan, world), run(eager_plan(look, world), world))) << what;
      });
    });
  }
  // The fog stays for the path.
  EXPECT_THAT(dropped, testing::IsSupersetOf({"wave_normals", "prism_split", "refraction",
                                              "water_shadow", "sun_highlight"}));
}

TEST(Contract, SaneInputMakesNoNan) {
  for (bool plate_normals : {false, true}) {
    const World world(plate_normals);
    Chain::for_each([&]<class Op, int>() {
      for_each_params<Op>([&](const auto& params, const std::string& what) {
        Look look;
        look.of<PrismSplit>().strength = 0.01;
        look.of<Op>() = params;
        for (const Picture& picture : {test::reference(look, world.buffers.frame, world.scene),
                                       test::fused(look, world.buffers.frame, world.scene)}) {
          for (float v : picture.values()) ASSERT_FALSE(std::isnan(v)) << what;
          for (int y = 0; y < kSize.height; ++y) {
            for (int x = 0; x < kSize.width; ++x) {
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
    Chain::for_each([&]<class Op, int>() {
      for (int seed = 0; seed < 10; ++seed) {
        Look look;
        look.of<Op>() = random_params<Op>(seed);
        const Frame& frame = world.buffers.frame;
        const std::vector<float> judge = test::reference(look, frame, world.scene).values();
        const Picture whole = test::fused(look, frame, world.scene);
        const std::vector<float> got = whole.values();
        std::size_t far = 0;
        for (std::size_t i = 0; i < judge.size(); ++i) {
          far += !(judge[i] == got[i] ||
                   std::abs(judge[i] - got[i]) < 3e-4 * (1 + std::abs(judge[i])));
        }
        // A depth lookup on the edge of two texels may round either way.
        EXPECT_LE(far, judge.size() / 500) << Op::kName << ", seed " << seed;
        EXPECT_TRUE(same_bits(whole, test::fused(look, frame, world.scene, {.tile = {5, 3}}, 2)))
            << Op::kName << ", seed " << seed;
      }
    });
  }
}

TEST(Contract, PlanesThatThePlanDoesNotReadDoNotMatter) {
  const World world;
  Chain::for_each([&]<class Op, int>() {
    Look look = test::still_look();
    look.of<Op>() = typename Op::Params{};
    const Inputs all = test::inputs_of(world.buffers.frame, world.scene);
    Plan plan = make_plan(look, all, {});
    // Only this operator and the waves it may look at.
    plan.made = {};
    plan.planes =
        kColorPlanes | PlaneSet{PlaneId::kColorA, PlaneId::kDepth, PlaneId::kSurfaceDepth};
    Chain::for_each([&]<class Other, int J>() {
      const bool on = std::is_same_v<Other, Op> || std::is_same_v<Other, WaveNormals>;
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
