#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace limpid {

struct PageFile {
  std::string type;  ///< MIME type
  std::string text;
};

/// A file of the folder page, or the style that all pages share, by its name without folders; none
/// for an unknown file. "" is the page itself, desk.html.
std::optional<PageFile> page_file(std::string_view name);

}  // namespace limpid
