#include "limpid/core/color_space.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include <glm/vec3.hpp>

#include "limpid/core/error.h"

#include "core/toml_text.h"

namespace limpid {
namespace {

constexpr Chromaticity kD65{.3127, .3290}, kD60{.32168, .33767};

struct Space {
  std::array<std::string_view, 9> names;  ///< limpid's name first; letters and digits of the others
  Primaries primaries;
};

// ITU-R BT.709 and BT.2020, SMPTE EG 432-1 and RP 431-2, Academy S-2014-004 and TB-2014-004, Adobe
// RGB (1998). Other names: from OpenColorIO's ACES configs, Blender, and the Color Interop Forum.
constexpr Space kSpaces[] = {
    {{"Rec.709", "linrec709", "linrec709scene", "linearrec709", "linearrec709srgb", "linsrgb",
      "linearsrgb", "utilitylinearsrgb", "linear"},
     kRec709},
    {{"Rec.2020", "linrec2020", "linrec2020scene", "linearrec2020", "utilitylinearrec2020"},
     {{.708, .292}, {.170, .797}, {.131, .046}, kD65}},
    {{"ACEScg", "acesacescg", "linap1", "linap1scene", "ap1", "linearap1", "acescgap1",
      "linearacescg"},
     {{.713, .293}, {.165, .830}, {.128, .044}, kD60}},
    {{"ACES2065-1", "acesaces20651", "linap0", "linap0scene", "ap0", "aces20651ap0", "linearaces"},
     {{.7347, .2653}, {0, 1}, {.0001, -.077}, kD60}},
    {{"P3-D65", "linp3d65", "linp3d65scene", "linearp3d65", "utilitylinearp3d65"},
     {{.680, .320}, {.265, .690}, {.150, .060}, kD65}},
    {{"DCI-P3", "lindcip3"}, {{.680, .320}, {.265, .690}, {.150, .060}, {.314, .351}}},
    {{"Adobe RGB", "linadobergb", "linadobergbscene", "linearadobergb", "utilitylinearadobergb"},
     {{.64, .33}, {.21, .71}, {.15, .06}, kD65}},
};

constexpr std::size_t kNumbers = 8;
std::array<double, kNumbers> numbers_of(const Primaries& p) {
  return {p.red.x, p.red.y, p.green.x, p.green.y, p.blue.x, p.blue.y, p.white.x, p.white.y};
}

/// Letters and digits, in lower case.
std::string plain(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte)) letters += static_cast<char>(std::tolower(byte));
  }
  return letters;
}

const Space* space_called(std::string_view name) {
  const std::string letters = plain(name);
  if (letters.empty()) return nullptr;
  for (const Space& space : kSpaces) {
    for (const std::string_view known : space.names) {
      if (plain(known) == letters) return &space;
    }
  }
  return nullptr;
}

/// Eight numbers with spaces between them, or nothing.
std::optional<Primaries> numbers_in(std::string_view text) {
  std::array<double, kNumbers> n{};
  const char *at = text.data(), *const end = text.data() + text.size();
  for (double& number : n) {
    while (at != end && *at == ' ') ++at;
    const auto [rest, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (rest != end && *rest != ' ')) return std::nullopt;
    at = rest;
  }
  if (std::any_of(at, end, [](char c) { return c != ' '; })) return std::nullopt;
  return Primaries{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
}

/// With Y = 1.
glm::dvec3 xyz_of(const Chromaticity& c) { return {c.x / c.y, 1, (1 - c.x - c.y) / c.y}; }

/// x, y and z of red, green and blue, a column each.
glm::dmat3 places_of(const Primaries& p) {
  const auto place = [](const Chromaticity& c) { return glm::dvec3(c.x, c.y, 1 - c.x - c.y); };
  return {place(p.red), place(p.green), place(p.blue)};
}

/// The amounts of red, green and blue in white.
glm::dvec3 shares_of(const Primaries& p) { return glm::inverse(places_of(p)) * xyz_of(p.white); }

glm::dmat3 scaled(const glm::dvec3& by) { return {{by.x, 0, 0}, {0, by.y, 0}, {0, 0, by.z}}; }

// By rows, as published; GLM has columns.
const glm::dmat3 kBradford = glm::transpose(
    glm::dmat3{{.8951, .2664, -.1614}, {-.7502, 1.7135, .0367}, {.0389, -.0685, 1.0296}});

}  // namespace

void Primaries::validate() const {
  const auto n = numbers_of(*this);
  const bool finite = std::all_of(n.begin(), n.end(), [](double v) { return std::abs(v) <= 10; });
  const bool wide = finite && std::abs(glm::determinant(places_of(*this))) > 1e-6;
  if (wide && std::abs(white.y) > 1e-6) {
    const glm::dvec3 shares = shares_of(*this);
    if (shares.x > 0 && shares.y > 0 && shares.z > 0) return;
  }
  throw Error("chromaticities " + to_string(*this) +
              ": expected x and y of red, green, blue and a white between them");
}

std::vector<std::string> color_space_names() {
  std::vector<std::string> names;
  for (const Space& space : kSpaces) names.emplace_back(space.names.front());
  return names;
}

std::optional<Primaries> find_color_space(std::string_view name) {
  const Space* space = space_called(name);
  return space ? std::optional(space->primaries) : std::nullopt;
}

Primaries color_space_named(std::string_view text) {
  if (const auto found = find_color_space(text)) return *found;
  if (const auto given = numbers_in(text)) {
    given->validate();
    return *given;
  }
  const std::vector<std::string> names = color_space_names();
  throw Error("color space '" + std::string(text) + "': expected one of " + join(names) +
              ", or eight numbers, x and y of red, green, blue and white" +
              did_you_mean(text, names));
}

std::string to_string(const Primaries& primaries) {
  for (const Space& space : kSpaces) {
    if (agree(primaries, space.primaries)) return std::string(space.names.front());
  }
  std::string text;
  for (const double number : numbers_of(primaries)) {
    text += (text.empty() ? "" : " ") + toml_text(number);
  }
  return text;
}

bool agree(const Primaries& a, const Primaries& b) {
  const auto m = numbers_of(a), n = numbers_of(b);
  return std::equal(m.begin(), m.end(), n.begin(),
                    [](double x, double y) { return std::abs(x - y) <= 0.001; });
}

glm::dmat3 xyz_from(const Primaries& primaries) {
  return places_of(primaries) * scaled(shares_of(primaries));
}

glm::dmat3 rgb_from_rgb(const Primaries& to, const Primaries& from) {
  glm::dmat3 adapted(1.0);
  if (to.white != from.white) {
    const glm::dvec3 by = (kBradford * xyz_of(to.white)) / (kBradford * xyz_of(from.white));
    adapted = glm::inverse(kBradford) * scaled(by) * kBradford;
  }
  return glm::inverse(xyz_from(to)) * adapted * xyz_from(from);
}

}  // namespace limpid
