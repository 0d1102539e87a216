#include "limpid/run/target.h"

#include <gtest/gtest.h>

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
    EXPECT_EQ(said.rfind("'transmited' is no AOV: expected one of ", 0), 0u) << said;
    for (const AovInfo& aov : aovs()) EXPECT_NE(said.find(aov.name), std::string::npos) << said;
    EXPECT_NE(said.find("'transmitted'"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace limpid
