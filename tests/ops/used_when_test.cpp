#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "ops/contract.h"
#include "ops/kernels.h"
#include "ops/noise_caustics.h"
#include "ops/probe_strip.h"

// The conditions in the tables under which a parameter matters, compared with the operators'
// effects.

namespace limpid {
namespace {

using test::candidates;
using test::label;
using test::ProbeStrip;

StateSet everything() {
  StateSet all;
  for (StatePart part : test::kStateParts) all = all | StateSet{part};
  return all;
}

template <class Op>
const Field<typename Op::Params>* field_named(std::string_view name) {
  for (const auto& field : Op::fields()) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

TEST(UsedWhen, ConditionsNameWordsOfTheSameOperator) {
  Kernels::for_each([&]<class Op, int>() {
    for (const auto& field : Op::fields()) {
      for (const Condition& condition : field.used_when) {
        if (condition.key.empty()) continue;
        const auto* other = field_named<Op>(condition.key);
        ASSERT_NE(other, nullptr) << label<Op>(field.name);
        EXPECT_NE(other->name, field.name);
        EXPECT_FALSE(condition.words.front().empty()) << label<Op>(field.name);
        if (!condition.or_above_zero.empty()) {
          const auto* number = field_named<Op>(condition.or_above_zero);
          ASSERT_NE(number, nullptr) << label<Op>(field.name);
          EXPECT_EQ(number->kind, FieldKind::kReal) << label<Op>(field.name);
        }
        for (const std::string_view word : condition.words) {
          if (word.empty()) continue;
          if (other->kind == FieldKind::kReal) {
            EXPECT_EQ(word, "0") << label<Op>(field.name);
            EXPECT_TRUE(other->range.min <= 0 && 0 <= other->range.max);
            continue;
          }
          EXPECT_EQ(std::count(other->choices.begin(), other->choices.end(), word), 1)
              << label<Op>(field.name) << ": " << word;
        }
      }
    }
  });
}

/// All state of a few pixels after an operator, as numbers.
template <class Op>
std::vector<double> made_by(const typename Op::Params& params, const Pass& pass) {
  ProbeStrip strip;
  for (int i = 0; i < 8; ++i) strip.pixels.push_back(test::random_pixel(i, everything()));
  Op::apply(params, pass, strip);
  std::vector<double> all{strip.farthest};
  for (const Pixel<double>& p : strip.pixels) {
    for (StatePart part : test::kStateParts) {
      const std::vector<double> values = test::values_of(p, part);
      all.insert(all.end(), values.begin(), values.end());
    }
  }
  return all;
}

template <class Op>
bool read(const Field<typename Op::Params>& field, const typename Op::Params& params) {
  return std::all_of(field.used_when.begin(), field.used_when.end(), [&](const Condition& c) {
    const auto* other = field_named<Op>(c.key);
    const auto* number = field_named<Op>(c.or_above_zero);
    return !other || c.holds(to_string(other->get(params)),
                             number ? std::get<double>(number->get(params)) : 0);
  });
}

/// Parameters in range; numbers on which other parameters depend are 0 by turns.
template <class Op>
typename Op::Params some_params(int seed) {
  typename Op::Params params = test::random_params<Op>(seed);
  if (seed % 2 == 0) return params;
  for (const auto& field : Op::fields()) {
    for (const Condition& condition : field.used_when) {
      const auto* other = field_named<Op>(condition.key);
      if (other && other->kind == FieldKind::kReal) assign(Op::kName, *other, params, 0.0);
    }
  }
  return params;
}

TEST(UsedWhen, WhatIsNotReadChangesNothingAndTheRestDoesSomewhere) {
  const test::World world;
  Frame frame = world.buffers.frame;
  const test::NoiseCaustics caustics;
  frame.caustics = &caustics.table;
  const Pass pass(world.scene, frame, 1.333, everything());
  Kernels::for_each([&]<class Op, int>() {
    for (const auto& field : Op::fields()) {
      // Not visible in pixels: a file's name, a choice of one, the thickness
      // (complete/bottom_layer_test.cpp), and frames without sun_color (ops/caustics_test.cpp).
      const bool only = field.kind == FieldKind::kChoice && field.choices.size() == 1;
      bool matters = only || field.kind == FieldKind::kText || field.name == "thickness" ||
                     field.name == "sun_share";
      for (int seed = 0; seed < 60; ++seed) {
        const typename Op::Params params = some_params<Op>(seed);
        const std::vector<double> before = made_by<Op>(params, pass);
        for (const Value& value : candidates(field)) {
          typename Op::Params other = params;
          assign(Op::kName, field, other, value);
          const bool same = made_by<Op>(other, pass) == before;
          if (!read<Op>(field, params)) {
            ASSERT_TRUE(same) << label<Op>(field.name) << ", seed " << seed;
          }
          matters = matters || (read<Op>(field, params) && !same);
        }
      }
      EXPECT_TRUE(matters) << label<Op>(field.name);
    }
  });
}

}  // namespace
}  // namespace limpid
