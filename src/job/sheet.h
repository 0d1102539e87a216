#pragma once
#include "limpid/core/rect.h"
#include "limpid/job/composite.h"

#include "job/canvas.h"
#include "show/shown.h"

namespace limpid {

/// The picture of a canvas and all its AOVs, which must have been computed, with their names and
/// the values of their darkest and brightest tones; the part of the window within `display`.
/// Pictures wider than 480 pixels are reduced by Canvas::filtered().
Shown sheet_of(const Canvas& canvas, const Rect& display, const DisplayTransform& light);

/// CompositeReport::preview, by the choice: empty for no preview. `primaries` are those of the
/// canvas.
PreviewPixels preview_pixels(const Canvas& canvas, const Rect& display, const OutputChoice& choice,
                             const Primaries& primaries = kRec709);

}  // namespace limpid
