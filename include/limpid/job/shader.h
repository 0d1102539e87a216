#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/gpu/shader_languages.h"
#include "limpid/shade/shader_text.h"

namespace limpid {

/// The interface of a shader text as JSON, for hosts: id, function, the uniform block as 32-bit
/// words and with the name, offset, value and range of each number, the textures with their content
/// and bindings, the outputs. Values of textures are in ShaderText::textures().
std::string to_json(const ShaderText& shader);

/// Writes the shader in a language to `path`, and beside it PATH.json and each texture of
/// Source::kMade as PATH.NAME.exr, in float; with `frame`, the frame that the shader was made for,
/// all other textures, too. Writes all files or none, and returns their paths. Throws Error as
/// in_language() and write_exr() do.
std::vector<std::filesystem::path> write_shader(const std::filesystem::path& path,
                                                const ShaderText& shader, ShaderLanguage language,
                                                const Frame* frame = nullptr);

}  // namespace limpid
