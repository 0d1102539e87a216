"""What the tests in Blender share: an installed add-on, scenes, and a way to run Python in them."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
BLENDER, TOOL = os.environ["BLENDER"], os.environ["LIMPID_TOOL"]
MARK = "answer: "

# What each script can use: say(value) hands a value to the test, wet() presses the button and gives its sentence back.
START = f"""
import json, pathlib, sys
sys.path.insert(0, {str(HERE)!r})
import bpy
scene = bpy.context.scene
settings = scene.limpid
def say(value):
    print({MARK!r} + json.dumps(value), flush=True)
def wet(**how):
    try:
        return sorted(bpy.ops.limpid.wet(**how))[0]
    except RuntimeError as failure:
        return str(failure).strip()
"""


class InBlender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        said = subprocess.run([sys.executable, pathlib.Path(os.environ["LIMPID_ADD_ON"]) / "make_zip", cls.folder],
                              capture_output=True, text=True, check=True).stdout.strip()
        shutil.unpack_archive(said, cls.folder / "scripts/addons")
        for kind in ("config", "temporary"):
            (cls.folder / kind).mkdir()
        cls.environment = dict(os.environ, BLENDER_USER_SCRIPTS=str(cls.folder / "scripts"),
                               BLENDER_USER_CONFIG=str(cls.folder / "config"), TMPDIR=str(cls.folder / "temporary"),
                               PATH=f"{pathlib.Path(TOOL).parent}:{os.environ['PATH']}", BROWSER="true")

    def blender(self, *words, code=0, environment=None):
        run = subprocess.run([BLENDER, "-b", "--factory-startup", *map(str, words)], capture_output=True, text=True,
                             env=environment or self.environment)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    @classmethod
    def scene(cls, name):
        """A file with the scene of that name in a folder of its own."""
        path = cls.folder / name / f"{name}.blend"
        if not path.exists():
            path.parent.mkdir()
            subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "-P", HERE / "scenes.py", "--",
                            name, path], check=True, capture_output=True, env=cls.environment)
        return path

    def said(self, file, script, environment=None):
        """Values that a script in a file says."""
        path = self.folder / "script.py"
        path.write_text(START + script)
        printed = self.blender("--addons", "limpid_blender", *([file] if file else []), "--python-exit-code", 1, "-P", path,
                               environment=environment)
        return [json.loads(line[len(MARK):]) for line in printed.splitlines() if line.startswith(MARK)]
