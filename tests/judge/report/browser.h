#pragma once
#include <string>

#include <nlohmann/json.hpp>

namespace limpid::test {

/// The value of a JavaScript expression in a browser after the page and its scripts were loaded. If
/// the page reports an error or there is no browser, the test fails and the value is null.
nlohmann::json asked(std::string page, const std::string& expression);

}  // namespace limpid::test
