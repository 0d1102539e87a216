#include "raster/material_view.h"

#include <algorithm>
#include <string>

#include "limpid/core/error.h"

namespace limpid::raster {
namespace {

void expect_texture(const Material& m, const char* key, int index, const Model& model) {
  if (index >= -1 && index < static_cast<int>(model.textures.size())) return;
  throw Error("material '" + m.name + "': " + key + " = " + std::to_string(index) +
              ": expected less than " + std::to_string(model.textures.size()));
}

void expect_uv_set(const Material& m, const TextureLookup& lookup) {
  if (lookup.uv_set == 0 || lookup.uv_set == 1) return;
  throw Error("material '" + m.name + "': uv set " + std::to_string(lookup.uv_set) +
              ": expected 0 or 1");
}

void copy(const Rgb<double>& from, float* to) {
  to[0] = static_cast<float>(from.r);
  to[1] = static_cast<float>(from.g);
  to[2] = static_cast<float>(from.b);
}

/// Lower bound of the opacity of all fragments of the material on this mesh. Mip levels are means,
/// within the bounds.
double least_opacity(const Material& m, const Model& model, const std::vector<glm::vec4>& colors) {
  double least = m.alpha;
  if (m.base_texture >= 0) {
    const std::vector<float>& rgba = model.textures[static_cast<std::size_t>(m.base_texture)].rgba;
    float alpha = 1;
    for (std::size_t i = 3; i < rgba.size(); i += 4) alpha = std::min(alpha, rgba[i]);
    least *= alpha;
  }
  float alpha = 1;
  for (const glm::vec4& color : colors) alpha = std::min(alpha, color.a);
  return least * alpha;
}

void set_opacity(const Material& m, const Model& model, const std::vector<glm::vec4>& colors,
                 MaterialView& view) {
  view.alpha = static_cast<float>(m.alpha);
  if (m.alpha_mode == AlphaMode::kOpaque) return;
  const bool mask = m.alpha_mode == AlphaMode::kMask;
  // A little less, for rounding at the threshold.
  const auto from = [](double opacity) { return static_cast<float>(opacity * (1 - 1e-6)); };
  view.solid_from = from(mask ? m.alpha_cutoff : kOpaqueFrom);
  view.blocks_from = from(mask ? m.alpha_cutoff : kBlocksFrom);
  if (least_opacity(m, model, colors) < view.solid_from) view.alpha_mode = m.alpha_mode;
}

}  // namespace

MaterialView material_view(const Material& m, const Model& model,
                           const std::vector<Pyramid>& pyramids,
                           const std::vector<glm::vec4>& colors) {
  expect_texture(m, "base_texture", m.base_texture, model);
  expect_texture(m, "specular_texture", m.specular_texture, model);
  expect_texture(m, "emissive_texture", m.emissive_texture, model);
  MaterialView view{};
  view.shading = m.shading;
  copy(m.base_color, view.base);
  copy(m.ambient, view.ambient);
  copy(m.specular, view.specular);
  copy(m.emission, view.emission);
  view.power = static_cast<float>(m.power);
  view.plain = true;
  const auto set_texture = [&](int index, const TextureLookup& lookup, const PyramidView*& texture,
                               TextureLookup& to) {
    expect_uv_set(m, lookup);
    if (index < 0) return;
    texture = &pyramids[static_cast<std::size_t>(index)].view();
    to = lookup;
    view.plain = view.plain && lookup == TextureLookup{};
  };
  const bool emits = m.emission != Rgb<double>{0, 0, 0};
  set_texture(m.base_texture, m.base_lookup, view.base_texture, view.base_lookup);
  set_texture(m.specular_texture, m.specular_lookup, view.specular_texture, view.specular_lookup);
  set_texture(emits ? m.emissive_texture : -1, m.emissive_lookup, view.emissive_texture,
              view.emissive_lookup);
  view.vertex_colors = !colors.empty();
  set_opacity(m, model, colors, view);
  const bool opaque = view.alpha_mode == AlphaMode::kOpaque;
  view.plain = view.plain && opaque && !emits && !view.vertex_colors;
  return view;
}

}  // namespace limpid::raster
