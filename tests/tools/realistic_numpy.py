#!/usr/bin/env python3
"""The look `realistic` in numpy float64: a second implementation of its formulas, which checks limpid's.

Written from the descriptions of the models only, never from the C++ code, so that it finds a wrong
formula in the source that all runners share.

    realistic_numpy.py fixture OUT.bin        a synthetic plate and its expected picture
    realistic_numpy.py lagoon FOLDER OUT.npy  a folder of plates (oiiotool decodes the files)

The fixture is little-endian: the magic text "limpid-1", int32 width and height, float64 view[16],
projection[16] (rows), up[3], sun_direction[3], sun_color[3]; then float32 planes, rows from the top:
color RGB, depth, shadow, reflection RGB, surface depth, surface normal XYZ; then float32 beauty RGB.
"""
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

import numpy as np

REALISTIC = dict(
    refraction=0.03,  # uv per unit tilt
    prism=0.004,
    fog_density=0.15,
    fog_offset=0.0,
    fog_color=(0.02, 0.10, 0.12),
    fog_alpha=0.9,
    darken=0.5,
    reflection=0.02,
    rim_power=3,
    highlight_power=200,
    highlight_strength=1.0,
)


def sat(x):
    return np.clip(x, 0.0, 1.0)


def lerp(a, b, t):
    return a + t * (b - a)


def normalized(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def bilinear(image, u, v):
    """Texel centres at +0.5; a tap outside the picture takes the nearest edge texel."""
    height, width = image.shape[:2]
    x, y = u * width - 0.5, v * height - 0.5
    x0, y0 = np.floor(x), np.floor(y)
    fx, fy = x - x0, y - y0
    left, right = (np.clip(x0 + i, 0, width - 1).astype(int) for i in (0, 1))
    top, bottom = (np.clip(y0 + i, 0, height - 1).astype(int) for i in (0, 1))
    if image.ndim == 3:
        fx, fy = fx[..., None], fy[..., None]
    above = lerp(image[top, left], image[top, right], fx)
    below = lerp(image[bottom, left], image[bottom, right], fx)
    return lerp(above, below, fy)


def taps(image, u, v):
    """The four texels of a bilinear lookup, and their weights."""
    height, width = image.shape
    x, y = u * width - 0.5, v * height - 0.5
    x0, y0 = np.floor(x), np.floor(y)
    fx, fy = x - x0, y - y0
    columns = [np.clip(x0 + i, 0, width - 1).astype(int) for i in (0, 1)]
    rows = [np.clip(y0 + i, 0, height - 1).astype(int) for i in (0, 1)]
    values = [image[row, column] for row in rows for column in columns]
    weights = [wy * wx for wy in (1 - fy, fy) for wx in (1 - fx, fx)]
    return np.stack(values), np.stack(weights)


def mean(values, weights):
    return (np.where(weights > 0, values, 0) * weights).sum(0) / np.maximum(weights.sum(0), 1e-12)


def seen(channel, depth, u, v):
    """A bilinear lookup of texels with a surface; 0 where these have less than half of the weight."""
    values, weights = taps(channel, u, v)
    hit = np.isfinite(taps(depth, u, v)[0])
    lost = np.where(hit, 0, weights).sum(0)
    some = np.where(lost < 0.5, mean(values, np.where(hit, weights, 0)), 0)
    return np.where(lost > 0, some, bilinear(channel, u, v))


def depth_seen(depth, u, v, surface):
    """The depth of the nearest texel; if no surface was hit there, of the texels beside it that lie behind the
    surface; +inf if half of the weight or more has no surface."""
    values, weights = taps(depth, u, v)
    lost = np.where(np.isfinite(values), 0, weights).sum(0)
    behind = np.where(np.isfinite(values) & (values > surface), weights, 0)
    beside = np.where(behind.sum(0) > 0, mean(values, behind), np.inf)
    at = nearest(depth, u, v)
    at = np.where((lost > 0) & np.isinf(at), beside, at)
    return np.where(lost < 0.5, at, np.inf)


def nearest(image, u, v):
    height, width = image.shape[:2]
    x = np.clip(np.floor(u * width), 0, width - 1).astype(int)
    y = np.clip(np.floor(v * height), 0, height - 1).astype(int)
    return image[y, x]


def to_viewer(view, projection, u, v):
    """Unit vectors from the visible point at (u, v) to a perspective camera, in world space."""
    ndc_x, ndc_y = 2 * u - 1, 1 - 2 * v
    ray = np.stack(
        [
            (ndc_x + projection[0, 2]) / projection[0, 0],
            (ndc_y + projection[1, 2]) / projection[1, 1],
            -np.ones_like(u),
        ],
        axis=-1,
    )
    world_from_view = view[:3, :3].T  # a rotation
    return -normalized(ray @ world_from_view.T)


def tilt(normal, view, up):
    """Screen tilt of a wave normal: x right, y down, zero on calm water."""
    right, camera_up = view[0, :3], view[1, :3]
    t = right - up * (right @ up)
    if np.linalg.norm(t) < 1e-6:
        t = camera_up - up * (camera_up @ up)
    t = normalized(t)
    b = np.cross(up, t)
    return normal @ t, -(normal @ b)


def realistic(plate, p=REALISTIC):
    """Beauty (height, width, 3) of a plate: a dict of float64 arrays, see `fixture` for its keys."""
    color, depth, surface = plate["color"], plate["depth"], plate["surface_depth"]
    view, projection = plate["view"], plate["projection"]
    up, sun = normalized(plate["up"]), normalized(plate["sun_direction"])
    height, width = depth.shape

    length = np.linalg.norm(plate["surface_normal"], axis=-1, keepdims=True)
    known = np.isfinite(length) & (length > 0)
    normal = np.where(known, plate["surface_normal"] / np.where(known, length, 1), up)

    v, u = np.meshgrid((np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width,
                       indexing="ij")
    wet = np.isfinite(surface) & (surface < depth)
    zs = np.where(wet, surface, 0.0)
    mx, my = tilt(normal, view, up)

    # Refraction by an offset, snapped back where it would land in front of the surface.
    u1, v1 = u + p["refraction"] * mx, v + p["refraction"] * my
    snapped = nearest(depth, u1, v1) - zs < 0
    u1, v1 = np.where(snapped, u, u1), np.where(snapped, v, v1)
    px = np.where(snapped, 0.0, p["prism"] * mx)
    py = np.where(snapped, 0.0, p["prism"] * my)
    path = depth_seen(depth, u1, v1, zs) - zs

    # Prism: one lookup per channel. No light comes from water without a bottom.
    under = np.stack(
        [
            seen(color[..., 0], depth, u1 + px, v1),
            seen(color[..., 1], depth, u1 + px / 2, v1 + py / 2),
            seen(color[..., 2], depth, u1, v1 + py),
        ],
        axis=-1,
    )
    under = np.where(np.isinf(path)[..., None], 0, under)

    # Fog, then the shadow on murky water.
    f = 1 - sat(p["fog_density"] * path - p["fog_offset"])
    fogged = lerp(np.array(p["fog_color"]), under, f[..., None])
    under = lerp(under, fogged, p["fog_alpha"])
    shadow = bilinear(plate["shadow"], u1, v1)
    under = under * (1 - p["darken"] * (1 - shadow))[..., None]

    # Reflection by the model `rim`.
    V = to_viewer(view, projection, u, v)
    F = (1 - np.abs(np.sum(V * normal, axis=-1))) ** p["rim_power"]
    reflected = bilinear(plate["reflection"], u + p["reflection"] * mx, v + p["reflection"] * my)
    water = lerp(under, reflected, F[..., None])

    # The sun's highlight, not where the pixel lies in shadow or the wave faces away from the sun.
    H = normalized(V + sun)
    spec = sat(np.sum(H * normal, axis=-1)) ** p["highlight_power"] * p["highlight_strength"]
    spec = np.where(np.sum(sun * normal, axis=-1) > 0, spec, 0)
    water = water + (spec * plate["shadow"])[..., None] * plate["sun_color"]

    return np.where(wet[..., None], water, color)


def made_up_plate(width=64, height=36):
    """A tilted Z-up camera over a wavy lake: a beach, two posts, a floating box, sky, deep water."""
    pitch, yaw = np.radians(-13.0), np.radians(17.0)
    forward = np.array([np.sin(yaw) * np.cos(pitch), np.cos(yaw) * np.cos(pitch), np.sin(pitch)])
    right = normalized(np.cross(forward, [0.0, 0.0, 1.0]))
    camera_up = np.cross(right, forward)
    eye = np.array([0.4, -6.0, 2.2])
    view = np.eye(4)
    view[:3, :3] = np.stack([right, camera_up, -forward])
    view[:3, 3] = -view[:3, :3] @ eye
    near, far, fx = 0.1, 400.0, 1.7
    projection = np.zeros((4, 4))
    projection[0, 0], projection[1, 1] = fx, fx * width / height
    projection[2, 2], projection[2, 3] = (far + near) / (near - far), 2 * far * near / (near - far)
    projection[3, 2] = -1

    v, u = np.meshgrid((np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width,
                       indexing="ij")
    ray = np.stack([(2 * u - 1) / fx, (1 - 2 * v) / projection[1, 1], -np.ones_like(u)], axis=-1)
    direction = ray @ view[:3, :3]  # world direction per unit of eye depth
    down = direction[..., 2]
    with np.errstate(divide="ignore"):
        surface = np.where(down < 0, -eye[2] / down, np.inf)
        bottom = np.where(down < -0.02, (-1.5 - eye[2]) / down, np.inf)  # inf: no visible bottom
    # A beach rises out of the water on the left; the other surfaces are objects in front of the lake.
    beach = normalized(np.array([0.3, 0.1, 1.0]))
    toward = direction @ beach
    z = np.where(toward < 0, ((np.array([-1.2, 0.0, 0.0]) - eye) @ beach) / toward, np.inf)
    depth = np.minimum(bottom, np.where(z > 0, z, np.inf))
    x, y = np.meshgrid(np.arange(width), np.arange(height))
    depth = np.where((x >= 28) & (x < 31) & (y < 26), 6.5, depth)
    depth = np.where((x >= 47) & (x < 49) & (y < 31), 5.0, depth)
    depth = np.where((x >= 52) & (x < 60) & (y >= 24) & (y < 29), 4.2, depth)

    point = eye + direction * np.where(np.isfinite(surface), surface, 0)[..., None]
    slope_x = 0.6 * np.cos(1.9 * point[..., 0] + 0.7 * point[..., 1])
    slope_y = 0.5 * np.sin(1.3 * point[..., 1] - 0.9 * point[..., 0] + 0.4)
    normal = normalized(np.stack([-slope_x, -slope_y, np.ones_like(u)], axis=-1))
    normal *= (0.6 + 0.4 * u)[..., None]  # filtered normals are never unit
    normal[4, 5] = normal[30, 12] = 0

    wave = lambda a, b, c: 0.5 + 0.45 * np.sin(a * x + b * y + c)
    color = np.stack([wave(0.9, 0.4, 0.1), wave(0.3, 1.1, 1.0), wave(0.7, -0.8, 2.0)], axis=-1)
    color[20:22, 20:24] *= 6  # brighter than white
    reflection = np.stack([wave(0.2, 0.5, 3), wave(0.5, 0.2, 4), wave(-0.4, 0.6, 5)], axis=-1) * 1.4
    shadow = np.where((x + 2 * y) % 29 < 9, 0.0, 1.0)
    shadow = np.where((x + 2 * y) % 29 == 9, 0.35, shadow)
    return dict(
        color=color, depth=depth, shadow=shadow, reflection=reflection, surface_depth=surface,
        surface_normal=normal, view=view, projection=projection, up=np.array([0.0, 0.0, 1.0]),
        sun_direction=normalized(np.array([0.27, 0.86, 0.30])), sun_color=np.array([1.0, 0.93, 0.82]),
    )


PLANES = ("color", "depth", "shadow", "reflection", "surface_depth", "surface_normal")


def write_fixture(path):
    plate = made_up_plate()
    for key in PLANES:  # computed from the rounded values of the file
        plate[key] = plate[key].astype("<f4").astype(np.float64)
    beauty = realistic(plate)
    height, width = plate["depth"].shape
    with open(path, "wb") as out:
        out.write(b"limpid-1" + struct.pack("<ii", width, height))
        for key in ("view", "projection", "up", "sun_direction", "sun_color"):
            out.write(plate[key].astype("<f8").tobytes())
        for image in [plate[key] for key in PLANES] + [beauty]:
            planes = image[..., None] if image.ndim == 2 else image
            out.write(np.moveaxis(planes, -1, 0).astype("<f4").tobytes())
    wet = np.isfinite(plate["surface_depth"]) & (plate["surface_depth"] < plate["depth"])
    print(f"{path}: {width}x{height}, {wet.mean():.0%} wet, beauty 0 .. {beauty.max():.3f}")


def read_exr(path, channels):
    """Planes of an EXR file, which oiiotool first converts to an uncompressed EXR of floats."""
    with tempfile.TemporaryDirectory() as folder:
        plain = pathlib.Path(folder) / "plain.exr"
        subprocess.run(["oiiotool", str(path), "--ch", ",".join(channels), "-d", "float",
                        "--scanline", "--compression", "none", "-o", str(plain)], check=True)
        data = plain.read_bytes()
    at, header = 8, {}
    while data[at]:
        name, kind = (s.decode() for s in data[at:at + 300].split(b"\0")[:2])
        at += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    stored, rest = [], header["channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        assert rest[:4] == b"\2\0\0\0", "not a float channel"
        stored.append(name.decode())
        rest = rest[16:]
    body = np.frombuffer(data, np.uint8, offset=at + 1 + 8 * height)
    rows = body.reshape(height, 8 + 4 * width * len(stored))[:, 8:].copy()
    planes = rows.view("<f4").reshape(height, len(stored), width).astype(np.float64)
    picked = np.stack([planes[:, stored.index(c)] for c in channels], axis=-1)
    return picked[..., 0] if len(channels) == 1 else picked


def read_lagoon(folder):
    folder = pathlib.Path(folder)
    text = (folder / "lagoon.toml").read_text()

    def numbers(key):
        value = re.search(rf"^{key} *= *(\[.*\])", text, re.M).group(1)
        return np.array(eval(value, {}), dtype=np.float64)

    def far_to_inf(z):
        return np.where(z >= 1e9, np.inf, z)

    return dict(
        color=read_exr(folder / "dry_color.exr", "RGB"),
        depth=far_to_inf(read_exr(folder / "dry_depth.exr", "Z")),
        shadow=read_exr(folder / "shadow.exr", "Y"),
        reflection=read_exr(folder / "reflection.exr", "RGB"),
        surface_depth=far_to_inf(read_exr(folder / "water_depth.exr", "Z")),
        surface_normal=read_exr(folder / "water_normal_waves.exr", "XYZ"),
        view=numbers("view"), projection=numbers("projection"), up=numbers("up"),
        sun_direction=numbers("direction"), sun_color=numbers("color"),
    )


def main(arguments):
    if len(arguments) == 2 and arguments[0] == "fixture":
        write_fixture(arguments[1])
    elif len(arguments) == 3 and arguments[0] == "lagoon":
        np.save(arguments[2], realistic(read_lagoon(arguments[1])))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
