#include "limpid/run/target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/run/aov_names.h"

#include "support.h"

namespace limpid {
namespace {

TEST(Aovs, AreFoundByTheirNames) {
  ASSERT_EQ(aovs().size(), static_cast<std::size_t>(kAovCount));
  for (int i = 0; i < kAovCount; ++i) {
    EXPECT_EQ(aov_named(aovs()[static_cast<std::size_t>(i)].name), static_cast<Aov>(i)) << i;
  }
}

TEST(Aovs, AnUnknownNameIsRefusedWithAllThatThereAre) {
  try {
    aov_named("transmited");
    FAIL();
  } catch (const Error& error) {
    const std::string said = error.what();
    EXPECT_EQ(said.rfind("'transmited' is not an AOV: expected one of ", 0), 0u) << said;
    for (const AovInfo& aov : aovs()) EXPECT_NE(said.find(aov.name), std::string::npos) << said;
    EXPECT_NE(said.find("'transmitted'"), std::string::npos) << said;
  }
}

TEST(Aovs, HaveTheNamesOfTheHost) {
  const auto names = [](Aov aov, AovNames host) {
    std::vector<std::string> channels;
    for (const AovChannel& channel : aov_channels(aov, host)) channels.push_back(channel.name);
    return channels;
  };
  using testing::ElementsAre;
  EXPECT_THAT(names(Aov::kInScatter, AovNames::kLimpid),
              ElementsAre("in_scatter.R", "in_scatter.G", "in_scatter.B"));
  EXPECT_THAT(names(Aov::kInScatter, AovNames::kNuke),
              ElementsAre("in_scatter.red", "in_scatter.green", "in_scatter.blue"));
  EXPECT_THAT(names(Aov::kNormal, AovNames::kNuke),
              ElementsAre("normal.X", "normal.Y", "normal.Z"));
  EXPECT_THAT(names(Aov::kFresnel, AovNames::kNuke), ElementsAre("fresnel.red"));
  EXPECT_THAT(names(Aov::kFresnel, AovNames::kArnold), ElementsAre("fresnel"));
  EXPECT_THAT(names(Aov::kPath, AovNames::kBlender), ElementsAre("ViewLayer.path.Z"));
}

}  // namespace
}  // namespace limpid
