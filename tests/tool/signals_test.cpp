#include "../../tools/limpid/signals.h"

#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

#include "files/atomic_file.h"
#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

/// The end of a process that receives the signal while it writes a file: the signal, or minus the
/// exit code.
int end_of_writer(const std::filesystem::path& file, int signal) {
  const pid_t writer = ::fork();
  if (writer == 0) {
    tool::end_cleanly_on_signals();
    const AtomicFile unfinished(file);
    ::kill(::getpid(), signal);
    for (;;) ::pause();
  }
  int status = 0;
  ::waitpid(writer, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : -WEXITSTATUS(status);
}

class SignalsTest : public ToolTest, public ::testing::WithParamInterface<int> {};

TEST_P(SignalsTest, EndTheProcessButLeaveNoTemporaryFile) {
  const std::vector<std::string> before = files();
  EXPECT_EQ(end_of_writer(folder_ / "wet.exr", GetParam()), GetParam());
  EXPECT_EQ(files(), before);
}

INSTANTIATE_TEST_SUITE_P(All, SignalsTest, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

using SignalsToolTest = ToolTest;

TEST_F(SignalsToolTest, AFileSizeLimitIsAnErrorWorthTryingAgain) {
  const std::vector<std::string> before = files();
  const Ran ran = run(folder_, {"/bin/sh", "-c", "ulimit -f 8; exec \"$@\"", "sh", LIMPID_TOOL,
                                "composite", "plate.exr", "--scene", "scene.toml", "--look",
                                "look.toml", "--float", "--compression", "none", "-o", "wet.exr"});
  expect_refused(ran, {"wet.exr: cannot be written (file too large)"}, 75);
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace limpid::test
