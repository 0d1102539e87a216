#include "limpid/plan/completers.h"

namespace limpid {
namespace {

constexpr PlaneSet kDryPlanes = kColorPlanes | PlaneSet{PlaneId::kDepth};

constexpr CompleterInfo kCompleters[] = {
    {"displaced_surface",
     PlaneSet{PlaneId::kDepth},
     PlaneSet{PlaneId::kSurfaceDepth},
     {},
     {},
     "The depth of the surface with sine waves."},
    {"surface_shadow",
     PlaneSet{PlaneId::kDepth, PlaneId::kShadow},
     PlaneSet{PlaneId::kSurfaceShadow},
     {},
     PlaneSet{PlaneId::kSurfaceDepth},
     "The sun's shadows on the water from those of the dry picture and its depth."},
    {"mirror_depth",
     kReflectionPlanes | PlaneSet{PlaneId::kDepth},
     PlaneSet{PlaneId::kReflectionDepth, PlaneId::kReflectionValid},
     PlaneSet{PlaneId::kReflectionDepth, PlaneId::kReflectionValid},
     {},
     "The depth of the reflection from the dry depth, and the insides of objects clipped at the "
     "water."},
    {"bottom_albedo",
     kDryPlanes,
     kAlbedoPlanes | PlaneSet{PlaneId::kBasin},
     {},
     PlaneSet{PlaneId::kShadow},
     "The albedo of the bottom, and its share for an endless floor, from the dry picture."},
    {"sky",
     kDryPlanes,
     kSkyPlanes,
     {},
     {},
     "The sky of the frame, continued behind the objects that hide it, and above the picture as "
     "it changes with elevation; without a visible sky the sky of the scene, or a guess from the "
     "frame's brightness and the sun."},
};

}  // namespace

std::span<const CompleterInfo> completers() { return kCompleters; }

}  // namespace limpid
