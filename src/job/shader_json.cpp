#include <cstring>

#include <nlohmann/json.hpp>

#include "limpid/job/shader.h"

namespace limpid {
namespace {

using Json = nlohmann::ordered_json;

Json rect_json(const Rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

Json number_json(const ShaderNumber& number) {
  Json json{{"name", number.name}, {"offset", number.offset}, {"value", number.value}};
  if (number.range) json["range"] = {number.range->min, number.range->max};
  return json;
}

Json texture_json(const ShaderTexture& texture) {
  using Source = ShaderTexture::Source;
  const char* source = texture.source == Source::kPlanes ? "planes"
                       : texture.source == Source::kRows ? "rows"
                                                         : "made";
  Json json{{"name", texture.name},
            {"binding", texture.binding},
            {"source", source},
            {"channels", texture.channels},
            {"size", {texture.width, texture.height}}};
  if (!texture.role.empty()) json["role"] = texture.role;
  return json;
}

}  // namespace

std::string to_json(const ShaderText& shader) {
  const ShaderOptions& options = shader.options();
  Json json{{"id", shader.id()}, {"function", options.function}, {"set", options.set}};
  Json block{{"name", "LimpidNumbers"},
             {"binding", shader.block_binding()},
             {"bytes", shader.block().size()},
             {"words", Json::array()},
             {"numbers", Json::array()}};
  for (std::size_t at = 0; at < shader.block().size(); at += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, shader.block().data() + at, sizeof word);
    block["words"].push_back(word);
  }
  for (const ShaderNumber& number : shader.numbers())
    block["numbers"].push_back(number_json(number));
  json["work"] = rect_json(shader.work());
  json["block"] = std::move(block);
  json["textures"] = Json::array();
  for (const ShaderTexture& texture : shader.textures()) {
    json["textures"].push_back(texture_json(texture));
  }
  json["outputs"] = Json::array();
  const char* place = options.stage == ShaderOptions::Stage::kCompute ? "binding" : "location";
  for (const ShaderOutput& output : shader.outputs()) {
    Json one{{"name", output.name}, {"channels", output.channels}};
    if (options.stage != ShaderOptions::Stage::kFunction) one[place] = output.binding;
    json["outputs"].push_back(std::move(one));
  }
  return json.dump(1) + "\n";
}

}  // namespace limpid
