#include "show/terminal.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "limpid/core/error.h"

#include "files/picture/png.h"
#include "show/encoded.h"
#include "show/palette.h"

namespace limpid {
namespace {

constexpr std::string_view kNames[] = {"kitty", "iterm", "sixel"};
constexpr std::string_view kEscape = "\x1b";
constexpr std::string_view kEnd = "\x1b\\";

std::string png(Size size, std::span<const std::uint8_t> rgb) {
  return encode_png(size.width, size.height, 3, rgb.data(), {}, "a picture of the terminal");
}

/// In parts of at most 4096 letters, as the protocol requires; q=2 suppresses responses.
std::string kitty_text(Size size, std::span<const std::uint8_t> rgb) {
  constexpr std::size_t kPart = 4096;
  const std::string letters = base64(png(size, rgb));
  std::string text;
  for (std::size_t at = 0; at < letters.size(); at += kPart) {
    const bool more = at + kPart < letters.size();
    text += std::string(kEscape) + "_G" + (at == 0 ? "a=T,f=100,q=2," : "") +
            (more ? "m=1;" : "m=0;") + letters.substr(at, kPart) + std::string(kEnd);
  }
  return text;
}

std::string iterm_text(Size size, std::span<const std::uint8_t> rgb) {
  const std::string bytes = png(size, rgb);
  return std::string(kEscape) + "]1337;File=inline=1;size=" + std::to_string(bytes.size()) +
         ";width=auto;height=auto:" + base64(bytes) + "\a";
}

/// The letters of one color in a band of six rows, run-length encoded.
std::string run_lengths(const std::string& letters) {
  std::string text;
  for (std::size_t i = 0; i < letters.size();) {
    const std::size_t end = std::min(letters.find_first_not_of(letters[i], i), letters.size());
    const std::size_t count = end - i;
    text += count > 3 ? "!" + std::to_string(count) + letters[i] : letters.substr(i, count);
    i = end;
  }
  return text;
}

/// DEC VT330/VT340 Programmer Reference Manual, volume 2, chapter 14: bands of six rows, in each a
/// pass for every color in it.
std::string sixel_text(Size size, std::span<const std::uint8_t> rgb) {
  constexpr int kColors = 256, kBand = 6;
  constexpr char kNoPoint = '?';
  const Paletted picture = paletted(rgb, kColors);
  std::string text = std::string(kEscape) + "P0;1;0q\"1;1;" + std::to_string(size.width) + ";" +
                     std::to_string(size.height);
  for (std::size_t i = 0; i < picture.colors.size(); ++i) {
    text += "#" + std::to_string(i) + ";2";
    for (const int byte : picture.colors[i]) text += ";" + std::to_string((100 * byte + 127) / 255);
  }
  for (int y0 = 0; y0 < size.height; y0 += kBand) {
    std::vector<std::string> passes(picture.colors.size());
    for (int y = y0; y < std::min(y0 + kBand, size.height); ++y) {
      for (int x = 0; x < size.width; ++x) {
        std::string& pass = passes[picture.pixels[static_cast<std::size_t>(y) * size.width + x]];
        if (pass.empty()) pass.assign(static_cast<std::size_t>(size.width), kNoPoint);
        pass[static_cast<std::size_t>(x)] =
            static_cast<char>(pass[static_cast<std::size_t>(x)] + (1 << (y - y0)));
      }
    }
    bool is_first = true;
    for (std::size_t i = 0; i < passes.size(); ++i) {
      if (passes[i].empty()) continue;
      text += std::string(is_first ? "" : "$") + "#" + std::to_string(i) + run_lengths(passes[i]);
      is_first = false;
    }
    text += "-";
  }
  return text + std::string(kEnd);
}

}  // namespace

TerminalPictures terminal_pictures_named(std::string_view name) {
  const std::vector<std::string> known(std::begin(kNames), std::end(kNames));
  const auto at = std::find(known.begin(), known.end(), name);
  if (at != known.end()) return static_cast<TerminalPictures>(at - known.begin());
  throw Error("--show=" + std::string(name) + ": expected auto or one of " + join(known) +
                  did_you_mean(name, known),
              Fault::kUsage);
}

std::optional<TerminalPictures> terminal_pictures(
    const std::function<const char*(const char*)>& variable) {
  const auto said = [&](const char* name) -> std::string_view {
    const char* const value = variable(name);
    return value ? value : "";
  };
  const std::string_view term = said("TERM"), program = said("TERM_PROGRAM");
  const auto is_within = [&](std::string_view name) {
    return term == name || term.starts_with(std::string(name) + "-");
  };
  if (!said("TMUX").empty() || !said("STY").empty() || is_within("tmux") || is_within("screen")) {
    return {};
  }
  const bool kitty = !said("KITTY_WINDOW_ID").empty() || term == "xterm-kitty";
  if (kitty || program == "ghostty" || term == "xterm-ghostty") return TerminalPictures::kKitty;
  const bool iterm = program == "iTerm.app" || said("LC_TERMINAL") == "iTerm2";
  if (iterm || program == "WezTerm" || program == "mintty") return TerminalPictures::kIterm;
  constexpr int kKonsoleWithSixel = 220400;
  const bool konsole = std::atoi(std::string(said("KONSOLE_VERSION")).c_str()) >= kKonsoleWithSixel;
  const bool sixel = is_within("foot") || is_within("mlterm") || is_within("contour") ||
                     is_within("yaft") || term.find("sixel") != std::string_view::npos;
  if (konsole || sixel) return TerminalPictures::kSixel;
  return {};
}

std::string terminal_text(Size size, std::span<const std::uint8_t> rgb, TerminalPictures protocol) {
  const auto text = protocol == TerminalPictures::kKitty   ? kitty_text
                    : protocol == TerminalPictures::kIterm ? iterm_text
                                                           : sixel_text;
  return text(size, rgb) + "\n";
}

}  // namespace limpid
