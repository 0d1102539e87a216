#pragma once
#include <string>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/plate/layers.h"

namespace limpid::test {

using Names = std::vector<std::string>;

inline LayerSource source(int file, const std::string& file_name, const Names& channels,
                          const std::string& part_name = "", int part = 0,
                          const std::string& view = "") {
  return {file, part, file_name, part_name, view, channels};
}

/// Lines such as "depth: ViewLayer.Depth.Z"; file and part stand before the name unless 0.
inline std::string text_of(const LayerChoices& choices) {
  std::string text;
  for (const Role& role : roles()) {
    if (!choices.contains(role.name)) continue;
    Names names;
    for (const ChannelRef& ref : choices.at(role.name).channels) {
      const std::string file = ref.file ? std::to_string(ref.file) + ":" : "";
      const std::string part = ref.part ? "#" + std::to_string(ref.part) + ":" : "";
      names.push_back(file + part + ref.name);
    }
    text += std::string(role.name) + ": " + join(names, " ") + "\n";
  }
  return text;
}

/// The answer of choose_layer(), or the sentence of its Error.
inline std::string chosen(const std::string& role, const std::string& text,
                          const std::vector<LayerSource>& sources) {
  try {
    LayerChoices choices;
    const Role& r = role_named(role);
    choices[r.name] = choose_layer(r, text, sources);
    return text_of(choices);
  } catch (const Error& error) {
    return error.what();
  }
}

inline const Names kBlenderMultilayer = {
    "ViewLayer.Combined.A",       "ViewLayer.Combined.B",       "ViewLayer.Combined.G",
    "ViewLayer.Combined.R",       "ViewLayer.CryptoObject00.a", "ViewLayer.CryptoObject00.b",
    "ViewLayer.CryptoObject00.g", "ViewLayer.CryptoObject00.r", "ViewLayer.CryptoObject01.a",
    "ViewLayer.CryptoObject01.b", "ViewLayer.CryptoObject01.g", "ViewLayer.CryptoObject01.r",
    "ViewLayer.CryptoObject02.a", "ViewLayer.CryptoObject02.b", "ViewLayer.CryptoObject02.g",
    "ViewLayer.CryptoObject02.r", "ViewLayer.Depth.Z",          "ViewLayer.DiffCol.B",
    "ViewLayer.DiffCol.G",        "ViewLayer.DiffCol.R",        "ViewLayer.IndexOB.X",
    "ViewLayer.Mist.Z",           "ViewLayer.Normal.X",         "ViewLayer.Normal.Y",
    "ViewLayer.Normal.Z",         "ViewLayer.Position.X",       "ViewLayer.Position.Y",
    "ViewLayer.Position.Z",       "ViewLayer.Shadow Catcher.B", "ViewLayer.Shadow Catcher.G",
    "ViewLayer.Shadow Catcher.R", "ViewLayer.Shadow.B",         "ViewLayer.Shadow.G",
    "ViewLayer.Shadow.R"};
inline const Names kRgba = {"A", "B", "G", "R"};
inline const Names kRgb = {"B", "G", "R"};

}  // namespace limpid::test
