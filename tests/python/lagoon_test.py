"""Arrays as OpenImageIO reads them give what the tool makes of the files, to the bit."""
import pathlib
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
                                   environment=read_float(DATA.parent / "maps/sky.hdr"))
            np.testing.assert_array_equal(wet, self.tools(name), err_msg=name)

    def test_maps(self):
        # Without the plate's normals the waves come from the tiling map.
        frame = {name: value for name, value in self.frame.items() if name != "surface_normal"}
        look = limpid.load_look("fast")
        wet = limpid.composite(**frame, look=look, wave_map=read_float(look["wave_normals"]["map"]),
                               environment=read_float(DATA.parent / "maps/sky.hdr"), time=2.5)
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
