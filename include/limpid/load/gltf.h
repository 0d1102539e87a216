#pragma once
#include <filesystem>

#include "limpid/load/limits.h"
#include "limpid/raster/model.h"

namespace limpid {

/// Reads a glTF 2.0 scene: `.gltf` with its .bin, .png and .jpg files or data URIs, or `.glb`.
/// Taken from it: the default scene's nodes, triangle lists with POSITION, NORMAL and TEXCOORD_0,
/// base color and its texture (sRGB, decoded to linear), doubleSided, KHR_materials_unlit, the
/// first camera (ClipSpace::kGl, without the scale of its node), and the first directional light of
/// KHR_lights_punctual as the sun (color times intensity). Extras say what glTF has no word for:
///
///     material  {"limpid": {"shading": "flat" | "textured" | "lambert" | "phong" | "toon",
///               "ambient": [r, g, b], "power": 20, "specular": [r, g, b],
///               "specular_texture": {"index": 0}}}
///     node      {"limpid": {"water": true}}   its mesh is the water surface
///     scene     {"limpid": {"background": [r, g, b]}}
///
/// Without extras a material is lambert; an unlit one textured, or flat where it has no texture.
/// Not drawn and left out: other lights and cameras, animations, metal, roughness, normal,
/// occlusion and emissive maps. Triangles of no area are left out and counted.
///
/// Throws Error, which names the file, the place in it, the value and what was expected, for what
/// is not glTF 2.0 (indices, sizes and types that do not hold, nodes in a cycle or with two
/// parents), for required extensions but the two above, for what would be drawn wrongly (strips,
/// fans, lines, points, sparse accessors, skins, morph targets, vertex colors, alpha other than
/// OPAQUE but on water, KHR_texture_transform, a second uv set, uvs outside 0 ... 1 on a texture
/// that does not repeat), for NaN and infinities, for unknown words in the extras, for files
/// outside the folder of the glTF file, and for anything over the limits.
Model load_gltf(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace limpid
