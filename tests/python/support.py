"""What the tests share: a small made-up pond, and the lagoon as the tool and OpenImageIO see it."""
import os
import pathlib
import tomllib

import numpy as np
import OpenImageIO as oiio

import limpid

TOOL = os.environ["LIMPID_TOOL"]
DATA = pathlib.Path(os.environ["LIMPID_TEST_PLATES"])
WIDTH, HEIGHT = 61, 35


def pond(height=HEIGHT, width=WIDTH, seed=1):
    """Keywords of a frame: a rough bottom under shallow water, a dry strip on the left."""
    random = np.random.default_rng(seed)
    depth = random.uniform(6, 12, (height, width)).astype(np.float32)
    depth[:, : width // 4] = 2
    return {
        "color": random.uniform(0, 2, (height, width, 4)).astype(np.float32),
        "depth": depth,
        "shadow": random.uniform(0, 1, (height, width)).astype(np.float32),
        "reflection": random.uniform(0, 1, (height, width, 3)).astype(np.float32),
        "camera": limpid.Camera(limpid.look_at((0, 2, 5), (0, 0, 0)),
                                limpid.perspective(0.8, width / height, 0.1, 1000)),
        "water": {"up": (0, 1, 0), "height": 0.0},
        "sun": {"direction": (1, 2, -1)},
    }


LOOK = {"wave_normals": {"model": "sines", "waves": [[0.05, 2, 1, 0]]}}


def read(path):
    """The array of a file in the type that it is stored in, as OpenImageIO hands it out."""
    picture = oiio.ImageInput.open(str(path))
    if picture is None:
        raise OSError(oiio.geterror())
    pixels = picture.read_image(picture.spec().format)
    picture.close()
    return pixels


def read_float(path):
    """The first three channels as float32, integers 0 ... 1."""
    return oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)[..., :3]


def lagoon():
    """Keywords of a frame from the plates of the lagoon."""
    folder = DATA / "lagoon"
    scene = tomllib.loads((folder / "lagoon.toml").read_text())
    def plate(role):
        return read(folder / scene["plates"][role].partition(":")[0])
    return {
        "color": plate("color"),
        "depth": plate("depth")[..., 0],
        "shadow": plate("shadow")[..., 0],
        "reflection": plate("reflection")[..., :3],
        "surface_depth": plate("surface_depth")[..., 0],
        "surface_normal": plate("surface_normal")[..., :3],
        "camera": limpid.Camera(scene["camera"]["view"], scene["camera"]["projection"]),
        "water": scene["water"],
        "sun": scene["sun"],
    }
