#pragma once
#include <string>

namespace CLI {
class App;
}

namespace limpid::tool {

/// A script that completes the tool's verbs and options in a shell, for it to read at its start:
/// `limpid completion bash`. Made from the tool's own options, so that it knows what they know.
/// Throws Error for another shell than bash, zsh and fish.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace limpid::tool
