#pragma once
#include <string>

#include "tool/tool.h"

namespace limpid::test {

/// A command that runs `script` with the arguments `words` in a shell with its own mount namespace:
/// as root, or in a user namespace. Empty if the system allows neither.
inline Words with_own_mounts(const std::string& script, const Words& words) {
  for (const char* kind : {"-m", "-Urm"}) {
    Words command{"/usr/bin/unshare", kind, "/bin/sh", "-c", "mount -t tmpfs limpid /tmp"};
    if (run("/", command).code != 0) continue;
    command.back() = script;
    command.push_back("sh");
    command.insert(command.end(), words.begin(), words.end());
    return command;
  }
  return {};
}

}  // namespace limpid::test
