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

/// What planes of a host hold, and what is known of them.
struct EntryRules {
  DepthSource depth;       ///< of the depth planes but for `half`, which is found for each
  glm::dvec3 up{0, 1, 0};  ///< in place of normals that are none
  bool trusted = false;    ///< numbers and eye depths are in the conventions of a Frame already
  PlaneSet written;        ///< these lie where the picture will be
  const HalfTarget* half = nullptr;
};

/// The planes of a host as those of a Frame: where they lie, if they can be taken so, else copies
/// in its conventions. Those that may be insane are looked through first, and copied if something
/// is wrong. Memory is kept: none is allocated after the first frame of a size.
class EnteredPlanes {
 public:
  /// Sets frame.planes, to the wanted ones alone. Throws Error for a plane without pixels and for
  /// normals of several sizes; `rules` must be fit for their kind of depth.
  SanitiseCounts enter(const HostPlanes& host, PlaneSet wanted, const EntryRules& rules,
                       Executor& executor, Frame& frame);

 private:
  struct Entry;  // of one frame

  /// What becomes of the planes of a role.
  struct Way {
    bool watched = false, copied = false;
    Rect window;  ///< of all its planes together
    std::atomic<bool> wrong = false;
    std::atomic<std::int64_t> nan = 0, inf = 0;  ///< that were replaced
  };

  std::array<Plane, kPlaneCount> planes_;
  std::array<Way, kPlaneCount> ways_;  ///< of a role, at its first plane
};

}  // namespace limpid
