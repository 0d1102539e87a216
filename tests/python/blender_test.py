"""The recipe for Blender, from a scene of its own and from a file, small and with few samples."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

from support import read

SCRIPT = pathlib.Path(os.environ["LIMPID_EXAMPLES"]) / "blender_wet/wet.py"


class Blender(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def blender(self, *words):
        return subprocess.run([os.environ["BLENDER"], "-b", *map(str, words)], capture_output=True, text=True)

    def wet(self, name, *scene):
        out = self.folder / f"{name}.exr"
        run = self.blender(*scene, "--python-exit-code", 1, "-P", SCRIPT, "--",
                           "--out", out, "--size", "160x90", "--samples", 8)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        for operator in ("refraction", "depth_fog", "water_shadow", "fresnel_reflection", "sun_highlight"):
            self.assertIn(f"{operator:19} kept", run.stdout)
        return out

    def test_a_pool(self):
        out = self.wet("pool")
        picture = read(out)
        self.assertEqual((picture.shape, picture.dtype), ((90, 160, 4), np.float16))
        self.assertTrue(np.isfinite(picture).all())
        # Water takes red from the floor of a middle row, whose tiles have as much of it as of blue.
        floor = picture[55, 35:90, :3].astype(float).mean(0)
        self.assertLess(floor[0], 0.7 * floor[2])
        # The ball, above the water, is as red as it was.
        ball = picture[18:24, 38:45, :3].astype(float).mean((0, 1))
        self.assertGreater(ball[0], 4 * ball[2])
        # The water behind it shows the floor that it hides in the dry picture: without a layer below, stone.
        behind = picture[11:13, 38:50, :3].astype(float).mean((0, 1))
        self.assertLess(behind[0], 0.95 * behind[2])
        preview = read(out.with_suffix(".png"))
        self.assertEqual((preview.shape, preview.dtype), ((90, 160, 4), np.uint8))

    def test_a_file_and_what_it_lacks(self):
        scene = self.folder / "scene.blend"
        make = ("import bpy; bpy.ops.mesh.primitive_plane_add(size=20); bpy.context.object.name = 'water';"
                "bpy.data.lights[0].type = 'SUN'; bpy.ops.wm.save_as_mainfile(filepath=r'%s')" % scene)
        self.assertEqual(self.blender("--factory-startup", "--python-expr", make).returncode, 0)
        picture = read(self.wet("file", scene))
        self.assertTrue(np.isfinite(picture).all())
        lacking = ("import bpy; bpy.data.objects['water'].name = 'floor'; bpy.ops.wm.save_mainfile()")
        self.assertEqual(self.blender(scene, "--python-expr", lacking).returncode, 0)
        run = self.blender(scene, "--python-exit-code", 1, "-P", SCRIPT, "--", "--out", self.folder / "no.exr")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("0 meshes 'water' in the scene, expected one", run.stdout + run.stderr)
        self.assertFalse((self.folder / "no.exr").exists())


if __name__ == "__main__":
    unittest.main()
