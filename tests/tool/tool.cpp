#include "tool/tool.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "paths.h"
#include "tool/made_plate.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;

std::string read_whole(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A name that no other running test uses.
fs::path fresh_folder(const std::string& name) {
  const fs::path path =
      fs::path(::testing::TempDir()) / ("limpid-" + name + "-" + std::to_string(::getpid()));
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

}  // namespace

void PrintTo(const Ran& ran, std::ostream* out) {
  *out << "exit " << ran.code << "\nstdout: " << ran.out << "\nstderr: " << ran.err;
}

Ran run(const fs::path& folder, const Words& command) {
  const fs::path logs = fresh_folder("logs");
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, 1, (logs / "out").c_str(), kWrite, 0600);
  ::posix_spawn_file_actions_addopen(&actions, 2, (logs / "err").c_str(), kWrite, 0600);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, words[0], &actions, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  rusage usage{};
  if (failed != 0 || ::wait4(child, &status, 0, &usage) != child) {
    ADD_FAILURE() << command[0] << " does not start";
    return {};
  }
  Ran ran{WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_whole(logs / "out"),
          read_whole(logs / "err"), 1024LL * usage.ru_maxrss};
  fs::remove_all(logs);
  return ran;
}

ToolTest::ToolTest()
    : folder_(fresh_folder(::testing::UnitTest::GetInstance()->current_test_info()->name())) {
  write_plate(folder_ / "plate.exr");
  write_waves(folder_ / "waves.exr");
  write_text("scene.toml", scene_toml());
  write_text("look.toml", look_toml());
}

ToolTest::~ToolTest() { fs::remove_all(folder_); }

Ran ToolTest::limpid(const Words& arguments) const {
  Words command{LIMPID_TOOL};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run(folder_, command);
}

Ran ToolTest::composite(const std::string& output, const Words& more) const {
  Words arguments{"composite", "plate.exr", "--scene", "scene.toml",
                  "--look",    "look.toml", "-o",      output};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return limpid(arguments);
}

void ToolTest::composed(const std::string& output, const Words& more) const {
  Words quiet = more;
  quiet.push_back("-q");
  const Ran ran = composite(output, quiet);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out + ran.err, "");
}

void ToolTest::expect_refused(const Ran& ran, const Words& parts, int code) const {
  EXPECT_EQ(ran.code, code) << ran.err;
  EXPECT_THAT(ran.err, ::testing::StartsWith("limpid ERROR: "));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_THAT(ran.err, ::testing::EndsWith("\n"));
  for (const std::string& part : parts) EXPECT_THAT(ran.err, ::testing::HasSubstr(part));
}

void ToolTest::expect_no_composite(const Words& more, const Words& parts, int code) const {
  write_text("old.exr", "old");
  const std::vector<std::string> before = files();
  Words arguments{"composite", "-o", "old.exr"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  if (std::find(more.begin(), more.end(), "--look") == more.end()) {
    arguments.insert(arguments.end(), {"--look", "look.toml"});
  }
  expect_refused(limpid(arguments), parts, code);
  EXPECT_EQ(text_of("old.exr"), "old");
  EXPECT_EQ(files(), before);
}

Ran ToolTest::oiiotool(const Words& arguments) const {
  Words command{OIIOTOOL};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run(folder_, command);
}

std::string ToolTest::iinfo(const Words& names) const {
  Words command{IINFO, "-v"};
  command.insert(command.end(), names.begin(), names.end());
  const Ran ran = run(folder_, command);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return ran.out;
}

bool ToolTest::same(const std::string& a, const std::string& b, double tolerance) const {
  std::ostringstream text;
  text << tolerance;
  const std::string limit = text.str();
  const Ran ran = oiiotool({"--fail", limit, "--warn", limit, a, b, "--diff"});
  const bool same = ran.code == 0;
  EXPECT_EQ(same, ran.out.find("PASS") != std::string::npos) << ran.out << ran.err;
  return same;
}

std::string ToolTest::text_of(const std::string& file) const { return read_whole(folder_ / file); }

void ToolTest::write_text(const std::string& file, const std::string& text) const {
  std::ofstream(folder_ / file, std::ios::binary) << text;
}

std::vector<std::string> ToolTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    names.push_back(fs::relative(entry.path(), folder_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace limpid::test
