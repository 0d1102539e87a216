#pragma once
#include <optional>

#include "limpid/job/composite.h"

#include "arguments.h"
#include "show/terminal.h"

/// `--show`: the picture in the terminal.

namespace limpid::tool {

/// The protocol for the picture; nothing without --show. Throws the usage Error if the standard
/// output is no terminal, or none that is known to show pictures, and no protocol is named.
std::optional<TerminalPictures> chosen_protocol(const WaterOptions& options);

/// Writes the picture to the standard output.
void show(const PreviewPixels& picture, TerminalPictures protocol);

}  // namespace limpid::tool
