#include <functional>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "ops/contract.h"
#include "plan/pass_of.h"
#include "shade/symbol.h"

/// The recordings of single formulas.

namespace limpid {
namespace {

class RecorderTest : public testing::Test {
 protected:
  RecorderTest()
      : plan_(make_plan(Look{}, test::inputs_of(world_.buffers.frame, world_.scene))),
        pass_(pass_of(plan_, world_.scene, world_.buffers.frame)),
        homes_(plan_, pass_),
        recorder_(homes_) {}

  Symbol named(const char* name) { return given<Symbol>(0.25, name); }
  static std::string refusal(const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  test::World world_;
  Plan plan_;
  Pass pass_;
  NameTable homes_;
  Recorder recorder_;
};

TEST_F(RecorderTest, EqualNodesAreOne) {
  const Symbol a = named("a"), b = named("b");
  EXPECT_EQ((a + b).node(), (a + b).node());
  EXPECT_NE((a + b).node(), (b + a).node());
  EXPECT_NE((a - b).node(), (a + b).node());
  EXPECT_EQ(named("a").node(), a.node());
}

TEST_F(RecorderTest, KnownNumbersAreReckonedWith) {
  const Symbol a = named("a");
  EXPECT_EQ((Symbol(2) * Symbol(3)).node(), Symbol(6).node());
  EXPECT_EQ((a * Symbol(1)).node(), a.node());
  EXPECT_EQ((a + Symbol(0)).node(), a.node());
  EXPECT_NE((a * Symbol(0)).node(), Symbol(0).node()) << "0 times infinity is none";
  EXPECT_NE((Symbol(0) - a).node(), a.node());
  EXPECT_EQ(select(Symbol(1) < Symbol(2), a, Symbol(5)).node(), a.node());
  EXPECT_FALSE(any(Symbol(2) < Symbol(1)));
  EXPECT_TRUE(any(a < Symbol(1))) << "nobody knows";
}

TEST_F(RecorderTest, AnIfLeavesWhatItChanges) {
  const Symbol a = named("a");
  Symbol changed = a, same = a;
  const SymbolMask above = a > Symbol(0.5);
  if_any(above, [&] {
    changed = changed + Symbol(1);
    EXPECT_EQ(select(above, a, Symbol(9)).node(), a.node()) << "in here the mask holds";
  });
  EXPECT_EQ(same.node(), a.node());
  EXPECT_NE(changed.node(), a.node());
  recorder_.output("changed", changed.node());
  const Recording made = recorder_.take();
  ASSERT_EQ(made.flows.size(), 1u);
  const Flow& flow = made.flows[0];
  ASSERT_EQ(flow.merges.size(), 1u);
  EXPECT_EQ(flow.merges[0].before, a.node());
  EXPECT_EQ(flow.merges[0].merged, changed.node());
  EXPECT_EQ(made.nodes[static_cast<std::size_t>(flow.merges[0].after)].op, NodeOp::kAdd);
}

TEST_F(RecorderTest, ALoopCarriesWhatItsTurnsHandOn) {
  Symbol sum(0), last(0), idle = named("idle");
  steps<Symbol>(0, 5, [&](auto i) {
    last = sum;
    sum = sum + Loop<Symbol>::ratio(i, 5);
    return sum < Symbol(2);
  });
  recorder_.output("sum", sum.node());
  recorder_.output("last", last.node());
  const int idle_node = idle.node();
  EXPECT_EQ(idle_node, named("idle").node());
  const Recording made = recorder_.take();
  ASSERT_EQ(made.flows.size(), 1u) << "turns that were tried are gone";
  EXPECT_TRUE(made.flows[0].loops);
  EXPECT_EQ(made.flows[0].end, 5);
  EXPECT_GE(made.flows[0].condition, 0);
  EXPECT_EQ(made.flows[0].merges.size(), 2u);
}

TEST_F(RecorderTest, WhatNoOutputNeedsHasNoPlace) {
  const Symbol used = named("used"), unused = named("unused");
  const Symbol dead = unused * unused;
  recorder_.output("out", (used + used).node());
  const int dead_node = dead.node();
  const Recording made = recorder_.take();
  ASSERT_EQ(made.given.size(), 1u);
  EXPECT_EQ(made.given[0].name, "used");
  EXPECT_FALSE(made.live[static_cast<std::size_t>(dead_node)]);
}

TEST_F(RecorderTest, NumbersHaveTheNameOfWhereTheyLie) {
  recorder_.output("ior", given<Symbol>(pass_.ior).node());
  recorder_.output("b", given<Symbol>(plan_.look.of<DepthFog>().color.b).node());
  recorder_.output("third", given<Symbol>(7.0, "list", 3).node());
  const Recording made = recorder_.take();
  ASSERT_EQ(made.given.size(), 3u);
  EXPECT_EQ(made.given[0].name, "water.ior");
  EXPECT_EQ(made.given[0].value, 1.333);
  EXPECT_EQ(made.given[1].name, "depth_fog.color.b");
  EXPECT_EQ(made.given[2].name, "list[3]");
}

TEST_F(RecorderTest, RefusesWhatHasNoNameOrTwoValues) {
  const double homeless = 3;
  EXPECT_EQ(refusal([&] { given<Symbol>(homeless); }),
            "a number of the frame lies where no name is known: given() needs one");
  given<Symbol>(1.0, "twice");
  EXPECT_EQ(refusal([] { given<Symbol>(2.0, "twice"); }),
            "the name twice stands for two numbers of the frame");
  EXPECT_EQ(refusal([&] { Recorder second(homes_); }), "a recording is going on on this thread");
}

TEST(Symbol, IsANumberOfARecordingAlone) { EXPECT_THROW(Symbol(1.0), Error); }

}  // namespace
}  // namespace limpid
