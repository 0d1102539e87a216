#pragma once
#include <cstddef>

/// @file
/// The contract between the library and limpid_shaders, the module that it loads on demand to
/// compile shaders. Plain C, so that neither side needs the other's standard library.

extern "C" {

/// Raised whenever anything here changes.
constexpr unsigned kShadersAbi = 1;

/// Receives bytes from the module: the result, or a sentence about the error.
using ShadersPut = void(void* to, const char* bytes, std::size_t size);

/// The target languages of cross-compilation from SPIR-V.
enum ShadersLanguage { kShadersSpirv, kShadersGlslEs, kShadersHlsl, kShadersMsl };

[[gnu::visibility("default")]] unsigned limpid_shaders_abi();
/// Translates a GLSL 4.50 text of `size` bytes for Vulkan 1.0; SPIR-V comes as the bytes of its
/// words. `compute` is 0 for a fragment shader. Returns 0, with the result put; or 1, with a
/// sentence.
[[gnu::visibility("default")]] int limpid_shaders_translate(const char* glsl, std::size_t size,
                                                            int compute, ShadersLanguage language,
                                                            ShadersPut* put, void* to);
}
