"""The example of a sequence, on a lagoon whose waves drift: its frames are the tool's."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from support import DATA, TOOL, read

SCRIPT = pathlib.Path(os.environ["LIMPID_EXAMPLES"]) / "python_sequence/sequence.py"


class Sequence(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        for frame in (7, 8):
            (self.folder / f"dry.{frame:04d}.exr").symlink_to(DATA / "lagoon/dry_color.exr")
        lines = (DATA / "lagoon/lagoon.toml").read_text().splitlines()
        lines = [line.replace('= "', f'= "{DATA}/lagoon/') if ".exr" in line or ".hdr" in line else line
                 for line in lines if not line.startswith("surface_normal")]
        self.scene = self.folder / "lagoon.toml"
        self.scene.write_text("\n".join(lines).replace(f"{DATA}/lagoon/dry_color.exr", "dry.%04d.exr"))

    def run_script(self, *words):
        return subprocess.run([sys.executable, SCRIPT, *map(str, words)], capture_output=True, text=True)

    def test_frames_are_the_tools(self):
        own = self.run_script(self.scene, "--frames", "7-8", "--fps", 2, "--look", "fast",
                              "-o", self.folder / "wet.%04d.exr")
        self.assertEqual(own.returncode, 0, own.stderr)
        self.assertIn("refraction          kept", own.stdout)
        subprocess.run([TOOL, "composite", "--scene", self.scene, "--frames", "7-8", "--fps", "2", "--look", "fast",
                        "-o", self.folder / "tool.%04d.exr"], check=True, capture_output=True)
        frames = [read(self.folder / f"wet.000{frame}.exr") for frame in (7, 8)]
        self.assertEqual(frames[0].dtype, np.float16)
        self.assertTrue(np.any(frames[0] != frames[1]))
        for frame, pixels in zip((7, 8), frames):
            np.testing.assert_array_equal(pixels, read(self.folder / f"tool.000{frame}.exr"))

    def test_what_is_missing_is_said(self):
        gone = self.run_script(self.scene, "--frames", "9-9", "-o", self.folder / "wet.exr")
        self.assertNotEqual(gone.returncode, 0)
        self.assertIn("dry.0009.exr", gone.stderr)
        self.assertNotIn("Traceback", gone.stderr)


if __name__ == "__main__":
    unittest.main()
