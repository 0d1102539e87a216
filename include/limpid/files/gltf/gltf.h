#pragma once
#include <cstdint>
#include <filesystem>

#include "limpid/files/limits.h"
#include "limpid/raster/model.h"

namespace limpid {

/// Treatment of an unsupported node of a glTF file.
enum class Undrawable : std::uint8_t {
  kRefuse,    ///< the file is refused, with the reason
  kLeaveOut,  ///< the node is left out, and Model::warnings lists it with the reason
};

/// Reads a glTF 2.0 scene: `.gltf` with its .bin, .png and .jpg files or data URIs, or `.glb`.
/// Supported are the default scene's nodes (except those hidden by KHR_node_visibility, with their
/// children); triangles, strips and fans with POSITION, NORMAL, COLOR_0 and the TEXCOORD_n of
/// textures (two in a material, each with its KHR_texture_transform), also quantized
/// (KHR_mesh_quantization), sparse, or without a buffer view, which is zeros; morph targets
/// (positions and normals) at the weights of the node or else of the mesh, skins in the pose of the
/// file, both applied to the vertices; EXT_mesh_gpu_instancing; base color, emission and their
/// textures (sRGB, decoded to linear), samplers' wrapping, alphaMode, doubleSided,
/// KHR_materials_unlit, KHR_materials_emissive_strength; the first camera (ClipSpace::kGl, without
/// the scale of its node), and the first directional light of KHR_lights_punctual as the sun (color
/// times intensity). These extras extend glTF:
///
///     material  {"limpid": {"shading": "flat" | "textured" | "lambert" | "phong" | "toon",
///               "ambient": [r, g, b], "power": 20, "specular": [r, g, b],
///               "specular_texture": {"index": 0, "texCoord": 0}}}
///     node      {"limpid": {"water": true}}   its mesh is the water surface
///     scene     {"limpid": {"background": [r, g, b]}}
///
/// Without extras a material is lambert; an unlit one textured, or flat where it has no texture,
/// and without emission. Of KHR_materials_pbrSpecularGlossiness the diffuse color is drawn.
///
/// Opacity is that of AlphaMode (raster/model.h), in the raster pass and in the path-traced truth:
/// MASK removes parts below the cutoff from every picture, depth and shadow; BLEND blends color
/// over the surfaces behind, in whatever order the file has them, while the depth of a pixel and
/// shadows are those of the nearest surface with an opacity of at least half. OPAQUE ignores
/// alpha.
///
/// Not drawn: points, lines, other lights and cameras, animations, metal, roughness, normal and
/// occlusion maps, and optional extensions that are not named above. Model::warnings lists them,
/// one line for each kind, except metal, roughness and other cameras. Degenerate triangles are left
/// out and counted. Vertex colors below 0 become 0.
///
/// Throws Error, which names the file, the place in it, the value and the expected value, for files
/// that are not glTF 2.0 (invalid indices, sizes and types, nodes in a cycle or with two parents,
/// rotations that are no unit quaternions), for required extensions except those above, for meshes
/// and buffers packed by Draco or meshopt and for textures in KTX2 or WebP without an alternative,
/// for a third set of uvs in a material, for NaN and infinities, for unknown words in the extras,
/// for files outside the folder of the glTF file, and for anything over the limits.
///
/// With Undrawable::kLeaveOut a node whose mesh, skin, material, texture or matrix would be refused
/// is left out instead, and no required extension is refused. Faults of the file as a whole
/// (buffers, accessors, the tree of nodes, cameras, lights) are still refused, and so is anything
/// over the limits.
Model load_gltf(const std::filesystem::path& path, const Limits& limits = {},
                Undrawable undrawable = Undrawable::kRefuse);

}  // namespace limpid
