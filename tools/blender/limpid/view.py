"""`limpid view` on the rendered plates."""
import os
import pathlib
import subprocess
import sys

from . import preferences
from .frames import numbered
from .begin import folder_of, frames_wanted, settings_of
from .tool import find_tool, last_sentence
from .words import Failure


class Page:
    """The tool, which serves the page until close(), or until Blender ends."""

    def __init__(self, words, log):
        with open(log, "w", encoding="utf-8") as errors:
            watch = [sys.executable, str(pathlib.Path(__file__).with_name("until_closed.py"))]
            self._process = subprocess.Popen([*watch, *words], stdout=subprocess.PIPE, stderr=errors, text=True,
                                             stdin=subprocess.PIPE, start_new_session=True)
        self.address = self._process.stdout.readline().strip()  # printed when the page is ready
        if not self.address:
            self._process.wait()
            with open(log, encoding="utf-8") as errors:
                raise Failure(last_sentence(errors.read()) or "limpid view ended without a message")

    def close(self):
        self._process.stdin.close()
        self._process.wait()


def view(scene, frames="", before=None):
    """Opens the page, then closes the page `before`. Throws Failure without plates, and leaves `before` open."""
    folder, wanted = folder_of(scene.limpid), frames_wanted(scene, frames)
    there = [frame for frame in wanted if os.path.isfile(folder / f"{numbered('scene', frame)}.toml")]
    if not there:
        raise Failure(f"no plates of frame {wanted[0]} in {folder}: press Add water first")
    words = [find_tool(preferences.tool_path()), "view", "--scene", str(folder / "scene.####.toml"),
             "--frames", ",".join(map(str, there)), "--look", scene.limpid.look or "physical",
             *(word for setting in settings_of(scene.limpid) for word in ("--set", setting)), "--folder", str(folder)]
    page = Page(words, folder / "view.log")
    if before:
        before.close()
    return page
