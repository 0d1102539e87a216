#include "limpid/gpu/shader_languages.h"

#include <cstring>

#include "limpid/core/error.h"

#include "files/module_file.h"
#include "gpu/shaders_abi.h"

namespace limpid {
namespace {

using Stage = ShaderOptions::Stage;
using Translate = decltype(limpid_shaders_translate);

constexpr std::string_view kNames[] = {"glsl", "glsl-es", "hlsl", "msl", "spirv"};

Translate* load() {
  const auto path = module_file("limpid_shaders.so", "shaders in other languages than GLSL need");
  void* library = open_module(path, "shader", kShadersAbi);
  return reinterpret_cast<Translate*>(module_function(library, path, "limpid_shaders_translate"));
}

std::string translated(const std::string& glsl, Stage stage, ShadersLanguage language) {
  static Translate* const translate = load();
  std::string made;
  const auto put = [](void* to, const char* bytes, std::size_t size) {
    static_cast<std::string*>(to)->assign(bytes, size);
  };
  const bool compute = stage == Stage::kCompute;
  if (translate(glsl.data(), glsl.size(), compute, language, put, &made) != 0) throw Error(made);
  return made;
}

/// Adds an entry point, for languages that need one.
std::string with_entry_point(const ShaderText& shader) {
  if (shader.options().stage != Stage::kFunction) return shader.text();
  return shader.text() + "\nlayout(location = 0) out vec4 limpid_out_color;\nvoid main() {\n" +
         "  limpid_out_color = " + shader.options().function + "(ivec2(0)).color;\n}\n";
}

}  // namespace

ShaderLanguage shader_language_named(std::string_view name) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    if (kNames[i] == name) return static_cast<ShaderLanguage>(i);
    known.emplace_back(kNames[i]);
  }
  throw Error("'" + std::string(name) + "' is not a shader language: expected one of " +
              join(known) + did_you_mean(name, known));
}

std::vector<std::uint32_t> spirv_of(const std::string& glsl, Stage stage) {
  const std::string bytes = translated(glsl, stage, kShadersSpirv);
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), 4 * words.size());
  return words;
}

std::string in_language(const ShaderText& shader, ShaderLanguage language) {
  const auto made = [&](ShadersLanguage to) {
    return translated(with_entry_point(shader), shader.options().stage, to);
  };
  switch (language) {
    case ShaderLanguage::kGlsl:
      break;
    case ShaderLanguage::kGlslEs:
      return made(kShadersGlslEs);
    case ShaderLanguage::kHlsl:
      return made(kShadersHlsl);
    case ShaderLanguage::kMsl:
      return made(kShadersMsl);
    case ShaderLanguage::kSpirv:
      return made(kShadersSpirv);
  }
  return shader.text();
}

}  // namespace limpid
