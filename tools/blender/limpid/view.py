"""`limpid view` on the rendered plates."""
import os
import subprocess

from . import preferences
from .frames import numbered
from .begin import folder_of, frames_wanted
from .tool import find_tool, last_sentence
from .words import Failure


class Page:
    """The tool that serves the page, until it is closed."""

    def __init__(self, words, log):
        with open(log, "w", encoding="utf-8") as errors:
            self._process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=errors, text=True,
                                             stdin=subprocess.DEVNULL, start_new_session=True)
        self.address = self._process.stdout.readline().strip()  # it comes when the page is there
        if not self.address:
            self._process.wait()
            with open(log, encoding="utf-8") as errors:
                raise Failure(last_sentence(errors.read()) or "limpid view ended and said nothing")

    def close(self):
        if self._process.poll() is None:
            self._process.terminate()
            self._process.wait()


def view(scene, frames="", before=None):
    """Opens the page, and closes the one opened before. Throws Failure if there are no plates yet."""
    folder, wanted = folder_of(scene.limpid), frames_wanted(scene, frames)
    there = [frame for frame in wanted if os.path.isfile(folder / f"{numbered('scene', frame)}.toml")]
    if not there:
        raise Failure(f"no plates of frame {wanted[0]} in {folder}: expected them rendered before")
    words = [find_tool(preferences.tool_path()), "view", "--scene", str(folder / "scene.####.toml"),
             "--frames", ",".join(map(str, there)), "--look", scene.limpid.look or "physical",
             "--folder", str(folder)]
    if before:
        before.close()
    return Page(words, folder / "view.log")
