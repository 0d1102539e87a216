#include "limpid/core/field.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace limpid {
namespace {

enum class Shape { kRound, kFlat };
struct Params {
  Shape shape = Shape::kFlat;
  double size = 2;
  Rgb<double> tint{0.5, 0.5, 0.5};
  std::string file;
};
constexpr std::string_view kShapes[] = {"round", "flat"};
constexpr Field<Params> kFields[] = {
    choice<&Params::shape, kShapes>("shape", "Its shape."),
    real<&Params::size>("size", "m", {0, 10}, "Its size."),
    color<&Params::tint>("tint", "", {0, 1}, "Its color."),
    text<&Params::file>("file", "Where it lies."),
};
constexpr std::span<const Field<Params>> kAll = kFields;

/// What assign() says, "" when it takes the value.
std::string refusal(int field, const Value& value) {
  Params params;
  try {
    assign("thing", kFields[field], params, value);
  } catch (const Error& e) {
    EXPECT_EQ(kFields[field].get(params), kFields[field].get(Params{})) << "changed all the same";
    return e.what();
  }
  EXPECT_EQ(kFields[field].get(params), value);
  return "";
}

TEST(Field, TakesWhatIsDeclared) {
  EXPECT_EQ(refusal(0, "round"), "");
  EXPECT_EQ(refusal(1, 0.0), "");
  EXPECT_EQ(refusal(1, 10.0), "");
  EXPECT_EQ(refusal(2, Rgb<double>{0, 1, 0.25}), "");
  EXPECT_EQ(refusal(3, "waves.exr"), "");
}

TEST(Field, RefusesWithOneSentence) {
  EXPECT_EQ(refusal(1, 10.5), "thing.size = 10.5: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(1, -1.0), "thing.size = -1: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(1, "big"), "thing.size = big: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(1, std::nan("")), "thing.size = nan: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(2, Rgb<double>{0, 2, 0}),
            "thing.tint = [0, 2, 0]: expected three numbers, each 0 ... 1");
  EXPECT_EQ(refusal(2, 0.5), "thing.tint = 0.5: expected three numbers, each 0 ... 1");
  EXPECT_EQ(refusal(0, "rond"),
            "thing.shape = rond: expected one of round, flat; did you mean 'round'?");
  EXPECT_EQ(refusal(0, 1.0), "thing.shape = 1: expected one of round, flat");
  EXPECT_EQ(refusal(3, 1.0), "thing.file = 1: expected a text");
}

TEST(Field, ValidateFindsTheFirstBadParameter) {
  Params params;
  EXPECT_NO_THROW(validate("thing", kAll, params));
  params.tint.g = -0.1;
  params.size = std::numeric_limits<double>::infinity();
  try {
    validate("thing", kAll, params);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "thing.size = inf: expected 0 ... 10 (m)");
  }
}

TEST(Value, PrintsItself) {
  EXPECT_EQ(to_string(Value(0.03)), "0.03");
  EXPECT_EQ(to_string(Value("snap")), "snap");
  EXPECT_EQ(to_string(Value(Rgb<double>{1, 0.5, 0})), "[1, 0.5, 0]");
}

}  // namespace
}  // namespace limpid
