#pragma once
#include "limpid/raster/model.h"

#include "files/text/json_place.h"

namespace limpid {

/// What a glTF sampler says of the outside of 0 ... 1, in u and v.
struct GltfSampler {
  Wrap wrap_u = Wrap::kRepeat, wrap_v = Wrap::kRepeat;
};

GltfSampler read_gltf_sampler(const JsonPlace& sampler);

}  // namespace limpid
