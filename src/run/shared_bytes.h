#pragma once
#include "limpid/core/host_view.h"

namespace limpid {

/// Whether two of these pixels, which the view has, share a byte.
bool shares_bytes(const HostOutput& view, const Rect& pixels);

/// Whether a pixel of the one shares a byte with one of the other. Exact, for any strides; takes a
/// time that grows with the lines of the pictures, not with their pixels, where the strides within
/// lines are the same. Neither may share bytes within itself.
bool share_bytes(const HostOutput& a, const HostOutput& b, const Rect& pixels);

}  // namespace limpid
