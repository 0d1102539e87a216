#include "shade/name_table.h"

#include "op/bottom_layer.h"
#include "op/caustics_table.h"
#include "op/continuation.h"
#include "op/edge_surfaces.h"
#include "optics/scattered_light.h"

namespace limpid {
namespace {

std::string at(const std::string& name, std::size_t place) {
  return name + "[" + std::to_string(place) + "]";
}

}  // namespace

NameTable::NameTable(const Plan& plan, const Pass& pass) {
  add_view(pass);
  add_made(pass);
  add_look(plan.look);
}

const std::string* NameTable::name_of(const void* address) const {
  const auto found = names_.find(address);
  return found == names_.end() ? nullptr : &found->second;
}

void NameTable::add_three(const std::string& name, const glm::dvec3& vector) {
  add(at(name, 0), vector.x), add(at(name, 1), vector.y), add(at(name, 2), vector.z);
}

void NameTable::add_rays(const std::string& name, const Rays& rays) {
  add_three(name + ".origin", rays.origin);
  add_three(name + ".origin_dx", rays.origin_dx);
  add_three(name + ".origin_dy", rays.origin_dy);
  add_three(name + ".ray", rays.ray);
  add_three(name + ".ray_dx", rays.ray_dx);
  add_three(name + ".ray_dy", rays.ray_dy);
}

void NameTable::add_bounds(const std::string& name, const Bounds& bounds) {
  add(name + ".low[0]", bounds.low.x), add(name + ".low[1]", bounds.low.y);
  add(name + ".high[0]", bounds.high.x), add(name + ".high[1]", bounds.high.y);
}

void NameTable::add_view(const Pass& pass) {
  add_rays("camera", pass.rays);
  add_rays("camera.part", pass.part);
  add_three("camera.forward", pass.forward);
  add_three("camera.to_u", pass.to_u);
  add_three("camera.to_v", pass.to_v);
  add("camera.eye_above", pass.eye_above);
  add("camera.near", pass.near);
  add("camera.w_origin", pass.w_origin), add("camera.w_depth", pass.w_depth);
  add("camera.device_offset", pass.device_offset), add("camera.device_scale", pass.device_scale);
  add("camera.over_step[0]", pass.over_step.x), add("camera.over_step[1]", pass.over_step.y);
  add("camera.under_step[0]", pass.under_step.x), add("camera.under_step[1]", pass.under_step.y);
  add("camera.width", pass.size.x), add("camera.height", pass.size.y);
  add_three("water.up", pass.up);
  add_three("water.t", pass.t), add_three("water.b", pass.b);
  add_three("water.map_x", pass.map_x), add_three("water.map_y", pass.map_y);
  add("water.ior", pass.ior);
  for (std::size_t i = 0; i < pass.waves.size(); ++i) {
    add(at("waves.k_x", i), pass.waves[i].k_x), add(at("waves.k_y", i), pass.waves[i].k_y);
  }
  add_three("sun.direction", pass.sun.direction);
  add_bounds("planes.dry", pass.dry), add_bounds("planes.below", pass.below);
  add_bounds("planes.reflection", pass.reflection), add_bounds("planes.surface", pass.surface);
}

void NameTable::add_made(const Pass& pass) {
  if (const EdgeSurfaces* surfaces = pass.edge_surfaces) {
    add("edge_surfaces.reach", surfaces->reach);
    add("edge_surfaces.closed", surfaces->closed);
  }
  if (const Continuation* on = pass.continuation) {
    add_three("continuation.normal", on->normal);
    add("continuation.offset", on->offset), add("continuation.least_drop", on->least_drop);
    add("continuation.lift", on->lift);
    add("continuation.fade", on->fade), add("continuation.settle", on->settle);
    add("continuation.inwards", on->inwards);
  }
  if (const BottomLayer* layer = pass.bottom_layer) {
    add("bottom_layer.scale[0]", layer->scale.x), add("bottom_layer.scale[1]", layer->scale.y);
    add("bottom_layer.offset[0]", layer->offset.x), add("bottom_layer.offset[1]", layer->offset.y);
    add("bottom_layer.most_drop", layer->most_drop);
  }
  for (const CausticsTable* table = pass.caustics; table; table = table->in_water) {
    for (std::size_t k = 0; k < CausticsTable::kMaxLevels; ++k) {
      const std::size_t place = static_cast<std::size_t>(table->first) + k;
      add(at("caustics.corner_x", place), table->levels[k].corner.x);
      add(at("caustics.corner_y", place), table->levels[k].corner.y);
    }
  }
  if (const ScatteredLight* lights = pass.scattered_light) {
    static_assert(sizeof(ScatteredLight) % sizeof(double) == 0);
    constexpr std::size_t kNumbers = sizeof(ScatteredLight) / sizeof(double);
    const char* channels[] = {"scattered_light.r", "scattered_light.g", "scattered_light.b"};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double* numbers = reinterpret_cast<const double*>(lights + channel);
      for (std::size_t i = 0; i < kNumbers; ++i) add(at(channels[channel], i), numbers[i]);
    }
  }
}

void NameTable::add_look(const Look& look) {
  Chain::for_each([&]<class Op, int I>() {
    const auto& params = look.of<Op>();
    for (const auto& field : Op::fields()) {
      const void* address = field.address(params);
      const std::string name = std::string(Op::kName) + "." + std::string(field.name);
      if (field.kind == FieldKind::kColor) {
        const auto& color = *static_cast<const Rgb<double>*>(address);
        add(name + ".r", color.r), add(name + ".g", color.g), add(name + ".b", color.b);
      } else if (field.kind == FieldKind::kTable) {
        if constexpr (requires { params.waves; }) {
          for (std::size_t i = 0; i < params.waves.size(); ++i) {
            add(at("waves.k_x", i), params.waves[i].k_x);
            add(at("waves.k_y", i), params.waves[i].k_y);
          }
        }
      } else if (field.kind == FieldKind::kReal) {
        names_.emplace(address, name);
      }
    }
  });
}

}  // namespace limpid
