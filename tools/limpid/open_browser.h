#pragma once
#include <string>

namespace limpid::tool {

/// Has the user's browser show the address, by xdg-open, and goes on at once. Whether that could be
/// started: a system without a desktop has none.
bool open_browser(const std::string& address);

}  // namespace limpid::tool
