"""The parts of the add-on that need no Blender."""
import math
import os
import pathlib
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import tomllib
import unittest

import numpy as np
import OpenImageIO as oiio

ADD_ON = pathlib.Path(os.environ["LIMPID_ADD_ON"])
DATA = pathlib.Path(os.environ["LIMPID_TEST_DATA"])
sys.path.insert(0, str(ADD_ON))

from limpid.changes import Changes  # noqa: E402
from limpid.exr_window import place  # noqa: E402
from limpid.frames import camera_at, frames_of, neighbor_of, numbered  # noqa: E402
from limpid.job import Job  # noqa: E402
from limpid.lens import Lens, Overscan, widened  # noqa: E402
from limpid.lines import lines_of  # noqa: E402
from limpid.overscan import asked_for, largest, sampled, small  # noqa: E402
from limpid.run import Run  # noqa: E402
from limpid.scene_file import SceneFacts, files_of, plates_of, scene_text  # noqa: E402
from limpid.tool import find_tool, last_sentence, look_names, run_tool  # noqa: E402
from limpid.words import Failure  # noqa: E402


class InAFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def program(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)


class Frames(unittest.TestCase):
    def test_ranges(self):
        self.assertEqual(frames_of("3"), [3])
        self.assertEqual(frames_of("1-7x3, 2,4-5"), [1, 4, 7, 2, 5])
        self.assertEqual(numbered("dry", 7), "dry.0007")
        self.assertEqual(numbered("dry", 12345), "dry.12345")

    def test_what_is_refused(self):
        for text in ("", "a", "3-1", "1-4x0", "1..4", "1-999999", "-3"):
            with self.assertRaisesRegex(Failure, f"frames '{text}': expected"):
                frames_of(text)

    def test_neighbors(self):
        self.assertEqual([neighbor_of(5, motion) for motion in ("next", "previous")], [6, 4])

    def test_markers_bind_cameras(self):
        bound = [(10, "b"), (1, "a")]
        self.assertEqual([camera_at(frame, bound) for frame in (0, 1, 9, 10, 50)], ["a", "a", "a", "b", "b"])
        self.assertIsNone(camera_at(3, []))


def viewplane(lens, size, aspect):
    """Left, right, bottom, top of what a pixel's width is 1 of the sensor's pitch in, in mm: by Blender's own rule."""
    width, height = size[0], size[1] * aspect[1] / aspect[0]
    across = lens.sensor_fit == "HORIZONTAL" or (lens.sensor_fit == "AUTO" and width >= height)
    fitted = width if across else height
    pitch = (lens.sensor_height if lens.sensor_fit == "VERTICAL" else lens.sensor_width) / fitted
    x, y = lens.shift_x * fitted, lens.shift_y * fitted
    return [pitch * side for side in (x - width / 2, x + width / 2, y - height / 2, y + height / 2)]


class Lenses(unittest.TestCase):
    def test_a_wider_lens_shows_the_same_and_more(self):
        overscan = Overscan(3, 11, 20, 5)
        for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
            for size in ((160, 90), (90, 160)):
                for aspect in ((1, 1), (2, 1), (1, 1.5)):
                    lens = Lens(fit, 36, 24, 5, .1, -.2)
                    before = viewplane(lens, size, aspect)
                    after = viewplane(widened(lens, size, aspect, overscan), overscan.around(size), aspect)
                    pitch = (before[1] - before[0]) / size[0]
                    tall = pitch * aspect[1] / aspect[0]
                    wanted = [before[0] - 3 * pitch, before[1] + 11 * pitch, before[2] - 5 * tall, before[3] + 20 * tall]
                    for one, other in zip(after, wanted):
                        self.assertAlmostEqual(one, other, places=9, msg=f"{fit} {size} {aspect}")

    def test_an_orthographic_width_grows_with_the_picture(self):
        self.assertAlmostEqual(widened(Lens("AUTO", 36, 24, 5, 0, 0), (100, 50), (1, 1), Overscan(10, 10)).ortho_scale, 6)


class Windows(InAFolder):
    def copy(self, name="blender_multilayer_half_zip.exr"):
        return shutil.copy(DATA / "exr" / name, self.folder / "plate.exr")

    def read(self, path):
        picture = oiio.ImageInput.open(str(path))
        self.addCleanup(picture.close)
        return picture.read_image(oiio.FLOAT), picture.spec()

    def test_the_picture_lies_in_its_overscan_and_no_pixel_changes(self):
        for name in ("blender_multilayer_half_zip.exr", "blender_float_zip_rgbaz.exr"):
            path = self.copy(name)
            pixels, spec = self.read(path)
            place(path, Overscan(3, 2, 5, 1))
            pixels_after, spec_after = self.read(path)
            self.assertTrue(np.array_equal(pixels_after, pixels, equal_nan=True))
            self.assertEqual((spec_after.x, spec_after.y, spec_after.width, spec_after.height),
                             (-3, -5, spec.width, spec.height))
            self.assertEqual((spec_after.full_x, spec_after.full_y, spec_after.full_width, spec_after.full_height),
                             (0, 0, spec.width - 5, spec.height - 6))

    def test_what_is_no_plate_of_blenders_is_refused(self):
        for name in ("oiio_multipart.exr", "oiio_tiled_rgbz_noalpha.exr"):
            with self.assertRaisesRegex(Failure, "plate.exr: cannot be given its overscan: expected an EXR of one part"):
                place(self.copy(name), Overscan())
        path = self.copy()
        with self.assertRaisesRegex(Failure, "are fewer than the overscan"):
            place(path, Overscan(9999, 9999))
        pathlib.Path(path).write_bytes(pathlib.Path(path).read_bytes()[:300])
        with self.assertRaisesRegex(Failure, "it is truncated"):
            place(path, Overscan())


class SceneFiles(unittest.TestCase):
    def test_what_is_told_is_read(self):
        eye = [[1, 0, 0, 0], [0, 1e-8, 0, 0], [0, 0, 1, -5.25], [0, 0, 0, 1]]
        facts = SceneFacts(view=eye, projection=eye, near=.1, far=math.inf, height=-.5, time=.25,
                           sun_direction=(0, .6, .8), sun_color=(1, 2, 3), sun_diameter=200, sky=(.1, .2, .3),
                           plates={"color": 'odd "name"\\\t.exr:ViewLayer.Combined'})
        read = tomllib.loads(scene_text(facts, "Frame 1"))
        self.assertEqual(read["camera"]["view"], eye)
        self.assertEqual((read["camera"]["far"], read["camera"]["depth"]), (math.inf, "eye"))
        self.assertEqual(read["water"], {"up": [0, 0, 1], "height": -.5})
        self.assertEqual(read["sun"], {"direction": [0, .6, .8], "color": [1, 2, 3], "diameter": 90})
        self.assertEqual(read["sky"]["radiance"], [.1, .2, .3])
        self.assertEqual(read["scene"]["time"], .25)
        self.assertEqual(read["plates"]["color"], 'odd "name"\\\t.exr:ViewLayer.Combined')

    def test_without_sun_and_sky_there_is_no_table_of_them(self):
        read = tomllib.loads(scene_text(SceneFacts([[0]], [[0]], .1, 10, 0), "Frame 1"))
        self.assertEqual(sorted(read), ["camera", "plates", "scene", "water"])

    def test_each_pass_feeds_its_buffers(self):
        plates = plates_of(["dry", "sun", "surface_shadow", "mirror"], lambda name: f"{name}.exr", "sky.exr")
        self.assertEqual(plates["sun_color"], "dry.exr:ViewLayer.Combined_sun")
        self.assertEqual(plates["surface_shadow"], "surface.exr:ViewLayer.Combined.R")
        self.assertEqual(plates["reflection_valid"], "mirror.exr:ViewLayer.Combined.A")
        self.assertEqual(plates["environment"], "sky.exr")
        self.assertNotIn("below_color", plates)
        self.assertEqual(files_of(["dry", "sun", "surface_shadow", "surface"]), ["dry", "surface"])


class Overscans(unittest.TestCase):
    PLAN = ("reads color, depth\nthe refracted rays of 5.8 % of the wet pixels leave the picture; overscan of color and "
            "depth by 4 pixels on the left, 2 on the right and 24 at the bottom would show where they end\n")

    def test_the_plan_of_a_small_picture_is_scaled(self):
        self.assertEqual(small((1920, 1080)), (240, 135))
        self.assertEqual(small((100, 50)), (100, 50))
        self.assertEqual(asked_for(self.PLAN, (240, 135), (1920, 1080)), Overscan(36, 18, 0, 212))
        self.assertEqual(asked_for(self.PLAN, (40, 20), (40, 20)).bottom, 20)  # half of the picture at most
        self.assertEqual(asked_for("no refracted ray leaves the picture\n", (240, 135), (480, 270)), Overscan())

    def test_several_frames(self):
        self.assertEqual(largest([Overscan(1, 5, 0, 2), Overscan(3, 1, 0, 9)]), Overscan(3, 5, 0, 9))
        self.assertEqual(sampled(range(1, 101)), [1, 26, 51, 75, 100])
        self.assertEqual(sampled([4, 8]), [4, 8])


class Lines(unittest.TestCase):
    def test_no_line_is_wider_than_the_panel_and_no_letter_is_lost(self):
        self.assertEqual(lines_of("", 9, len), [""])
        self.assertEqual(lines_of("no sun: expected one", 9, len), ["no sun:", "expected", "one"])
        self.assertEqual(lines_of("in /a/long/folder now", 9, len), ["in", "/a/long/f", "older now"])
        self.assertEqual(lines_of("abc", 0, len), ["a", "b", "c"])


class Tools(InAFolder):
    def test_where_it_is(self):
        tool = self.program("bin/limpid", "exit 0\n")
        self.assertEqual(find_tool(tool), tool)
        with self.assertRaisesRegex(Failure, "no program at 'nowhere'"):
            find_tool("nowhere")
        before = os.environ["PATH"]
        self.addCleanup(os.environ.__setitem__, "PATH", before)
        os.environ["PATH"] = str(self.folder / "bin")
        self.assertEqual(find_tool(), tool)
        os.environ["PATH"] = str(self.folder)
        with self.assertRaisesRegex(Failure, "limpid is not on PATH"):
            find_tool()

    def test_looks_by_the_verb_else_of_the_folder(self):
        with_verb = self.program("new/bin/limpid", "printf 'Looks: ways\\n  calm      a lake\\n  physical  by\\n'\n")
        self.assertEqual(look_names(with_verb), ["physical", "calm"])
        without = self.program("old/bin/limpid", "exit 2\n")
        looks = self.folder / "old/share/limpid/looks"
        looks.mkdir(parents=True)
        for name in ("physical", "fast"):
            (looks / f"{name}.toml").write_text("")
        self.assertEqual(look_names(without), ["physical", "fast"])
        self.assertIn("physical", look_names(os.environ["LIMPID_TOOL"]))

    def test_its_sentence_and_its_warnings(self):
        log = []
        good = self.program("good", "echo plan; echo 'limpid: warning: it is dry' >&2\n")
        self.assertEqual(run_tool([good], log.append), ("plan\n", ["it is dry"]))
        self.assertIn("it is dry", log[0])
        bad = self.program("bad", "echo 'limpid ERROR: wave.exr: no depth' >&2; exit 1\n")
        with self.assertRaisesRegex(Failure, "^wave.exr: no depth$"):
            run_tool([bad], log.append)
        with self.assertRaisesRegex(Failure, "ended with status 3 and no message"):
            run_tool([self.program("mute", "exit 3\n")], log.append)
        self.assertEqual(last_sentence("one\nlimpid: two\n\n"), "two")


class Runs(InAFolder):
    def run_of(self, text):
        return Run([self.program("job", text)], self.folder / "log")

    def test_what_it_says(self):
        run = self.run_of("echo Fra:1; echo 'limpid job step: 1/4 frame 1: dry'; echo 'limpid job warning: dry'; "
                          "echo 'limpid: warning: not the job s'; echo 'limpid job wet: 1'\n")
        run.wait()
        self.assertEqual((run.text, run.share, run.warnings, run.wet, run.failure()),
                         ("frame 1: dry", .25, ["dry"], [1], None))
        self.assertIn("Fra:1", (self.folder / "log").read_text())

    def test_how_it_fails(self):
        run = self.run_of("echo 'limpid job error: no sun'; exit 1\n")
        run.wait()
        self.assertEqual(run.failure(), "no sun")
        run = self.run_of("exit 7\n")
        run.wait()
        self.assertRegex(run.failure(), "the second Blender ended with status 7; see .*log")
        run = self.run_of("kill -SEGV $$\n")
        run.wait()
        self.assertIn(f"was ended by signal {int(signal.SIGSEGV)}", run.failure())

    def test_cancelled_it_ends_with_all_that_it_started(self):
        run = self.run_of("echo 'limpid job wet: 1'; sh -c 'echo $$ >child; exec sleep 600' & wait\n".replace(
            ">child", f">{self.folder}/child"))
        while not run.wet or not (self.folder / "child").exists() or not (self.folder / "child").read_text().strip():
            self.assertTrue(run.is_running())
        run.cancel()
        run.wait()  # the log's end comes when the last of them has ended
        self.assertEqual(run.failure(), "cancelled: 1 frame finished")


class Jobs(InAFolder):
    def test_it_is_read_as_it_was_written(self):
        job = Job("limpid", "physical", "out", "Scene", "ViewLayer", [1, 2], ["a.b=1"], water="see", overscan=4)
        job.write(self.folder / "job.json")
        self.assertEqual(Job.read(self.folder / "job.json"), job)


class ChangesAreUndone(unittest.TestCase):
    def test_after_an_error_too(self):
        thing = type("Thing", (), {"x": 1})()
        with self.assertRaises(ZeroDivisionError), Changes() as changes:
            changes.set(thing, "x", 2)
            changes.set(thing, "x", 3)
            self.assertEqual(thing.x, 3)
            1 / 0
        self.assertEqual(thing.x, 1)


class Zip(InAFolder):
    def test_the_same_bytes_and_all_files(self):
        made = []
        for folder in ("a", "b"):
            said = subprocess.run([sys.executable, ADD_ON / "make_zip", self.folder / folder], capture_output=True,
                                  text=True, check=True).stdout.strip()
            made.append(pathlib.Path(said).read_bytes())
        self.assertEqual(made[0], made[1])
        self.assertRegex(said, r"limpid-blender-\d+\.\d+\.\d+\.zip$")
        shutil.unpack_archive(said, self.folder)
        for file in (ADD_ON / "limpid").glob("*.py"):
            self.assertEqual((self.folder / "limpid_blender" / file.name).read_bytes(), file.read_bytes())


if __name__ == "__main__":
    unittest.main()
