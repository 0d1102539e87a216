#include "limpid/run/aov_names.h"

#include <algorithm>
#include <iterator>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// Channel names of a compositing program. Suffixes are words, one per plane; an additional word
/// names a plane of 1.
struct Convention {
  std::string_view name;
  std::string_view picture;  ///< prefix of R G B A
  std::string_view layer;    ///< prefix of each AOV's name
  bool dots;                 ///< whether an AOV's name keeps its dots; else they become '_'
  std::string_view color;    ///< of RGB
  std::string_view vector;   ///< of XYZ
  std::string_view share;    ///< of Y; "" for none
  std::string_view length;   ///< of Z; "" for none
  std::string_view place;    ///< of UV
};

// Nuke replaces dots beyond the first by '_', and names colors by whole words and places u and v,
// as in its own forward.u. Blender splits at dots into view layer, pass and letter, and shows
// passes of 1, 3 and 4 letters: R G B A, X Y Z W, or U V A, whose A its Map UV treats as a matte.
// Arnold writes a FLOAT under its bare name, and vectors of two and three as X Y Z.
// clang-format off
constexpr Convention kConventions[] = {
    {"limpid",  "",                    "",           true,  "R G B",          "X Y Z", "Y",   "Z", "U V"},
    {"nuke",    "",                    "",           false, "red green blue", "X Y Z", "red", "Z", "u v"},
    {"blender", "ViewLayer.Combined.", "ViewLayer.", false, "R G B",          "X Y Z", "X",   "Z", "U V A"},
    {"arnold",  "",                    "",           false, "R G B",          "X Y Z", "",    "",  "X Y"},
};
// clang-format on

const Convention& convention_of(AovNames names) {
  return kConventions[static_cast<std::size_t>(names)];
}

std::string_view suffixes_of(std::string_view letters, const Convention& host) {
  if (letters == "RGB") return host.color;
  if (letters == "XYZ") return host.vector;
  if (letters == "UV") return host.place;
  return letters == "Z" ? host.length : host.share;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

}  // namespace

std::string_view aov_names_name(AovNames names) { return convention_of(names).name; }

AovNames aov_names_named(std::string_view name) {
  std::vector<std::string> known;
  for (const Convention& host : kConventions) {
    if (host.name == name) return static_cast<AovNames>(&host - std::begin(kConventions));
    known.emplace_back(host.name);
  }
  throw Error("'" + std::string(name) + "' has no names of AOVs: expected one of " + join(known) +
                  did_you_mean(name, known),
              Fault::kUsage);
}

std::string aov_layer(std::string_view layer, AovNames names) {
  const Convention& host = convention_of(names);
  std::string name(layer);
  if (!host.dots) std::replace(name.begin(), name.end(), '.', '_');
  return std::string(host.layer) + name;
}

std::vector<AovChannel> aov_channels(Aov aov, AovNames names) {
  const AovInfo& info = aovs()[static_cast<std::size_t>(aov)];
  const Convention& host = convention_of(names);
  const std::string layer = aov_layer(info.name, names);
  const int planes = static_cast<int>(info.suffixes.size());
  std::vector<AovChannel> channels;
  for (const std::string& suffix : words_of(suffixes_of(info.suffixes, host))) {
    const int plane = static_cast<int>(channels.size());
    channels.push_back(
        {suffix.empty() ? layer : layer + "." + suffix, plane < planes ? plane : -1});
  }
  return channels;
}

std::vector<std::string> picture_channels(AovNames names) {
  std::vector<std::string> channels;
  for (const char* letter : {"R", "G", "B", "A"}) {
    channels.push_back(std::string(convention_of(names).picture) + letter);
  }
  return channels;
}

}  // namespace limpid
