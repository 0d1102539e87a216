#pragma once
#include "arguments.h"

namespace CLI {
class App;
}

namespace limpid::tool {

/// The verbs of the tool with their options, which fill the arguments.
void declare_verbs(CLI::App& app, Arguments& arguments);

}  // namespace limpid::tool
