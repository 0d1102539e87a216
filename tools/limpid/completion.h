#pragma once
#include <string>

namespace CLI {
class App;
}

namespace limpid::tool {

/// A script that completes the tool's verbs and options in a shell, to be read at its start:
/// `limpid completion bash`. Made from the tool's own options, so that both always agree. Throws
/// Error for a shell other than bash, zsh and fish.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace limpid::tool
