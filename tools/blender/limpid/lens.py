"""A camera's lens in Blender's own numbers, and the same lens for a larger picture."""
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Overscan:
    """Pixels rendered beyond each side of the picture."""
    left: int = 0
    right: int = 0
    top: int = 0
    bottom: int = 0

    def around(self, size):
        return size[0] + self.left + self.right, size[1] + self.top + self.bottom


@dataclass(frozen=True)
class Lens:
    """`sensor_fit` is HORIZONTAL, VERTICAL or AUTO; widths are in mm, but `ortho_scale` in scene units.
    Shifts are shares of the side to which the sensor is fitted."""
    sensor_fit: str
    sensor_width: float
    sensor_height: float
    ortho_scale: float
    shift_x: float
    shift_y: float


def widened(lens, size, aspect, overscan):
    """The lens that shows the same at each pixel of the picture, plus the overscan. `size` is that of the
    picture, `aspect` the sides of a pixel, x and y."""
    width, height = size
    tall = aspect[1] / aspect[0]  # a pixel, in widths of a pixel
    across = lens.sensor_fit == "HORIZONTAL" or (lens.sensor_fit == "AUTO" and width >= tall * height)
    fitted = width if across else tall * height
    sensor = lens.sensor_height if lens.sensor_fit == "VERTICAL" else lens.sensor_width
    whole = overscan.around(size)[0]
    right = (overscan.right - overscan.left) / 2
    up = tall * (overscan.top - overscan.bottom) / 2
    return replace(lens, sensor_fit="HORIZONTAL", sensor_width=sensor * whole / fitted,
                   ortho_scale=lens.ortho_scale * whole / fitted,
                   shift_x=(lens.shift_x * fitted + right) / whole, shift_y=(lens.shift_y * fitted + up) / whole)
