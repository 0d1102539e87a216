#pragma once
#include "limpid/core/host_view.h"

namespace limpid {

/// Whether two of these pixels share a byte. The view must cover them.
bool shares_bytes(const HostOutput& view, const Rect& pixels);

/// Whether a pixel of `a` shares a byte with a pixel of `b`. Exact, for any strides; the time grows
/// with the lines of the pictures, not with their pixels, if the strides within lines are equal.
/// Neither view may share bytes within itself.
bool share_bytes(const HostOutput& a, const HostOutput& b, const Rect& pixels);

}  // namespace limpid
