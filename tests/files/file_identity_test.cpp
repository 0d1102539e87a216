#include "files/file_identity.h"

#include <fstream>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

class FileIdentityTest : public ::testing::Test {
 protected:
  FileIdentityTest()
      : here_(fs::path(testing::TempDir()) /
              (std::string("identity_") +
               testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(here_);
    fs::create_directories(here_ / "folder");
    fs::create_directory_symlink("folder", here_ / "by_link");
    std::ofstream(here_ / "a.exr") << "a";
  }
  ~FileIdentityTest() override { fs::remove_all(here_); }

  bool same(const fs::path& a, const fs::path& b) const {
    return identity_of(here_ / a) == identity_of(here_ / b);
  }

  fs::path here_;
};

TEST_F(FileIdentityTest, IsTheSameByAllNames) {
  fs::create_hard_link(here_ / "a.exr", here_ / "hard.exr");
  fs::create_symlink("a.exr", here_ / "soft.exr");
  for (const char* name : {"./a.exr", "folder/../a.exr", "hard.exr", "soft.exr"}) {
    EXPECT_TRUE(same("a.exr", name)) << name;
  }
  std::ofstream(here_ / "b.exr") << "a";
  EXPECT_FALSE(same("a.exr", "b.exr"));
}

TEST_F(FileIdentityTest, OfFilesThatAreNotThereIsTheirPlace) {
  fs::create_symlink("folder/new.exr", here_ / "soft.exr");
  for (const char* name : {"./folder/new.exr", "by_link/new.exr", "soft.exr"}) {
    EXPECT_TRUE(same("folder/new.exr", name)) << name;
  }
  for (const char* name : {"new.exr", "folder/old.exr", "no/new.exr", "a.exr"}) {
    EXPECT_FALSE(same("folder/new.exr", name)) << name;
  }
  EXPECT_TRUE(same("no/new.exr", "no/./new.exr"));
  EXPECT_FALSE(same("no/new.exr", "none/new.exr"));
}

TEST_F(FileIdentityTest, LinksAreFollowedToTheirEnd) {
  EXPECT_EQ(followed(here_ / "a.exr"), here_ / "a.exr");
  EXPECT_EQ(followed(here_ / "absent.exr"), here_ / "absent.exr");
  fs::create_symlink("folder/new.exr", here_ / "one.exr");
  fs::create_symlink(here_ / "one.exr", here_ / "two.exr");
  EXPECT_EQ(followed(here_ / "two.exr"), here_ / "folder/new.exr");
  fs::create_symlink("circle.exr", here_ / "circle.exr");
  EXPECT_THROW(followed(here_ / "circle.exr"), Error);
  EXPECT_TRUE(same("circle.exr", "./circle.exr"));  // the search ends
}

}  // namespace
}  // namespace limpid
