#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "limpid/files/gltf/gltf.h"

#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

/// The supported glTF extensions, and the effect of other extensions on a file.

namespace limpid {

/// Throws Error for a required extension that is not supported, with its name; warns instead if
/// undrawable parts are left out. Warns of optional extensions in use.
void check_extensions(const JsonPlace& root, Undrawable undrawable, ModelWarnings& warnings);

/// Whether the document lists an extension as used or required.
bool uses_extension(const JsonPlace& root, std::string_view name);

/// The extension of an object, if present.
std::optional<JsonPlace> extension_of(const JsonPlace& object, std::string_view name);

/// The first extension of an object that compresses its bytes in an unsupported format: Draco,
/// meshopt, KTX2, WebP ...
std::optional<std::string> packing_of(const JsonPlace& object);

/// Whether a buffer has no bytes, because the file holds only its packed form.
bool is_packed_buffer(const JsonPlace& buffer);

}  // namespace limpid
