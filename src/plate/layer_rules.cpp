#include "plate/layer_rules.h"

#include <iterator>
#include <vector>

#include "limpid/core/frame.h"

namespace limpid {
namespace {

using enum LayerRank;

constexpr std::string_view kRgba = "R G B A|R G B";
constexpr std::string_view kPicture = "R G B A|R G B|Y";
constexpr std::string_view kMirror = "R G B|Y";
constexpr std::string_view kLength = "Z|V|Y|*";
constexpr std::string_view kGrayLength = "Z|V|Y|R|*";  // also R = G = B
constexpr std::string_view kMask = "Y|V|R|*";          // a gray picture feeds the single plane
constexpr std::string_view kVector = "X Y Z|NX NY NZ|R G B";
constexpr std::string_view kAny = "R|X|Y|Z|V|*";

// Of the file-name rules, the first that fits decides the kind of the file.
// clang-format off
constexpr LayerRule kRules[] = {
    {kLayer, "color",          "combined",                    kPicture,   "Blender"},
    {kLayer, "color",          "color|colour",                kPicture,   "Blender's File Output"},
    {kLayer, "color",          "rgba|rgb|beauty",             kPicture,   "Nuke, Arnold, oiiotool"},
    {kLayer, "color",          "c",                           kPicture,   "Karma"},
    {kLayer, "color",          "main|master",                 kPicture,   "a main part or layer"},
    {kLayer, "color",          "final image",                 kPicture,   "Unreal"},
    {kLayer, "depth",          "depth",                       kLength,    "Blender, Nuke, Natron"},
    {kLayer, "depth",          "z",                           "Z|V|Y",    "Arnold"},
    {kLayer, "depth",          "final image movie render queue world depth", kGrayLength, "Unreal"},
    {kLayer, "depth",          "combined|color|colour|rgba|rgb|beauty|c|main|master", "Z", "beside the color"},
    {kLayer, "shadow",         "shadow",                      kMask,      "Blender"},
    {kLayer, "shadow",         "shadow matte|shadow mask",    kMask,      "Arnold, Karma"},
    {kLayer, "reflection",     "reflection|water reflection", kMirror,    "Blender's File Output"},
    {kLayer, "surface_depth",  "water depth|water z",         kLength,    "a layer of the water"},
    {kLayer, "surface_depth",  "water",                       "Z",        "a layer of the water"},
    {kLayer, "surface_normal", "water normal|water normals|water n", kVector, "a layer of the water"},
    {kLayer, "surface_normal", "water",                       "NX NY NZ", "a layer of the water"},
    {kLayer, "reflection_valid", "reflection valid|water reflection valid", kMask,   "a layer of the water"},
    {kLayer, "reflection_depth", "reflection depth|water reflection depth", kLength, "a layer of the water"},
    {kLayer, "below_color",      "below color|below colour",  kMirror,    "a layer of the water"},
    {kLayer, "below_depth",      "below depth",               kLength,    "a layer of the water"},
    {kLayer, "surface_shadow",   "water shadow",              kMask,      "a layer of the water"},
    {kLayer, "sun_color",        "sun color|sun colour",      kMirror,    "a layer of the sun's light"},
    {kLayer, "sun_color",        "combined sun",              kMirror,    "Blender's light group"},
    {kLayer, "sun_color",        "diffuse direct sun",        kMirror,    "Arnold's light group"},
    {kLayer, "sun_color",        "directdiffuse sun",         kMirror,    "Karma's light tag"},

    {kFileName, "",               "reflection shadow|water reflection shadow|reflection normal|"
                                  "water reflection normal",   kAny,        "not of the dry scene"},
    {kFileName, "reflection_valid", "reflection valid|water reflection valid", kMask,       "file name"},
    {kFileName, "reflection_depth", "reflection depth|water reflection depth", kGrayLength, "file name"},
    {kFileName, "below_color",      "below color|below colour", kMirror,     "file name"},
    {kFileName, "below_depth",      "below depth",              kGrayLength, "file name"},
    {kFileName, "surface_shadow",   "water shadow",             kMask,       "file name"},
    {kFileName, "sun_color",        "sun color|sun colour",     kMirror,     "file name"},
    {kFileName, "",               "reflection|water reflection", "Z|X Y Z", "not of the dry scene"},
    {kFileName, "",               "normal|normals|position|mist|albedo|motion|vector|crypto|cryptomatte",
                                                               kAny,        "a layer that limpid does not use"},
    {kFileName, "surface_depth",  "water depth",               kGrayLength, "file name"},
    {kFileName, "surface_normal", "water normal|water normals", kVector,    "file name"},
    {kFileName, "surface_depth",  "water",                     "Z",         "file name"},
    {kFileName, "depth",          "depth|zdepth",              kGrayLength, "file name"},
    {kFileName, "shadow",         "shadow|shadows",            kMask,       "file name"},
    {kFileName, "reflection",     "reflection|water reflection", kMirror,   "file name"},
    {kFileName, "color",          "color|colour|beauty|rgba|combined", kPicture, "file name"},

    {kBare, "color", "", kRgba, "Blender, Nuke, Arnold, Karma, V-Ray, Unreal"},
    {kBare, "depth", "", "Z",   "Blender, Arnold, Karma, V-Ray"},

    {kPart, "color", "", kRgba, "the only one with R G B"},
    {kPart, "depth", "", "Z",   "beside the color"},

    {kGiven, "reflection",     "combined|color|colour|rgba|rgb|beauty|c", kMirror,     "a mirrored picture"},
    {kGiven, "surface_depth",  "depth|z",                                 kGrayLength, "the water alone"},
    {kGiven, "surface_normal", "normal|normals|n",                        kVector,     "the water alone"},
    {kGiven, "reflection_depth", "depth|z",                               kGrayLength, "a mirrored picture"},
    {kGiven, "below_color",    "combined|color|colour|rgba|rgb|beauty|c", kMirror,     "the layer below alone"},
    {kGiven, "below_depth",    "depth|z",                                 kGrayLength, "the layer below alone"},
    {kGiven, "surface_shadow", "shadow|shadow matte|shadow mask",         kMask,       "the water alone"},
    {kGiven, "sun_color",      "combined|color|colour|rgba|rgb|beauty|c", kMirror,     "the sun's light alone"},
    {kGiven, "color",          "", "R G B A|R G B|Y|*", "any"},
    {kGiven, "depth",          "", kGrayLength,         "any"},
    {kGiven, "shadow",         "", "Y|V|R|Z|*",         "any"},
    {kGiven, "reflection",     "", "R G B|Y|*",         "any"},
    {kGiven, "surface_depth",  "", kGrayLength,         "any"},
    {kGiven, "surface_normal", "", kVector,             "any"},
    {kGiven, "reflection_valid", "", "Y|V|R|*",         "any"},
    {kGiven, "reflection_depth", "", kGrayLength,       "any"},
    {kGiven, "below_color",    "", "R G B|Y|*",         "any"},
    {kGiven, "below_depth",    "", kGrayLength,         "any"},
    {kGiven, "surface_shadow", "", "Y|V|R|Z|*",         "any"},
    {kGiven, "sun_color",      "", "R G B|Y|*",         "any"},
};
// clang-format on

/// The names of limpid's own plates, strongest of all, then other conventions.
std::vector<LayerRule> all_rules() {
  std::vector<LayerRule> all;
  for (const Role& role : roles()) {
    if (role.layer.empty()) continue;
    const bool shared = role.first == PlaneId::kDepth;
    all.push_back(
        {kOwn, role.name, role.layer, role.channels, shared ? "limpid, Nuke, Natron" : "limpid"});
  }
  all.insert(all.end(), std::begin(kRules), std::end(kRules));
  return all;
}

}  // namespace

std::span<const LayerRule> layer_rules() {
  static const std::vector<LayerRule> all = all_rules();
  return all;
}

}  // namespace limpid
