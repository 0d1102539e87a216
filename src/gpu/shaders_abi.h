#pragma once
#include <cstddef>

/// @file
/// The contract between the library and limpid_shaders, the module that it loads at need to compile
/// shaders. Plain C, so that neither side's standard library crosses.

extern "C" {

/// Raised whenever anything here changes.
constexpr unsigned kShadersAbi = 1;

/// Where the module puts bytes: what it made, or a sentence of what is wrong.
using ShadersPut = void(void* to, const char* bytes, std::size_t size);

/// What cross-compiling makes of SPIR-V.
enum ShadersLanguage { kShadersSpirv, kShadersGlslEs, kShadersHlsl, kShadersMsl };

[[gnu::visibility("default")]] unsigned limpid_shaders_abi();
/// A GLSL 4.50 text of `size` bytes for Vulkan 1.0 to a language; SPIR-V as the bytes of its words.
/// `compute` is 0 for a fragment shader. 0, with the result put; or else 1, with a sentence.
[[gnu::visibility("default")]] int limpid_shaders_translate(const char* glsl, std::size_t size,
                                                            int compute, ShadersLanguage language,
                                                            ShadersPut* put, void* to);
}
