// limpid view as a program: its one line, its end, and its refusals. tests/desk checks its pages.
#include <csignal>
#include <regex>

#include <gmock/gmock.h>

#include "paths.h"
#include "tool/running.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

using ViewTest = ToolTest;

Words view(const Words& more) {
  Words words = {LIMPID_TOOL,  "view",   "plate.exr", "--scene",
                 "scene.toml", "--look", "look.toml", "--no-browser"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(ViewTest, PrintsItsAddressAndEndsAtASignal) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::vector<std::string> before = files();
    Running page(folder_, view({}));
    const std::optional<std::string> address = page.line();
    ASSERT_TRUE(address);
    EXPECT_THAT(*address, MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/[0-9a-f]{32}/"));
    page.send(signal);
    EXPECT_EQ(page.wait(), -signal);
    EXPECT_EQ(files(), before);
  }
}

TEST_F(ViewTest, ServesAtThePortThatIsNamed) {
  Running first(folder_, view({}));
  const std::string address = first.line().value_or("");
  std::smatch port;
  ASSERT_TRUE(std::regex_search(address, port, std::regex(":([0-9]+)/")));
  const Ran second = run(folder_, view({"--port", port[1]}));
  expect_refused(second, {"port " + port[1].str() + ": cannot be opened (in use"});
  first.send(SIGTERM);
  first.wait();
  Running third(folder_, view({"--port", port[1]}));
  EXPECT_THAT(third.line().value_or(""), HasSubstr(":" + port[1].str() + "/"));
}

TEST_F(ViewTest, RefusesWhatIsWrongBeforeItServes) {
  const auto refused = [&](const Words& more, const std::string& part, int code) {
    expect_refused(run(folder_, view(more)), {part}, code);
  };
  refused({"--set", "depth_fog.densty=1"}, "did you mean 'density'?", 2);
  refused({"--folder", "nowhere"}, "--folder nowhere: expected an existing folder", 2);
  refused({"--port", "70000"}, "--port", 2);
  refused({"--fps", "25"}, "--fps: expected --frames beside it", 2);
  refused({"--aov", "path"}, "has no option '--aov'", 2);
  refused({"-o", "wet.exr"}, "has no option '-o'", 2);
  refused({"--layer", "depth=none"}, "no depth", 1);
  refused({"--reference", "none.exr"}, "none.exr", 1);
  expect_refused(limpid({"view", "--no-browser"}), {"nothing to put water into"}, 2);
  expect_refused(limpid({"view", "none.exr", "--scene", "scene.toml", "--no-browser"}),
                 {"none.exr"}, 1);
}

}  // namespace
}  // namespace limpid::test
