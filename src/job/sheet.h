#pragma once
#include "limpid/core/rect.h"
#include "limpid/job/composite.h"

#include "job/canvas.h"
#include "show/shown.h"

namespace limpid {

/// The picture of a canvas and all its AOVs, which must have been computed, with their names and
/// what their darkest and brightest stand for; of the window what lies in `display`. Pictures wider
/// than 480 pixels are made smaller, as Canvas::filtered().
Shown sheet_of(const Canvas& canvas, const Rect& display, const DisplayTransform& light);

/// CompositeReport::preview, as the choice wants it: nothing for no pixels. `primaries` are those
/// of the canvas.
PreviewPixels preview_pixels(const Canvas& canvas, const Rect& display, const OutputChoice& choice,
                             const Primaries& primaries = kRec709);

}  // namespace limpid
