"""The work of the second process: renders the plates of a job and runs limpid on them."""
import dataclasses
import os
import pathlib
import sys
import tempfile

from . import overscan as over
from . import passes
from .frames import counted, neighbor_of, numbered
from .job import MARK, Job
from .lens import Overscan
from .scene_file import files_of, plates_of, scene_text
from .studio import Studio
from .tool import run_tool
from .words import Failure


def say(kind, text):
    print(f"{MARK}{kind}: {' '.join(text.split())}", flush=True)


class Steps:
    """Counts the finished steps of a job, for a line of progress."""

    def __init__(self, total):
        self.total, self.done = total, 0

    def next(self, text):
        say("step", f"{self.done}/{self.total} {text}")
        self.done += 1


def passes_of(job, is_under_water):
    """Names of the passes of a frame, in the order of rendering."""
    names = ["dry"] + ["sun"] * bool(job.sun)
    if job.sun and job.shadow:
        names += ["shadow", "surface_shadow"]
    if job.water:
        names += ["surface"] + ["waves"] * (job.waves == "OBJECT")
    if not is_under_water:  # under water there is no reflection and no layer below
        names += ["mirror"] * job.reflection + ["below"] * job.below
    return names


RENDERED = {"dry": passes.dry, "shadow": passes.shadow, "surface": passes.surface, "mirror": passes.mirror,
            "below": passes.below, "waves": passes.waves}


class Work:
    def __init__(self, job):
        self.job, self.folder, self.unfinished = job, pathlib.Path(job.folder), pathlib.Path(job.unfinished)
        self.studio = Studio(job)
        self.warned = set()
        self.facts, self.under_water = {}, set()  # of the frames whose plates are there

    def warn(self, text):
        if text not in self.warned:
            self.warned.add(text)
            say("warning", text)

    def limpid(self, *words):
        """Runs the tool; returns its output, and reports its warnings."""
        return run_tool([self.job.tool, *map(str, words)], lambda text: print(text, flush=True))

    def look(self):
        return ["--look", self.job.look, *(word for setting in self.job.settings for word in ("--set", setting))]

    # ---- overscan

    def tested(self):
        """Checks frames by a small test render, which finds errors and the overscan."""
        return over.sampled(self.job.frames) if self.job.overscan < 0 else self.job.frames[:1]

    def overscan(self, steps):
        asked = []
        for frame in self.tested():
            steps.next(f"frame {frame}: a small test")
            with tempfile.TemporaryDirectory() as folder:
                asked.append(self._asked_for(frame, pathlib.Path(folder)))
        return Overscan(*[self.job.overscan] * 4) if self.job.overscan >= 0 else over.largest(asked)

    def _asked_for(self, frame, folder):
        studio, size = self.studio, over.small(self.studio.size)
        facts = studio.at(frame)
        names = ["dry"] + ["surface"] * bool(self.job.water)
        for name in names:
            passes.test_plate(studio, str(folder / f"{name}.exr"), size, name == "surface")
        facts.plates = plates_of(names, lambda name: f"{name}.exr")
        (folder / "test.toml").write_text(scene_text(facts, "A test render, for its overscan"))
        plan, _ = self.limpid("plan", "--scene", folder / "test.toml", *self.look())
        return over.asked_for(plan, size, studio.size)

    # ---- frames

    def plates(self, frame, overscan, steps):
        """Renders the plates of a frame, and replaces those of an earlier job when all of them are there: a cancelled render leaves
        no plates of two jobs."""
        studio = self.studio
        facts = studio.at(frame)
        under = studio.is_under_water()
        if under:
            self.under_water.add(frame)
            self.warn("the camera is under water: reflection and layer below are not rendered")
        names = passes_of(self.job, under)
        (self.folder / "plates").mkdir(exist_ok=True)
        made = {name: f"plates/{numbered(name, frame)}.exr" for name in files_of(names)}
        for name, plate in made.items():
            steps.next(f"frame {frame}: {name}")
            RENDERED[name](studio, str(self.unfinished / plate), overscan)
        environment = None
        if self.job.surroundings and facts.sky is None:
            steps.next(f"frame {frame}: surroundings")
            made["surroundings"] = environment = f"plates/{numbered('surroundings', frame)}.exr"
            passes.surroundings(studio, str(self.unfinished / environment))
        for plate in made.values():
            os.replace(self.unfinished / plate, self.folder / plate)
        facts.plates = plates_of(names, made.get, environment)
        if not self.job.surroundings:
            facts.sky = None
        self._write_scene(self.folder, frame, facts)
        self.facts[frame] = facts

    def _write_scene(self, folder, frame, facts):
        about = f"Frame {frame} of {self.studio.scene.name}"
        (folder / f"{numbered('scene', frame)}.toml").write_text(scene_text(facts, about))

    def _pair(self, frame):
        """Writes the scenes of the frame and of the one that its motion vectors lead to, of which a frame without plates
        has camera and water alone. Returns whether there can be vectors."""
        neighbor = neighbor_of(frame, self.job.motion)
        other = self.facts.get(neighbor)
        under = {frame, neighbor} & self.under_water
        if other is None and neighbor >= 0:
            other = self.studio.at(neighbor)
            under = under or self.studio.is_under_water()
        if other is None or under:
            self.warn(f"no motion vectors of frame {frame}: " + ("the camera is under water, in it or in the "
                      f"{self.job.motion} one" if under else "there is no frame before it"))
            return False
        for number, facts in ((frame, self.facts[frame]), (neighbor, other)):
            plates = {role: f"../{name}" for role, name in facts.plates.items()}
            self._write_scene(self.unfinished, number, dataclasses.replace(facts, plates=plates))
        return True

    def water(self, frame, steps):
        steps.next(f"frame {frame}: water")
        aovs = ["all"] * self.job.aovs
        words = ["--scene", self.folder / f"{numbered('scene', frame)}.toml"]
        if self.job.motion and self._pair(frame):
            words = ["--scene", self.unfinished / "scene.####.toml", "--frames", frame, "--motion-to", self.job.motion]
            aovs += ["motion", "motion_reflected"]
        _, warnings = self.limpid("composite", *words, *self.look(), *(word for aov in aovs for word in ("--aov", aov)),
                                  "-o", self.folder / f"{numbered('wet', frame)}.exr")
        for warning in warnings:
            self.warn(warning)
        say("wet", f"{frame}")

    def run(self):
        job = self.job
        each = len(files_of(passes_of(job, False))) + 1 + int(job.surroundings)
        steps = Steps(len(self.tested()) + each * len(job.frames))
        overscan = self.overscan(steps)
        sides = [f"{pixels} {side}" for side, pixels in vars(overscan).items() if pixels]
        say("note", f"overscan in pixels: {', '.join(sides) or 'none'}")
        waiting = []
        for frame, after in zip(job.frames, [*job.frames[1:], None]):
            self.plates(frame, overscan, steps)
            waiting.append(frame)
            # The water of a frame waits for the plates of the one that its motion vectors lead to.
            is_early = job.motion and after == neighbor_of(frame, job.motion)
            for ready in waiting[:-1] if is_early else waiting:
                self.water(ready, steps)
            waiting = waiting[-1:] if is_early else []
        say("done", f"{counted(len(job.frames))} in {job.folder}")


def main():
    try:
        Work(Job.read(sys.argv[sys.argv.index("--") + 1])).run()
    except Failure as failure:
        say("error", str(failure))
        sys.exit(1)
    except OSError as fault:
        say("error", f"{fault.filename}: {fault.strerror}")
        sys.exit(1)
