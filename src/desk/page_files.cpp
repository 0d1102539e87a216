#include "desk/page_files.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace limpid {
namespace {

struct BuiltIn {
  std::string_view name, text;
};

#include "desk/page_files.inc"  // kPageFiles, made by the build of the folders page

std::optional<std::string> built_in(std::string_view name) {
  for (const BuiltIn& file : kPageFiles) {
    if (file.name == name) return std::string(file.text);
  }
  return std::nullopt;
}

/// For development of the page: with the environment variable LIMPID_DESK_PAGE its files are read
/// from that folder each time, so that a browser's reload shows changes.
std::optional<std::string> being_worked_on(std::string_view name) {
  const char* const folder = std::getenv("LIMPID_DESK_PAGE");
  if (!folder || name.find('/') != std::string_view::npos) return std::nullopt;
  std::ifstream file(std::filesystem::path(folder) / name, std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string type_of(std::string_view name) {
  const std::string_view ending = name.substr(std::min(name.rfind('.'), name.size()));
  const std::string_view kind = ending == ".html"  ? "text/html"
                                : ending == ".css" ? "text/css"
                                : ending == ".svg" ? "image/svg+xml"
                                                   : "text/javascript";
  return std::string(kind) + "; charset=utf-8";
}

}  // namespace

std::optional<PageFile> page_file(std::string_view name) {
  if (name.empty()) name = "desk.html";
  std::optional<std::string> text = being_worked_on(name);
  if (!text) text = built_in(name);
  if (!text) return std::nullopt;
  return PageFile{type_of(name), *std::move(text)};
}

}  // namespace limpid
