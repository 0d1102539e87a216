#include "ops/contract.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "complete/scattered_light.h"
#include "ops/kernels.h"
#include "ops/noise_caustics.h"
#include "ops/probe_strip.h"

// The promises of every operator of the chain: its declarations, and its effect when it is applied
// alone. An operator is tested because it is in the chain. contract_picture_test.cpp has the rest.

namespace limpid {
namespace {

using test::Buffers;
using test::candidates;
using test::for_each_params;
using test::label;
using test::ProbeStrip;
using test::random_params;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The pass of a frame that has every plane but the absent ones.
Pass probe_context(StateSet made, PlaneSet absent = {}, bool has_sky = true) {
  static const Buffers buffers = test::noisy_frame(rect_of(test::kContractSize));
  static const test::NoiseMap map(16, 8), sky(12, 6);
  Frame frame = buffers.frame;
  for (int i = 0; i < kPlaneCount; ++i) {
    if (absent.has(static_cast<PlaneId>(i))) frame.planes[i] = {};
  }
  frame.wave_map = map.texture;
  if (has_sky) frame.environment = sky.texture;
  static ScatteredLightMaker maker;
  frame.scattered_light = maker.make({{0.2, 0.3, 0.4}, {1, 2, 3}, 0.5, 0.8}).data();
  static const test::NoiseCaustics caustics;
  frame.caustics = &caustics.table;
  Scene scene = test::simple_scene(test::kContractSize);
  scene.time = 3.7;
  return Pass(scene, frame, 1.333, made);
}

// --- declarations -------------------------------------------------------------------------------

TEST(Contract, NamesAndSentences) {
  std::set<std::string_view> names, sentences;
  const auto identifier = [](std::string_view name) {
    return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") ==
                                std::string_view::npos;
  };
  Kernels::for_each([&]<class Op, int>() {
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
  Kernels::for_each([&]<class Op, int>() {
    for (const auto& field : Op::fields()) {
      for (const Value& value : candidates(field)) {
        Look look;
        EXPECT_NO_THROW(look.set(Op::kName, field.name, value)) << label<Op>(field.name);
        EXPECT_EQ(field.get(look.of<Op>()), value) << label<Op>(field.name);
        for (const auto& other : Op::fields()) {
          const auto& brought = field.used_when;
          const bool follows = std::any_of(brought.begin(), brought.end(), [&](const Condition& c) {
            return c.follows && c.key == other.name;
          });
          if (other.name == field.name || follows) continue;
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
  Kernels::for_each([&]<class Op, int>() {
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
      if (field.kind == FieldKind::kCountOrWord) {
        for (double x : beyond(field.range)) refused(Op::kName, field.name, x);
        refused(Op::kName, field.name, field.range.min + 0.5);
        refused(Op::kName, field.name, "nonesuch");
      }
      if (field.kind == FieldKind::kTable) {
        const std::vector<double> ok(field.columns.size(), field.range.min);
        for (double x : beyond(field.range)) {
          std::vector<double> row = ok;
          row.back() = x;
          refused(Op::kName, field.name, Rows{ok, row});
        }
        refused(Op::kName, field.name, Rows{std::vector<double>(field.least_columns - 1)});
        refused(Op::kName, field.name, Rows{std::vector<double>(field.columns.size() + 1)});
      }
      const bool number = field.kind == FieldKind::kReal || field.kind == FieldKind::kCountOrWord;
      if (!number) refused(Op::kName, field.name, 1.0);
    }
  });
}

TEST(Contract, NeedsArePlanesThatAreRead) {
  Kernels::for_each([&]<class Op, int>() {
    for_each_params<Op>([](const auto& params, const std::string& what) {
      EXPECT_TRUE(Op::reads(params).covers(Op::needs(params).planes)) << what;
    });
  });
}

// --- effects of one operator --------------------------------------------------------------------

/// Applies to 32 pixels whose state is random in all parts.
template <class Op>
ProbeStrip probed(const typename Op::Params& params, StateSet random, StateSet made,
                  PlaneSet absent = {}, bool has_sky = true) {
  ProbeStrip strip;
  for (int i = 0; i < 32; ++i) strip.pixels.push_back(test::random_pixel(i, random));
  Op::apply(params, probe_context(made, absent, has_sky), strip);
  return strip;
}

StateSet everything() {
  StateSet all;
  for (StatePart part : test::kStateParts) all = all | StateSet{part};
  return all;
}

/// The same for pixels that are seen from below the surface.
template <class Op>
ProbeStrip probed_within(const typename Op::Params& params) {
  ProbeStrip strip;
  for (int i = 0; i < 32; ++i) {
    strip.pixels.push_back(test::random_pixel(i, everything()));
    strip.pixels.back().side = -1;
  }
  Pass pass = probe_context(everything());
  pass.submersible = true;
  DepthFog::Params fog = test::plain_fog(DepthFog::Model::kRadiativeTransfer);
  fog.crossing = DepthFog::Crossing::kRadiance;
  pass.medium = Kernel<DepthFog>::medium(fog, pass);
  Op::apply(params, pass, strip);
  return strip;
}

TEST(Contract, OnlyDeclaredStateIsMade) {
  Kernels::for_each([&]<class Op, int>() {
    const StateSet may_change = Op::kMakes;
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
  Kernels::for_each([&]<class Op, int>() {
    StateSet hidden;  // neither used nor made: its values must not matter
    for (StatePart part : test::kStateParts) {
      if (!Op::kUses.has(part) && !Op::kMakes.has(part)) hidden = hidden | StateSet{part};
    }
    for_each_params<Op>([&](const auto& params, const std::string& what) {
      ProbeStrip plain, disturbed;
      for (int i = 0; i < 32; ++i) {
        plain.pixels.push_back(test::random_pixel(i, StateSet(Op::kUses)));
        Pixel<double> p = plain.pixels.back();
        const Pixel<double> other = test::random_pixel(i + 1000, everything());
        for (StatePart part : test::kStateParts) {
          if (hidden.has(part)) test::copy_part(other, part, p);
        }
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
  Kernels::for_each([&]<class Op, int>() {
    for_each_params<Op>([&](const auto& params, const std::string& what) {
      const ProbeStrip strip = probed<Op>(params, everything(), everything());
      EXPECT_TRUE(Op::reads(params).covers(strip.tapped)) << what;
      // Some planes are read only where a better plane is absent.
      PlaneSet tapped = strip.tapped;
      for (const Role& role : roles()) {
        const PlaneSet optional = Op::reads(params) & role.planes();
        if (optional.empty() || Op::needs(params).planes.meets(optional)) continue;
        if (optional.meets(kColorPlanes | PlaneSet{PlaneId::kDepth})) continue;
        const ProbeStrip without = probed<Op>(params, everything(), everything(), optional);
        tapped = tapped | without.tapped;
        EXPECT_TRUE(Op::reads(params).covers(without.tapped)) << what;
      }
      const PlaneSet spare =
          Op::reads(params) - Op::needs(params).planes - kColorPlanes - PlaneSet{PlaneId::kDepth};
      tapped = tapped | probed<Op>(params, everything(), everything(), spare).tapped;
      const ProbeStrip bare =
          probed<Op>(params, everything(), everything(), kReflectionPlanes, false);
      if (!Op::needs(params).environment && !Op::needs(params).planes.meets(kReflectionPlanes)) {
        tapped = tapped | bare.tapped;
      }
      const ProbeStrip within = probed_within<Op>(params);
      EXPECT_TRUE(Op::reads(params).covers(within.tapped)) << what;
      tapped = tapped | within.tapped;
      EXPECT_TRUE(tapped.covers(Op::reads(params))) << what << " declares more than it taps";
      EXPECT_EQ(Op::needs(params).wave_map, strip.map_tapped) << what;
      // The environment may also stand in for a missing plane.
      EXPECT_TRUE(strip.environment_tapped || !Op::needs(params).environment) << what;
    });
  });
}

// So the bounds of operators add up: no operator amplifies an error of the operators before it.
TEST(Contract, LightIsPassedOnByAShareOfAtMostOne) {
  const auto sum = [](const Pixel<double>& p) {
    return p.transmitted + p.in_scatter + p.reflected + p.highlight;
  };
  Kernels::for_each([&]<class Op, int>() {
    for (int seed = 0; seed < 200; ++seed) {
      const typename Op::Params params = random_params<Op>(seed);
      ProbeStrip plain, brighter;
      plain.greatest = brighter.greatest = 1;  // a shadow is at most 1
      for (int i = 0; i < 8; ++i) {
        plain.pixels.push_back(test::random_pixel(100 * seed + i, everything()));
        Pixel<double> p = plain.pixels.back();
        p.side = 1;
        // The light that the sun scatters is part of all light that is scattered.
        p.sun_near = 0.3 * p.in_scatter, p.sun_far = 0.7 * p.in_scatter;
        plain.pixels.back() = p;
        p.transmitted = p.transmitted + Rgb<double>{0.1, 0.2, 0.3};
        p.in_scatter = p.in_scatter + Rgb<double>{0.3, 0.1, 0.2};
        p.reflected = p.reflected + Rgb<double>{0.2, 0.3, 0.1};
        p.highlight = p.highlight + Rgb<double>{0.05, 0.15, 0.1};
        brighter.pixels.push_back(p);
      }
      const Pass pass = probe_context(everything());
      Op::apply(params, pass, plain);
      Op::apply(params, pass, brighter);
      Ranges ranges;
      for (Range& color : ranges.color) color = {0, 1};
      if constexpr (requires { Op::propagate_ranges(params, pass, ranges); }) {
        Op::propagate_ranges(params, pass, ranges);
      }
      const double share = std::max(ranges.color[0].max, 1.0);
      for (int i = 0; i < 8; ++i) {
        const Rgb<double> more = sum(brighter.pixels[i]) - sum(plain.pixels[i]);
        EXPECT_LE(std::abs(more.r), 0.65 * share + 1e-9) << Op::kName << ", seed " << seed;
        EXPECT_LE(std::abs(more.g), 0.75 * share + 1e-9) << Op::kName << ", seed " << seed;
        EXPECT_LE(std::abs(more.b), 0.7 * share + 1e-9) << Op::kName << ", seed " << seed;
      }
    }
  });
}

TEST(Contract, BoundsAreNoNumbersBelowZero) {
  const Pass pass = probe_context(everything());
  Kernels::for_each([&]<class Op, int>() {
    for_each_params<Op>([&](const auto& params, const std::string& what) {
      Ranges nothing_known;
      EXPECT_GE(Op::bound(params, pass, nothing_known), 0) << what;
      Ranges dark = nothing_known;
      dark.color = {{{0, 0}, {0, 0}, {0, 0}}};
      dark.light = dark.sun_light = 0;
      EXPECT_GE(Op::bound(params, pass, dark), 0) << what;
      if constexpr (requires { Op::propagate_ranges(params, pass, dark); }) {
        Op::propagate_ranges(params, pass, dark);
        for (const Range& r : {dark.hit, dark.path, dark.fog_path}) {
          EXPECT_GE(r.min, 0) << what;
          EXPECT_LE(r.min, r.max) << what;
        }
        for (double x :
             {dark.transmittance, dark.light, dark.sun_light, dark.sun_far, dark.above}) {
          EXPECT_GE(x, 0) << what;
        }
      }
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
    const Pass pass = probe_context(everything());
    Kernels::for_each([&]<class Op, int>() {
      const typename Op::Params params = random_params<Op>(seed);
      EXPECT_GE(Op::reach(params), 0) << Op::kName;
      reach += Op::reach(params);
      Op::apply(params, pass, strip);
      for (Pixel<double>& p : strip.pixels) {  // the probe's plate normals are noise, not unit
        const Vec3<double> n = normalize_or<double>(p.normal, {0, 1, 0});
        if (std::is_same_v<Op, Kernel<WaveNormals>>) p.normal = n, p.tilt = {n.x, n.z};
      }
      EXPECT_LE(strip.farthest, reach + 1e-9) << Op::kName;
    });
  }
}

TEST(Contract, NeutralParametersAreTheIdentity) {
  std::set<std::string_view> seen;
  StateSet made;  // of the operators before: no state, then all state
  Kernels::for_each([&]<class Op, int>() {
    for (StateSet before : {StateSet{}, made}) {
      for_each_params<Op>([&](const auto& params, const std::string& what) {
        if (!Op::neutral(params, before)) return;
        seen.insert(Op::kName);
        // Refraction reads the pixel's own depth and color again, which the probe does not know:
        // the pictures below test refraction.
        if (std::is_same_v<Op, Kernel<Refraction>>) return;
        const ProbeStrip strip = probed<Op>(params, before, before);
        for (int i = 0; i < 32; ++i) {
          for (StatePart part : test::kStateParts) {
            if (part == StatePart::kPath) continue;  // the path is measured all the same
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

}  // namespace
}  // namespace limpid
