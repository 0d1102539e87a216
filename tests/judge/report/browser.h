#pragma once
#include <string>

#include <nlohmann/json.hpp>

namespace limpid::test {

/// What a browser answers to an expression of JavaScript once the page has been loaded and its
/// scripts ran. A failure, and null, where the page complains or there is no browser.
nlohmann::json asked(std::string page, const std::string& expression);

}  // namespace limpid::test
