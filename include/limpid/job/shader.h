#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/gpu/shader_languages.h"
#include "limpid/shade/shader_text.h"

namespace limpid {

/// What a host must know beside the text, as JSON: id, function, the uniform block as 32-bit words
/// and with the name, offset, value and range of each number, textures with what they show and
/// where they are bound, outputs. Values of textures are in ShaderText::textures().
std::string to_json(const ShaderText& shader);

/// Writes the shader in a language to `path`, and beside it PATH.json and each texture that was
/// made as PATH.NAME.exr, in float; with the frame that the shader was made for, all others, too.
/// All of them or none. Returns their paths. Throws Error as in_language() and write_exr() do.
std::vector<std::filesystem::path> write_shader(const std::filesystem::path& path,
                                                const ShaderText& shader, ShaderLanguage language,
                                                const Frame* frame = nullptr);

}  // namespace limpid
