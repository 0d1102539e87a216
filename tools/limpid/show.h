#pragma once
#include <optional>

#include "limpid/job/composite.h"

#include "arguments.h"
#include "show/terminal.h"

/// `--show`: the picture in the terminal.

namespace limpid::tool {

/// How the picture is shown; nothing where that is not asked for. Throws the usage Error where the
/// standard output is no terminal, or none that is known to show pictures, and no way is named.
std::optional<TerminalPictures> way_to_show(const WaterOptions& options);

/// Writes it to the standard output.
void show(const PreviewPixels& picture, TerminalPictures way);

}  // namespace limpid::tool
