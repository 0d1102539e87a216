"""The overscan that the water needs, from `limpid plan` on a small test render."""
import math
import re

from .lens import Overscan

TEST_SIZE = 240    # pixels, of the longer side of a test render
MOST = 0.5         # of the picture's longer side, on each side
SPARE = 1.1        # a test render's edges are coarse, and waves move the refracted picture
SENTENCE = re.compile(r"overscan of color and depth by (.*) would show")
SIDE = re.compile(r"(\d+)(?: pixels?)? (?:on|at) the (left|right|top|bottom)")


def small(size):
    """The size of the test render of such a picture."""
    scale = min(1, TEST_SIZE / max(size))
    return max(1, round(size[0] * scale)), max(1, round(size[1] * scale))


def asked_for(plan, test_size, size):
    """The overscan of a picture of `size`, by the plan's text for its test render."""
    found = SENTENCE.search(plan)
    if not found:
        return Overscan()
    scale = max(size) / max(test_size)
    most = round(MOST * max(size))
    return Overscan(**{side: min(most, math.ceil(int(pixels) * scale * SPARE)) for pixels, side in SIDE.findall(found[1])})


def largest(overscans):
    """The overscan that is enough for several frames."""
    return Overscan(*(max((getattr(one, side) for one in overscans), default=0)
                      for side in ("left", "right", "top", "bottom")))


def sampled(frames, most=5):
    """Frames to test, spread over a sequence, including its first and last."""
    if len(frames) <= most:
        return list(frames)
    return [frames[round(i * (len(frames) - 1) / (most - 1))] for i in range(most)]
