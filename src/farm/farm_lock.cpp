// The lock of a farm.
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include "limpid/core/error.h"

#include "farm/farm_folder.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

std::string machine() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

struct Holder {
  pid_t process = 0;
  std::string on;

  bool is_gone() const {
    return on == machine() && process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
  }
};

/// No holder if there is no lock.
Holder read_holder(const fs::path& file) {
  Holder holder;
  std::ifstream in(file);
  in >> holder.process;
  in.ignore();  // the space
  std::getline(in, holder.on);
  return holder;
}

}  // namespace

FarmLock::FarmLock(const FarmFolder& folder) : file_(folder.file("lock")) {
  // A lock has its text at once: it is written under another name, then linked.
  const fs::path made =
      folder.file(("lock." + machine() + "." + std::to_string(::getpid())).c_str());
  {
    std::ofstream out(made);
    out << ::getpid() << " " << machine() << "\n";
    if (!out.flush()) throw Error(made.string() + ": cannot be written", Fault::kRetry);
  }
  int failed = 0;
  for (int tries = 0; tries < 2; ++tries) {
    failed = ::link(made.c_str(), file_.c_str()) == 0 ? 0 : errno;
    if (failed != EEXIST || !read_holder(file_).is_gone()) break;
    ::unlink(file_.c_str());
  }
  ::unlink(made.c_str());
  if (failed == 0) return;
  const std::string by = holder(folder);
  if (failed == EEXIST && !by.empty()) {
    throw Error(folder.path().string() + ": this farm is being submitted, or run, by " + by +
                    "; if that process no longer exists, remove " + file_.string(),
                Fault::kRetry);
  }
  throw Error(file_.string() + ": cannot be made (" + std::strerror(failed) + ")", Fault::kRetry);
}

FarmLock::~FarmLock() { ::unlink(file_.c_str()); }

std::string FarmLock::holder(const FarmFolder& folder) {
  const Holder holder = read_holder(folder.file("lock"));
  if (holder.on.empty() || holder.is_gone()) return "";
  return "process " + std::to_string(holder.process) + " on " + holder.on;
}

}  // namespace limpid
