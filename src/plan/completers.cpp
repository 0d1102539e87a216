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
     "The depth of the water that sine waves raise and lower."},
    {"mirror_depth",
     kReflectionPlanes | PlaneSet{PlaneId::kDepth},
     PlaneSet{PlaneId::kReflectionDepth, PlaneId::kReflectionValid},
     PlaneSet{PlaneId::kReflectionDepth, PlaneId::kReflectionValid},
     {},
     "The depth of the reflection from that of the dry scene, and where objects cut at the water "
     "show their insides."},
    {"bottom_albedo",
     kDryPlanes,
     kAlbedoPlanes,
     {},
     PlaneSet{PlaneId::kShadow},
     "How much of the light the bottom throws back, from the dry picture of it."},
    {"sky", kDryPlanes, kSkyPlanes, {}, {}, "The sky of the frame, drawn on behind what hides it."},
};

}  // namespace

std::span<const CompleterInfo> completers() { return kCompleters; }

}  // namespace limpid
