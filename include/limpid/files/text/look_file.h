#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/ops/look.h"

namespace limpid {

/// Loads a look file (TOML): the table `water` and one table per operator, whose keys are the
/// operator's parameters (ops/look.h). Omitted parameters are those of the look `base`, which is
/// found as by look_named(), but with paths relative to the look file; without a base they have
/// their defaults. `about` is Look::about. A relative `wave_normals.map` is relative to the look
/// file and is returned as an absolute path. The look has the name of the file. Throws Error, with
/// "file:line:column: " in front, for invalid TOML, an unknown table or key (with the nearest known
/// name), a value that its declaration refuses (also NaN), and a base that is missing or has the
/// file itself as a base.
Look load_look(const std::filesystem::path& path,
               std::span<const std::filesystem::path> folders = {});

/// The same from a text; `name` is the name of the look, and stands for the file in errors. A
/// relative `wave_normals.map` stays relative. Throws Error for a `base`, too.
Look look_from_toml(const std::string& text, const std::string& name);

/// The look NAME.toml in the first of `folders` that has it; a name that ends in ".toml" or
/// contains a folder is a path. Missing folders are ignored. Throws Error with the names of all
/// looks for an unknown name.
Look look_named(std::string_view name, std::span<const std::filesystem::path> folders);

/// The names of the looks in all of the folders, each once, in alphabetical order.
std::vector<std::string> look_names(std::span<const std::filesystem::path> folders);

/// Applies one setting as written on a command line: `refraction.strength=0.03`,
/// `depth_fog.color=[0.02, 0.1, 0.12]` (brackets may be left out), `refraction.rejection=snap`,
/// `wave_normals.map=waves.png` (relative to the working folder). Throws Error of Fault::kUsage,
/// and then leaves `look` unchanged.
void apply_setting(Look& look, std::string_view setting);

/// Applies settings in order. What they leave without effect of the look itself becomes default
/// (forget_unread): a look with a map and the setting `wave_normals.model=sines` has no map.
void apply_settings(Look& look, std::span<const std::string> settings);

}  // namespace limpid
