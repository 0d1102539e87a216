#pragma once
#include <string>

namespace limpid::tool {

/// Opens the address in the user's browser, by xdg-open, without waiting. Returns whether xdg-open
/// could be started: a system without a desktop has none.
bool open_browser(const std::string& address);

}  // namespace limpid::tool
