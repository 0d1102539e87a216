#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/ops/look.h"

namespace limpid {

/// A look file (TOML): table `water` and one table an operator, its keys being the operator's
/// parameters (ops/look.h). What it leaves out is as in the look that its `base` names, as
/// look_named() has it, but that a relative path is relative to the look file; without a base it
/// keeps its default. `about` is Look::about. A relative `wave_normals.map` is relative to the look
/// file and comes back absolute. The look is named after the file. Throws Error, with
/// "file:line:column: " in front, for what is not TOML, an unknown table or key (with the nearest
/// known name), a value that its declaration refuses, NaN included, and a base that is not there or
/// leads back to the file.
Look load_look(const std::filesystem::path& path,
               std::span<const std::filesystem::path> folders = {});

/// The same from a text; `name` stands for the file in errors, and the look has it. A relative
/// `wave_normals.map` stays as it is. Throws Error for a `base`, too.
Look look_from_toml(const std::string& text, const std::string& name);

/// The look NAME.toml in the first of `folders` that has one; a name that ends in ".toml" or has a
/// folder in it is a path and loaded as such. Folders that do not exist are passed over. Throws
/// Error that lists the looks there are when none has this name.
Look look_named(std::string_view name, std::span<const std::filesystem::path> folders);

/// The names of the looks in all of the folders, each once, in alphabetical order.
std::vector<std::string> look_names(std::span<const std::filesystem::path> folders);

/// Applies one setting as written on a command line: `refraction.strength=0.03`,
/// `depth_fog.color=[0.02, 0.1, 0.12]` (brackets may be left out), `refraction.rejection=snap`,
/// `wave_normals.map=waves.png` (relative to the working folder). Throws Error of Fault::kUsage;
/// `look` is unchanged then.
void apply_setting(Look& look, std::string_view setting);

}  // namespace limpid
