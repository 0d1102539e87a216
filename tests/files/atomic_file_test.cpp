#include "files/atomic_file.h"

#include <cerrno>
#include <chrono>
#include <fstream>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "limpid/files/unfinished.h"

#include "files/file_handle.h"
#include "files/local_files.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// An empty folder of its own for each test.
fs::path folder() {
  const fs::path path =
      fs::path(testing::TempDir()) /
      (std::string("atomic_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

int files_in(const fs::path& path) {
  return static_cast<int>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

template <class Work>
std::string error_in(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The error of a path: AtomicFile and expect_replaceable() give the same sentence.
std::string error_of(const fs::path& path) {
  const std::string error = error_in([&] { AtomicFile file(path); });
  const std::string asked = error_in([&] { expect_replaceable(path); });
  return asked == error ? error : "asked: '" + asked + "', begun: '" + error + "'";
}

/// The error of a path in a process without root's right to write everywhere.
std::string error_as_nobody(const fs::path& path) {
  constexpr id_t kNobody = 65534;
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t nobody = ::fork();
  if (nobody == 0) {
    const bool root = ::geteuid() == 0;
    const bool dropped = !root || (::setgid(kNobody) == 0 && ::setuid(kNobody) == 0);
    const std::string error = dropped ? error_of(path) : "still root";
    const bool told = ::write(ends[1], error.data(), error.size()) >= 0;
    ::_exit(told ? 0 : 1);
  }
  ::close(ends[1]);
  std::string error;
  for (char letter = 0; ::read(ends[0], &letter, 1) == 1;) error += letter;
  ::close(ends[0]);
  ::waitpid(nobody, nullptr, 0);
  return error;
}

TEST(AtomicFile, AppearsAtCommit) {
  const fs::path path = folder() / "a.exr";
  write_text(path, "old");
  AtomicFile file(path);
  EXPECT_EQ(file.temporary().parent_path(), path.parent_path());
  EXPECT_EQ(file.temporary().extension(), ".exr");
  write_text(file.temporary(), "new");
  EXPECT_EQ(text_of(path), "old");
  file.commit();
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(files_in(path.parent_path()), 1);
}

TEST(AtomicFile, LeavesTheOldFileWithoutCommit) {
  const fs::path path = folder() / "a.exr";
  write_text(path, "old");
  {
    AtomicFile file(path);
    write_text(file.temporary(), "half a file");
  }
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(files_in(path.parent_path()), 1);
}

TEST(AtomicFile, TwoOfOneNameDoNotMeet) {
  const fs::path path = folder() / "a.exr";
  AtomicFile first(path), second(path);
  EXPECT_NE(first.temporary(), second.temporary());
}

TEST(AtomicFile, WorksOnABareName) {
  const fs::path before = fs::current_path(), here = folder();
  fs::current_path(here);
  AtomicFile file("bare.exr");
  file.commit();
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(here / "bare.exr"));
}

TEST(AtomicFile, NamesTheFolderThatCannotBeWritten) {
  const fs::path here = folder();
  EXPECT_EQ(error_of(here / "no" / "a.exr"),
            (here / "no" / "a.exr").string() + ": the folder '" + (here / "no").string() +
                "' cannot be written to (no such file or directory)");
  write_text(here / "file", "");
  EXPECT_THAT(error_of(here / "file" / "a.exr"), HasSubstr("not a directory"));
  fs::permissions(here, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  EXPECT_THAT(error_as_nobody(here / "a.exr"), HasSubstr("permission denied"));
  fs::permissions(here, fs::perms::owner_all);
}

TEST(AtomicFile, ReplacesFilesOnly) {
  const fs::path here = folder();
  fs::create_directory(here / "a.exr");
  EXPECT_THAT(error_of(here / "a.exr"), StartsWith((here / "a.exr").string() + ": exists and"));
  EXPECT_THAT(error_of("/dev/null"), StartsWith("/dev/null: exists and"));
}

TEST(AtomicFile, ReplacesWhatALinkLeadsTo) {
  const fs::path here = folder();
  fs::create_directory(here / "other");
  write_text(here / "other/real.exr", "old");
  fs::create_symlink("other/real.exr", here / "near.exr");
  fs::create_symlink(here / "near.exr", here / "far.exr");
  AtomicFile file(here / "far.exr");
  EXPECT_EQ(file.temporary().parent_path(), here / "other");
  write_text(file.temporary(), "new");
  EXPECT_EQ(text_of(here / "far.exr"), "old");
  file.commit();
  EXPECT_EQ(text_of(here / "other/real.exr"), "new");
  EXPECT_TRUE(fs::is_symlink(here / "near.exr"));
  EXPECT_TRUE(fs::is_symlink(here / "far.exr"));
  EXPECT_EQ(files_in(here / "other"), 1);
}

TEST(AtomicFile, MakesWhatADanglingLinkLeadsTo) {
  const fs::path here = folder();
  fs::create_directory(here / "other");
  fs::create_symlink("other/new.exr", here / "a.exr");
  AtomicFile(here / "a.exr").commit();
  EXPECT_TRUE(fs::is_symlink(here / "a.exr"));
  EXPECT_TRUE(fs::is_regular_file(here / "other/new.exr"));
  fs::create_symlink("absent/new.exr", here / "b.exr");
  EXPECT_EQ(error_of(here / "b.exr"), (here / "b.exr").string() + ": the folder '" +
                                          (here / "absent").string() +
                                          "' cannot be written to (no such file or directory)");
}

TEST(AtomicFile, RefusesLinksThatTheSystemDoesNotFollow) {
  const fs::path here = folder();
  fs::create_symlink("b.exr", here / "a.exr");
  fs::create_symlink("a.exr", here / "b.exr");
  EXPECT_THAT(error_of(here / "a.exr"),
              StartsWith((here / "a.exr").string() + ": is a link that cannot be followed ("));
  fs::create_directory(here / "folder");
  fs::create_symlink("folder", here / "c.exr");
  EXPECT_THAT(error_of(here / "c.exr"), StartsWith((here / "c.exr").string() + ": exists and"));
}

TEST(RemoveUnfinishedFiles, LeavesNothingButWholeFiles) {
  const fs::path here = folder();
  AtomicFile whole(here / "whole.exr"), first(here / "a.exr"), second(here / "b.png");
  whole.commit();
  EXPECT_EQ(files_in(here), 3);
  remove_unfinished_files().unlock();
  EXPECT_EQ(files_in(here), 1);
  EXPECT_THROW(first.commit(), Error);
  EXPECT_EQ(files_in(here), 1);
}

/// A process that has begun to write a file and writes on until a signal ends the process.
class Writer {
 public:
  explicit Writer(const fs::path& path) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    process_ = ::fork();
    if (process_ == 0) {
      const AtomicFile file(path);
      write_text(file.temporary(), "half a file");
      const char begun = 1;
      if (::write(ends[1], &begun, 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    char begun = 0;
    EXPECT_EQ(::read(ends[0], &begun, 1), 1);
    ::close(ends[0]);
    ::close(ends[1]);
  }
  void kill() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

 private:
  pid_t process_;
};

TEST(RemoveAbandonedFiles, OnlyWhatNobodyWritesAnyMore) {
  const fs::path here = folder();
  AtomicFile own(here / "own.exr");
  Writer living(here / "living.exr"), dead(here / "dead.exr");
  dead.kill();
  ASSERT_EQ(files_in(here), 3);
  remove_abandoned_files(here);
  EXPECT_EQ(files_in(here), 2);
  living.kill();
  remove_abandoned_files(here);
  EXPECT_EQ(files_in(here), 1);
  own.commit();
  EXPECT_TRUE(fs::exists(here / "own.exr"));
}

TEST(RemoveAbandonedFiles, OnlyWhatHasSuchAName) {
  const fs::path here = folder();
  for (const char* name : {".limpid-7-0.exr", ".limpid-12-34"}) write_text(here / name, "half");
  const std::vector<std::string> strange{"a.exr",          ".limpid-7.exr",    ".limpid-7-x.exr",
                                         ".limpid--0.exr", "x.limpid-7-0.exr", ".limpid-7-0exr"};
  for (const std::string& name : strange) write_text(here / name, "ours");
  fs::create_directory(here / ".limpid-7-1.exr");
  write_text(here / "elsewhere", "ours");
  fs::create_symlink(here / "elsewhere", here / ".limpid-7-2.exr");
  const int others = static_cast<int>(strange.size()) + 3;
  ASSERT_EQ(files_in(here), others + 2);
  remove_abandoned_files(here);
  EXPECT_EQ(files_in(here), others);
  EXPECT_EQ(text_of(here / "elsewhere"), "ours");
  remove_abandoned_files(here / "no");  // nothing to do
}

/// A lock on an open leftover temporary file keeps the file, although no process writes to it.
TEST(RemoveAbandonedFiles, LeavesWhatIsLocked) {
  const fs::path here = folder();
  write_text(here / ".limpid-7-0.exr", "half");
  const int other = ::open((here / ".limpid-7-0.exr").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  remove_abandoned_files(here);
  EXPECT_EQ(files_in(here), 1);
  ::close(other);
  remove_abandoned_files(here);
  EXPECT_EQ(files_in(here), 0);
}

TEST(AtomicFiles, AppearTogetherOrNotAtAll) {
  const fs::path here = folder();
  write_text(here / "a.exr", "old");
  {
    AtomicFiles files;
    write_text(files.add(here / "a.exr").temporary(), "new");
    EXPECT_THROW(files.add(here / "none/b.exr"), Error);
  }
  EXPECT_EQ(text_of(here / "a.exr"), "old");
  EXPECT_EQ(files_in(here), 1);
  AtomicFiles files;
  write_text(files.add(here / "a.exr").temporary(), "new");
  write_text(files.add(here / "b.exr").temporary(), "other");
  EXPECT_EQ(text_of(here / "a.exr"), "old");
  files.commit();
  EXPECT_EQ(text_of(here / "a.exr"), "new");
  EXPECT_EQ(text_of(here / "b.exr"), "other");
  EXPECT_EQ(files_in(here), 2);
}

TEST(TidyFolder, OnceAProcess) {
  const fs::path here = folder();
  write_text(here / ".limpid-7-0.exr", "half");
  fs::create_directory(here / "links");
  fs::create_symlink(here / "a.exr", here / "links/a.exr");
  AtomicFile(here / "a.exr").commit();
  EXPECT_TRUE(fs::exists(here / ".limpid-7-0.exr"));
  tidy_folder_of(here / "links/a.exr");  // the folder of the link's target
  EXPECT_FALSE(fs::exists(here / ".limpid-7-0.exr"));
  write_text(here / ".limpid-7-0.exr", "half");
  tidy_folder_of(here / "b.exr");
  EXPECT_TRUE(fs::exists(here / ".limpid-7-0.exr"));
}

TEST(ExpectReplaceable, LeavesTheFolderAsItWas) {
  const fs::path here = folder();
  write_text(here / "a.exr", "old");
  write_text(here / ".limpid-7-0.exr", "half");
  const auto long_ago = fs::last_write_time(here) - std::chrono::hours(1);
  fs::last_write_time(here, long_ago);
  expect_replaceable(here / "a.exr");
  expect_replaceable(here / "b.exr");
  EXPECT_EQ(fs::last_write_time(here), long_ago);
  EXPECT_EQ(files_in(here), 2);
  EXPECT_EQ(text_of(here / "a.exr"), "old");
}

/// Types as statfs(2) lists them.
TEST(LocalFiles, AreThoseThatAreKnown) {
  for (unsigned long type : {0xef53ul, 0x58465342ul, 0x9123683eul, 0xf2f52010ul, 0x2fc12fc1ul,
                             0x01021994ul, 0x794c7630ul}) {
    EXPECT_TRUE(is_local_type(type)) << std::hex << type;
  }
  // NFS, SMB, CIFS, SMB 2, FUSE, 9P, AFS, Ceph, and an unknown type.
  for (unsigned long type : {0x6969ul, 0x517bul, 0xff534d42ul, 0xfe534d42ul, 0x65735546ul,
                             0x01021997ul, 0x5346414ful, 0x00c36400ul, 0ul}) {
    EXPECT_FALSE(is_local_type(type)) << std::hex << type;
  }
  const int proc = ::open("/proc/self/status", O_RDONLY | O_CLOEXEC);
  EXPECT_FALSE(is_local(proc));
  ::close(proc);
  EXPECT_FALSE(is_local(-1));
}

TEST(FaultOf, WhatMayPassIsTriedAgain) {
  for (int error : {ENOSPC, EDQUOT, EFBIG, EIO, ESTALE}) EXPECT_EQ(fault_of(error), Fault::kRetry);
  for (int error : {EACCES, ENOENT, EROFS}) EXPECT_EQ(fault_of(error), Fault::kJob);
}

}  // namespace
}  // namespace limpid
