#include "shade/glsl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ops/contract.h"
#include "plan/pass_of.h"
#include "shade/bundled.h"
#include "shade/program.h"
#include "shade/symbol.h"

/// The text of recordings. Other tests run the text and compare its results.

namespace limpid {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class GlslTest : public testing::Test {
 protected:
  GlslTest()
      : plan_(make_plan(Look{}, test::inputs_of(world_.buffers.frame, world_.scene))),
        pass_(pass_of(plan_, world_.scene, world_.buffers.frame)),
        names_(plan_, pass_),
        recorder_(names_) {}

  static Symbol own(PlaneId plane) {
    return Symbol::of(
        Recorder::current().add(NodeOp::kOwn, NodeType::kNumber, {-1, -1, -1}, index_of(plane)));
  }
  Recording recording_of(const Symbol& output) {
    recorder_.output("color.r", output.node());
    return recorder_.take();
  }

  test::World world_;
  Plan plan_;
  Pass pass_;
  NameTable names_;
  Recorder recorder_;
};

TEST_F(GlslTest, WhatFollowsFromTheFrameIsComputedOnce) {
  const Symbol a = given<Symbol>(3, "a"), b = given<Symbol>(0.5, "b"), x = own(PlaneId::kDepth);
  const Symbol outer = select(a < b, a, sqrt(a + Symbol(1)) / b);
  const Recording recording = recording_of(outer * x + b * x);
  const GlslBody each(recording), once(recording, true);
  EXPECT_TRUE(each.frame_numbers().empty());
  EXPECT_THAT(each.text(), HasSubstr("limpid.a"));
  EXPECT_THAT(once.frame_numbers(), ElementsAre(4.0));
  EXPECT_THAT(once.text(), HasSubstr("limpid.frame_0"));
  EXPECT_THAT(once.text(), HasSubstr("limpid.b")) << "a number of the frame itself has its name";
  EXPECT_THAT(once.text(), Not(HasSubstr("limpid.a")));
}

TEST_F(GlslTest, ATexelThatAnIfReplacesIsReadWhereItDoesNot) {
  const Symbol depth = own(PlaneId::kDepth);
  Symbol color = own(PlaneId::kColorR);
  if_any(depth > Symbol(2), [&] { color = depth; });
  const std::string text = GlslBody(recording_of(color)).text();
  EXPECT_LT(text.find("} else {"), text.find("limpid_texel_color")) << text;
}

/// Of other words for a choice between numbers compilers make branches: a browser took seven times
/// as long for `physical`.
TEST_F(GlslTest, NothingButAnIfIsABranch) {
  const Symbol a = own(PlaneId::kDepth), b = own(PlaneId::kShadow), c = own(PlaneId::kColorR);
  const auto both = a + b < c && (b + c < a || c * a < b);
  const std::string text = GlslBody(recording_of(select(both, a * b, b / c))).text();
  EXPECT_THAT(text, HasSubstr("mix("));
  EXPECT_THAT(text, Not(HasSubstr(" ? ")));
  EXPECT_THAT(text, HasSubstr(" && t"));
  EXPECT_THAT(text, HasSubstr(" || t"));
}

/// Lookups of one width share an if: four ifs, one after another, would wait for one another.
TEST_F(GlslTest, LookupsOfOneWidthShareAnIf) {
  const Symbol width = own(PlaneId::kDepth), other = own(PlaneId::kSurfaceDepth);
  const auto lookup = [&](double at, const Symbol& wide) {
    const int node = recorder_.add(NodeOp::kTiledWide, NodeType::kThree,
                                   {Symbol(at).node(), Symbol(0).node(), wide.node()});
    return Symbol::of(recorder_.part(node, 0));
  };
  const Symbol sum = lookup(0.25, width) + lookup(0.5, width) + lookup(0.75, other);
  const std::string text = GlslBody(recording_of(sum)).text();
  const std::size_t first = text.find("if (limpid_is_fine(");
  EXPECT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find("if (limpid_is_fine(", first + 1), std::string::npos) << text;
}

int count(const std::string& text, const std::string& words) {
  int times = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    ++times;
  }
  return times;
}

/// What stands between them comes first, and a number that both change begins as before the first.
TEST_F(GlslTest, IfsOfOneConditionAreOne) {
  const Symbol depth = own(PlaneId::kDepth);
  const SymbolMask far = depth > Symbol(2);
  Symbol a = Symbol(1), b = Symbol(3);
  if_any(far, [&] { a = depth; });
  const Symbol between = sqrt(depth);
  if_any(far, [&] {
    a = a * between;
    b = between;
  });
  const std::string text = GlslBody(recording_of(a + b * between)).text();
  EXPECT_EQ(count(text, "if ("), 1) << text;
  EXPECT_LT(text.find("sqrt("), text.find("if (")) << text;
  EXPECT_EQ(count(text, " = 1.0;"), 2) << text;
  EXPECT_EQ(count(text, " = 3.0;"), 1) << text;
}

/// What the first one changes is known only behind it.
TEST_F(GlslTest, IfsStayTwoWhereWhatStandsBetweenNeedsTheFirst) {
  const Symbol depth = own(PlaneId::kDepth);
  const SymbolMask far = depth > Symbol(2);
  Symbol a = Symbol(1);
  if_any(far, [&] { a = depth; });
  const Symbol between = sqrt(a);
  if_any(far, [&] { a = a * between; });
  const std::string text = GlslBody(recording_of(a + between)).text();
  EXPECT_EQ(count(text, "if ("), 2) << text;
}

/// Where places follow from the index, the lookups of four steps are made together; where they
/// follow from what the step before found, each step makes its own.
TEST_F(GlslTest, LookupsOfALoopAreMadeBeforeTheirSteps) {
  const auto looked_up = [&](const Symbol& x) {
    return Symbol::of(recorder_.add(NodeOp::kNearest, NodeType::kNumber,
                                    {x.node(), Symbol(0).node(), -1}, index_of(PlaneId::kDepth)));
  };
  const auto is_open = [](const Symbol& sum) { return sum < Symbol(9); };
  Symbol ahead = own(PlaneId::kDepth), behind = own(PlaneId::kSurfaceDepth);
  const Symbol width = sqrt(ahead);
  steps<Symbol>(1, 17, [&](auto i) {
    ahead = ahead + looked_up(width * Loop<Symbol>::ratio(i, 16));
    return is_open(ahead);
  });
  steps<Symbol>(1, 17, [&](auto i) {
    behind = behind + looked_up(behind * Loop<Symbol>::ratio(i, 16));
    return is_open(behind);
  });
  const std::string text = GlslBody(recording_of(ahead + behind)).text();
  EXPECT_EQ(count(text, "for (int "), 2) << text;
  EXPECT_EQ(count(text, " - 1) % 4 == 0) {"), 1) << text;
  EXPECT_EQ(count(text, "limpid_nearest_depth("), 4 + 1) << text;
  EXPECT_EQ(count(text, " + 3.0) / 16.0"), 1) << text;
}

/// A nearest texel, and the four texels at the same place or, where it is refused, at `elsewhere`.
class NearestTexelTest : public GlslTest {
 protected:
  std::string text_with(const Symbol& elsewhere) {
    const Symbol x = own(PlaneId::kColorR), y = own(PlaneId::kColorG);
    const auto lookup = [&](NodeOp op, NodeType type, int a, int b) {
      return recorder_.add(op, type, {a, b, -1}, index_of(PlaneId::kDepth));
    };
    const Symbol nearest =
        Symbol::of(lookup(NodeOp::kNearest, NodeType::kNumber, x.node(), y.node()));
    const SymbolMask refused = nearest < own(PlaneId::kSurfaceDepth);
    const Symbol u = select(refused, elsewhere, x), v = select(refused, Symbol(0), y);
    const int quad = recorder_.add(NodeOp::kQuad, NodeType::kFour, {u.node(), v.node(), -1});
    const int four = lookup(NodeOp::kRead, NodeType::kFour, quad, -1);
    return GlslBody(recording_of(nearest + Symbol::of(recorder_.part(four, 2)))).text();
  }
};

TEST_F(NearestTexelTest, IsOneOfTheFourThatAreReadUnlessItIsRefused) {
  const std::string text = text_with(Symbol(0));
  EXPECT_EQ(count(text, "limpid_nearest_depth("), 0) << text;
  EXPECT_EQ(count(text, "limpid_nearest_of("), 1) << text;
  EXPECT_EQ(count(text, "limpid_read_depth_r("), 1) << text;
  EXPECT_EQ(count(text, " ? vec4(limpid_texel_depth(limpid_pixel).r) : "), 1) << text;
}

TEST_F(NearestTexelTest, IsLookedUpWhereTheFourAreElsewhere) {
  const std::string text = text_with(Symbol(1));
  EXPECT_EQ(count(text, "limpid_nearest_depth("), 1) << text;
  EXPECT_EQ(count(text, "limpid_nearest_of("), 0) << text;
  EXPECT_EQ(count(text, "limpid_read_depth_r("), 1) << text;
}

TEST_F(GlslTest, SlopesOfOnePlaceAreOneLookup) {
  const Symbol x = own(PlaneId::kDepth);
  const auto lookup = [&](NodeOp op, NodeType type, const Symbol& at) {
    const int node = recorder_.add(op, type, {at.node(), at.node(), x.node()});
    return Symbol::of(recorder_.part(node, 0));
  };
  const Symbol far = x + Symbol(1);
  const Symbol mean = lookup(NodeOp::kSlopeMean, NodeType::kTwo, x);
  const Symbol square = lookup(NodeOp::kSlopeSquare, NodeType::kThree, x);
  const Symbol other = lookup(NodeOp::kSlopeSquare, NodeType::kThree, far);
  const std::string text = GlslBody(recording_of(mean + square + other)).text();
  EXPECT_EQ(count(text, "limpid_slope_moments("), 1) << text;
  EXPECT_EQ(count(text, "limpid_slope_mean("), 0) << text;
  EXPECT_EQ(count(text, "limpid_slope_square("), 1) << text;
}

/// Where a device is faster with them; a compiler that may reorder sums must not see them.
TEST(ProgramOfARunner, SumsCornersInProgramsOfMiddleLengthAlone) {
  const test::World world(false);
  const Frame& frame = world.buffers.frame;
  const auto sums = [&](const char* look, Gathered gathered) {
    const Plan plan = make_plan(test::shipped_look(look), test::inputs_of(frame, world.scene));
    const Pass pass = pass_of(plan, world.scene, frame);
    const std::string text = program_of(plan, frame, frame, pass, {}, gathered).text;
    return text.find("limpid_floor(") != std::string::npos;
  };
  EXPECT_TRUE(sums("fast", Gathered::kAll));
  EXPECT_FALSE(sums("fast", Gathered::kNothing));
  EXPECT_FALSE(sums("realistic", Gathered::kAll));
  EXPECT_FALSE(sums("physical", Gathered::kAll));
}

/// As for the texts for hosts: a pipeline lasts for a sequence.
TEST(ProgramOfARunner, IsTheSameForAnyTimeAndStrength) {
  const test::World world(false);
  const Frame& frame = world.buffers.frame;
  const auto program = [&](double time, double strength) {
    Look look = test::shipped_look("realistic");
    look.of<Refraction>().strength = strength;
    Scene scene = world.scene;
    scene.time = time;
    const Plan plan = make_plan(look, test::inputs_of(frame, scene));
    const Pass pass = pass_of(plan, scene, frame);
    return program_of(plan, frame, frame, pass, {}, Gathered::kAll);
  };
  const ShaderProgram a = program(0, 0.03), b = program(7, 0.01);
  EXPECT_EQ(a.text, b.text);
  EXPECT_NE(a.block, b.block);
}

}  // namespace
}  // namespace limpid
