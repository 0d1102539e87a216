#pragma once
#include <filesystem>
#include <string>

#include "desk/desk.h"

namespace limpid {

/// A look as a look file for the folder: what is not at its default, a line each with unit and
/// sentence, and what it was in the look `of` where that is something else. It reads back as the
/// same look. A wave map in or below the folder is named from there, others by their whole path.
std::string saved_look(const Look& look, const DeskLook& of, const std::filesystem::path& folder);

}  // namespace limpid
