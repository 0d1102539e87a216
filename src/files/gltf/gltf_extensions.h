#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "limpid/files/gltf/gltf.h"

#include "files/gltf/model_warnings.h"
#include "files/text/json_place.h"

/// Which extensions of glTF are read, and what those that are not do to a file.

namespace limpid {

/// Throws Error for a required extension that is not read, with its name; tells of it when what
/// cannot be drawn is left out. Tells of those that are used and optional.
void check_extensions(const JsonPlace& root, Undrawable undrawable, ModelWarnings& warnings);

/// Whether the document lists an extension among those that it uses or requires.
bool uses_extension(const JsonPlace& root, std::string_view name);

/// An extension of an object, if it is there.
std::optional<JsonPlace> extension_of(const JsonPlace& object, std::string_view name);

/// The first extension of an object that packs its bytes in a way that is not read: Draco, meshopt,
/// KTX2, WebP ...
std::optional<std::string> packing_of(const JsonPlace& object);

/// Whether a buffer has no bytes, because only its packed form is in the file.
bool is_packed_buffer(const JsonPlace& buffer);

}  // namespace limpid
