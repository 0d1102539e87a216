#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/shade/shader_text.h"

namespace limpid {

/// The languages of a shader.
enum class ShaderLanguage {
  kGlsl,    ///< 4.50 for Vulkan, the text of ShaderText
  kGlslEs,  ///< 3.00 for fragments (WebGL 2), 3.10 for compute
  kHlsl,    ///< shader model 5.0
  kMsl,     ///< 2.0
  kSpirv,   ///< 1.0, for Vulkan 1.0: words in this machine's byte order
};
/// The language with the name "glsl", "glsl-es", "hlsl", "msl" or "spirv". Throws Error with the
/// nearest name for another word.
ShaderLanguage shader_language_named(std::string_view name);

/// Compiles a GLSL 4.50 text with a main() to SPIR-V. Names are kept. Throws Error with the
/// compiler's first message for an invalid text, and if the module limpid_shaders, which has the
/// compilers and is loaded at the first call, is missing.
std::vector<std::uint32_t> spirv_of(const std::string& glsl, ShaderOptions::Stage stage);

/// A shader in a language; SPIR-V as the bytes of its words. Languages other than GLSL require an
/// entry point, so for Stage::kFunction the text has one that calls the function for pixel (0, 0).
/// Throws Error as spirv_of() does; GLSL needs no module.
std::string in_language(const ShaderText& shader, ShaderLanguage language);

}  // namespace limpid
