#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/shade/shader_text.h"

namespace limpid {

/// What a shader can be written in.
enum class ShaderLanguage {
  kGlsl,    ///< 4.50 for Vulkan, as ShaderText has it
  kGlslEs,  ///< 3.00 for fragments (WebGL 2), 3.10 for compute
  kHlsl,    ///< shader model 5.0
  kMsl,     ///< 2.0
  kSpirv,   ///< 1.0, for Vulkan 1.0: words in the order of this machine
};
/// "glsl", "glsl-es", "hlsl", "msl", "spirv". Throws Error with the nearest name.
ShaderLanguage shader_language_named(std::string_view name);

/// SPIR-V of a GLSL 4.50 text with a main(). Names are kept. Throws Error with the compiler's first
/// words for a text that is wrong, and where the module limpid_shaders is not to be found, which
/// knows the compilers and is loaded when it is first asked for.
std::vector<std::uint32_t> spirv_of(const std::string& glsl, ShaderOptions::Stage stage);

/// A shader in a language; SPIR-V as the bytes of its words. Languages but GLSL have an entry point
/// always, which for Stage::kFunction calls the function for pixel (0, 0): none knows a shader
/// without. Throws Error as spirv_of() does; GLSL needs no module.
std::string in_language(const ShaderText& shader, ShaderLanguage language);

}  // namespace limpid
