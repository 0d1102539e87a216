#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include <glm/vec3.hpp>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/host_view.h"
#include "limpid/enter/sanitise.h"

#include "enter/half.h"

namespace limpid {

using HostPlanes = std::array<HostInput, kPlaneCount>;

/// The content of a host's planes, and what is known about it.
struct EntryRules {
  DepthSource depth;       ///< of the depth planes except `half`, which is found for each
  glm::dvec3 up{0, 1, 0};  ///< replaces invalid normals
  bool trusted = false;    ///< numbers and eye depths follow the conventions of a Frame already
  PlaneSet written;        ///< planes whose memory the picture will overwrite
  const HalfTarget* half = nullptr;
};

/// The planes of a host as those of a Frame: the host's memory where it fits, else copies in the
/// frame's conventions. Planes that may hold invalid values are scanned first, and copied if any is
/// found. Memory is kept: none is allocated after the first frame of a size.
class EnteredPlanes {
 public:
  /// Sets frame.planes, to the wanted planes only. Throws Error for a plane without pixels and for
  /// normals of several sizes; `rules` must suit the kind of depth.
  SanitiseCounts enter(const HostPlanes& host, PlaneSet wanted, const EntryRules& rules,
                       Executor& executor, Frame& frame);

 private:
  struct Entry;  // of one frame

  /// How the planes of a role enter.
  struct PlaneRoute {
    bool watched = false, copied = false;
    Rect window;  ///< the window that all its planes share
    std::atomic<bool> wrong = false;
    std::atomic<std::int64_t> nan = 0, inf = 0;  ///< values that were replaced
  };

  std::array<Plane, kPlaneCount> planes_;
  std::array<PlaneRoute, kPlaneCount> routes_;  ///< of a role, at its first plane
};

}  // namespace limpid
