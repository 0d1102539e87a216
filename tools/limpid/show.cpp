#include "show.h"

#include <cstdio>
#include <cstdlib>

#include <unistd.h>

#include "limpid/core/error.h"

namespace limpid::tool {
namespace {

constexpr const char* kNamed = "--show=kitty, --show=iterm or --show=sixel";

}  // namespace

std::optional<TerminalPictures> chosen_protocol(const WaterOptions& options) {
  if (options.show.empty()) return {};
  if (options.show != "auto") return terminal_pictures_named(options.show);
  if (::isatty(STDOUT_FILENO) == 0) {
    throw Error(std::string("--show: standard output is not a terminal: expected a terminal, or ") +
                    kNamed + " to write the picture anyway",
                Fault::kUsage);
  }
  const auto protocol = terminal_pictures([](const char* name) { return std::getenv(name); });
  if (protocol) return protocol;
  const char* const term = std::getenv("TERM");
  throw Error("--show: the terminal (TERM=" + std::string(term ? term : "") +
                  ") is not known to show pictures: expected kitty, iTerm2, one with sixels, or " +
                  kNamed,
              Fault::kUsage);
}

void show(const PreviewPixels& picture, TerminalPictures protocol) {
  const std::string text = terminal_text(picture.size, picture.rgb, protocol);
  std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace limpid::tool
