"""Arrays as OpenImageIO reads them give what the tool makes of the files, to the bit."""
import json
import pathlib
import struct
import subprocess
import tempfile
import unittest

import numpy as np

import limpid
from support import DATA, TOOL, lagoon, read, read_float

AOVS = ["transmitted", "path", "normal"]


class Lagoon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.frame = lagoon()
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)

    def tools(self, look, *more):
        path = pathlib.Path(self.folder.name) / f"{look}.exr"
        subprocess.run([TOOL, "composite", "--scene", DATA / "lagoon/lagoon.toml", "--look", look, "--float",
                        "--compression", "none", "-o", path, *more], check=True, capture_output=True)
        return read(path)

    def test_looks(self):
        for name in ("physical", "realistic", "rito"):
            look = limpid.load_look(name)
            wet = limpid.composite(**self.frame, look=look, wave_map=read_float(look["wave_normals"]["map"]),
                                   environment=read_float(DATA.parent / "maps/sky.exr"))
            np.testing.assert_array_equal(wet, self.tools(name), err_msg=name)

    def test_shader(self):
        path = pathlib.Path(self.folder.name) / "water.comp"
        subprocess.run([TOOL, "shader", "--scene", DATA / "lagoon/lagoon.toml", "--look", "physical", "--main",
                        "compute", "--aov", "path", "-o", path], check=True, capture_output=True)
        told = json.loads(pathlib.Path(f"{path}.json").read_text())
        water = limpid.Compositor(look=limpid.load_look("physical"),
                                  environment=read_float(DATA.parent / "maps/sky.exr"))
        shader = water.shader(**self.frame, stage="compute", aovs=["path"])
        self.assertEqual(shader.text, path.read_text())
        self.assertEqual(shader.id, told["id"])
        self.assertEqual(shader.block, struct.pack(f"{len(told['block']['words'])}I", *told["block"]["words"]))
        self.assertEqual([number.name for number in shader.numbers], [n["name"] for n in told["block"]["numbers"]])
        self.assertEqual([texture.binding for texture in shader.textures], [t["binding"] for t in told["textures"]])
        made = [texture for texture in shader.textures if texture.texels is not None]
        self.assertIn("limpid_environment", [texture.name for texture in made])
        for texture in made:
            pixels = read(f"{path}.{texture.name}.exr").reshape(texture.texels.shape)
            np.testing.assert_array_equal(texture.texels, pixels, err_msg=texture.name)

    def test_maps(self):
        # Without the plate's normals the waves come from the tiling map.
        frame = {name: value for name, value in self.frame.items() if name != "surface_normal"}
        look = limpid.load_look("fast")
        wet = limpid.composite(**frame, look=look, wave_map=read_float(look["wave_normals"]["map"]),
                               environment=read_float(DATA.parent / "maps/sky.exr"), time=2.5)
        expected = self.tools("fast", "--layer", "surface_normal=none", "--time", "2.5")
        np.testing.assert_array_equal(wet, expected)

    def test_aovs(self):
        expected = self.tools("realistic", "--aov", ",".join(AOVS))
        wet, aovs = limpid.composite(**self.frame, look=limpid.load_look("realistic"), aovs=AOVS)
        made = [wet] + [aovs[name].reshape(wet.shape[:2] + (-1,)) for name in AOVS]
        self.assertEqual(sorted(map(tuple, np.concatenate(made, 2).reshape(-1, 11).T.tolist())),
                         sorted(map(tuple, expected.reshape(-1, 11).T.tolist())))


if __name__ == "__main__":
    unittest.main()
