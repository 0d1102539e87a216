#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace limpid {

struct PageFile {
  std::string type;  ///< of its content, as HTTP names it
  std::string text;
};

/// A file of the folder page, or the style that all pages share, by its name without folders; none
/// where there is no such file. "" is the page itself, desk.html.
std::optional<PageFile> page_file(std::string_view name);

}  // namespace limpid
