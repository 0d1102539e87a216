#pragma once
#include <filesystem>
#include <string>

#include "desk/desk.h"

namespace limpid {

/// A look as a look file for the folder: parameters that differ from their default, a line each
/// with unit and sentence, and the value in the look `of` if that differs. It reads back as the
/// same look. A wave map in or below the folder has a relative path, others an absolute one.
std::string saved_look(const Look& look, const DeskLook& of, const std::filesystem::path& folder);

}  // namespace limpid
