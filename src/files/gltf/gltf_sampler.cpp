#include "files/gltf/gltf_sampler.h"

namespace limpid {
namespace {

Wrap wrap_of(const JsonPlace& sampler, std::string_view key) {
  const std::optional<JsonPlace> wrap = sampler.find(key);
  if (!wrap) return Wrap::kRepeat;
  switch (wrap->integer(0, INT32_MAX)) {
    case 10497:
      return Wrap::kRepeat;
    case 33071:
      return Wrap::kClamp;
    case 33648:
      return Wrap::kMirror;
    default:
      wrap->refuse("one of 10497, 33071, 33648");
  }
}

}  // namespace

GltfSampler read_gltf_sampler(const JsonPlace& sampler) {
  return {wrap_of(sampler, "wrapS"), wrap_of(sampler, "wrapT")};
}

}  // namespace limpid
