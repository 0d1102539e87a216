#include "limpid/core/frame.h"

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "support.h"

namespace limpid {
namespace {

using test::Buffers;
using testing::HasSubstr;

std::string refusal(const Frame& frame) {
  try {
    frame.validate();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(PlaneSet, IsASet) {
  constexpr PlaneSet a{PlaneId::kDepth, PlaneId::kShadow}, b{PlaneId::kShadow};
  static_assert(a.covers(b) && !b.covers(a) && a.has(PlaneId::kDepth));
  EXPECT_EQ(a - b, PlaneSet{PlaneId::kDepth});
  EXPECT_EQ(a & b, b);
  EXPECT_EQ(b | PlaneSet{PlaneId::kDepth}, a);
  EXPECT_TRUE((a - a).empty());
  EXPECT_TRUE(b.covers({}));
}

TEST(Roles, CoverEveryPlaneOnceInOrder) {
  int next = 0;
  for (const Role& role : roles()) {
    EXPECT_EQ(index_of(role.first), next) << role.name;
    EXPECT_FALSE(role.about.empty());
    EXPECT_EQ(&role_named(role.name), &role);
    next += role.count;
  }
  EXPECT_EQ(next, kPlaneCount);
}

TEST(Roles, HaveChannelsOfTheirOwnInFiles) {
  std::set<std::string> names;
  std::size_t planes = 0;
  for (const Role& role : roles()) {
    EXPECT_EQ(role.storage == Storage::kFloat, role.sanitise == Sanitise::kDepth) << role.name;
    EXPECT_EQ(role.layer.empty(), role.channels.empty()) << role.name;
    for (int i = 0; i < role.count && !role.layer.empty(); ++i, ++planes) {
      EXPECT_TRUE(channel_name(role, i).starts_with(std::string(role.layer) + "."));
      names.insert(channel_name(role, i));
    }
  }
  EXPECT_EQ(names.size(), planes) << "no two planes in one channel";
  EXPECT_EQ(channel_name(role_named("color"), 3), "color.A");
  EXPECT_EQ(channel_name(role_named("surface_normal"), 1), "surface.NY");
  EXPECT_EQ(channel_name(role_named("reflection_valid"), 0), "reflection.A");
  EXPECT_EQ(channel_name(role_named("below_depth"), 0), "below.Z");
  EXPECT_EQ(channel_name(role_named("sky"), 0), "") << "files have none";
}

TEST(Roles, ReadSensiblyOutsideTheirWindow) {
  EXPECT_TRUE(std::isinf(role_named("depth").missing));
  EXPECT_TRUE(std::isinf(role_named("surface_depth").missing));
  EXPECT_EQ(role_named("shadow").missing, 1);
  EXPECT_EQ(role_named("sun_color").missing, 0) << "as in shadow";
  EXPECT_EQ(role_named("reflection").planes(), kReflectionPlanes);
  EXPECT_EQ(role_named("sun_color").planes(), kSunColorPlanes);
}

TEST(Roles, UnknownNameGetsTheNearest) {
  try {
    role_named("shadwo");
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("did you mean 'shadow'?"));
  }
}

TEST(Frame, WorkIsTheDisplayWindowAsFarAsThereIsColor) {
  Buffers b(Rect{0, 0, 10, 8});
  for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
    b.set(
        id, [](int, int) { return 0.f; }, Rect{2, -3, 30, 6});
  }
  EXPECT_EQ(b.frame.work(), (Rect{2, 0, 10, 6}));
  EXPECT_EQ(b.frame.present(), kColorPlanes);
  EXPECT_EQ(refusal(b.frame), "");
}

TEST(Frame, RefusesWhatDoesNotFit) {
  Buffers b(Rect{0, 0, 4, 4});
  EXPECT_THAT(refusal(b.frame), HasSubstr("no color"));
  for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) b.fill(id, 0.5f);
  EXPECT_EQ(refusal(b.frame), "");
  b.set(
      PlaneId::kDepth, [](int, int) { return 1.f; }, Rect{0, 0, 4, 3});
  EXPECT_THAT(refusal(b.frame), HasSubstr("depth covers the pixels (0, 0) - (4, 3)"));
  Frame empty = b.frame;
  empty.display = {0, 0, 0, 4};
  EXPECT_THAT(refusal(empty), HasSubstr("display window is empty"));
  Frame elsewhere = b.frame;
  elsewhere.display = {50, 50, 60, 60};
  EXPECT_THAT(refusal(elsewhere), HasSubstr("no pixel of color"));
}

}  // namespace
}  // namespace limpid
