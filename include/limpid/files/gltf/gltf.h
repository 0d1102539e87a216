#pragma once
#include <cstdint>
#include <filesystem>

#include "limpid/files/limits.h"
#include "limpid/raster/model.h"

namespace limpid {

/// What becomes of a node of a glTF file that cannot be drawn.
enum class Undrawable : std::uint8_t {
  kRefuse,    ///< the file is refused, with the reason
  kLeaveOut,  ///< the node is left out, and Model::warnings lists it with the reason
};

/// Reads a glTF 2.0 scene: `.gltf` with its .bin, .png and .jpg files or data URIs, or `.glb`.
/// Taken from it: the default scene's nodes (but those that KHR_node_visibility hides, with all
/// below them); triangles, strips and fans with POSITION, NORMAL, COLOR_0 and the TEXCOORD_n that
/// textures ask for (two in a material, each with its KHR_texture_transform), also quantized
/// (KHR_mesh_quantization), sparse, or without a buffer view, which is zeros; morph targets
/// (positions and normals) at the node's weights or else the mesh's, skins as the nodes of the file
/// pose them, both worked into the vertices; EXT_mesh_gpu_instancing; base color, emission and
/// their textures (sRGB, decoded to linear), samplers' wrapping, alphaMode, doubleSided,
/// KHR_materials_unlit, KHR_materials_emissive_strength; the first camera (ClipSpace::kGl, without
/// the scale of its node), and the first directional light of KHR_lights_punctual as the sun (color
/// times intensity). Extras say what glTF has no word for:
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
/// Opacity is what AlphaMode says of it (raster/model.h), in the raster pass and the traced truth
/// alike: MASK leaves out what is below the cutoff, from every picture, depth and shadow; BLEND
/// blends color over what lies behind, in whatever order the file has it, while a pixel's depth,
/// and the shadow that falls, are those of the nearest surface that hides at least half. OPAQUE
/// ignores alpha.
///
/// Not drawn and left out: points, lines, other lights and cameras, animations, metal, roughness,
/// normal and occlusion maps, extensions that are optional and not named above. Model::warnings
/// says so, a line a kind, but of metal, roughness and other cameras. Triangles of no area are left
/// out and counted. Colors of vertices below 0 become 0.
///
/// Throws Error, which names the file, the place in it, the value and what was expected, for what
/// is not glTF 2.0 (indices, sizes and types that do not hold, nodes in a cycle or with two
/// parents, rotations that are no unit quaternions), for required extensions but those above, for
/// what is packed by Draco or meshopt and for textures in KTX2 or WebP where there is nothing else
/// to take, for a third set of uvs in a material, for NaN and infinities, for unknown words in the
/// extras, for files outside the folder of the glTF file, and for anything over the limits.
///
/// With Undrawable::kLeaveOut a node whose mesh, skin, material, texture or matrix is a reason to
/// refuse is left out instead, and no required extension is a reason to refuse. What is wrong with
/// the file as a whole (buffers, accessors, the tree of nodes, cameras, lights) is refused all the
/// same, and so is what is over the limits.
Model load_gltf(const std::filesystem::path& path, const Limits& limits = {},
                Undrawable undrawable = Undrawable::kRefuse);

}  // namespace limpid
