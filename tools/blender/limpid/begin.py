"""The job of the scene's settings, checked before rendering, and its start."""
import os
import pathlib
import shlex
import shutil
import sys
import tempfile

import bpy

from . import preferences
from .frames import frames_of
from .job import Job
from .light import brightest_sun, sun_color
from .run import Run
from .studio import expect_camera
from .tool import find_tool
from .words import Failure


def folder_of(settings):
    """The folder of all outputs."""
    if settings.folder.startswith("//") and not bpy.data.filepath:
        raise Failure("this file was never saved, so '//' names no folder: save the file, or give another folder")
    return pathlib.Path(bpy.path.abspath(settings.folder)).resolve()


def frames_wanted(scene, text=""):
    settings = scene.limpid
    if text:
        return frames_of(text)
    if settings.frames_kind == "CURRENT":
        return frames_of(str(scene.frame_current))
    if settings.frames_kind == "SCENE":
        return frames_of(f"{scene.frame_start}-{scene.frame_end}x{scene.frame_step}")
    return frames_of(settings.frames)


def _water(settings, view_layer):
    if settings.water_kind == "HEIGHT":
        return ""
    water = settings.water
    if water is None:
        raise Failure("no water: pick the water object, or give the height of the water")
    if water.name not in view_layer.objects or view_layer.objects[water.name] != water:
        raise Failure(f"water '{water.name}' is not in the view layer '{view_layer.name}': expected an object of that layer")
    return water.name


def _sun(settings, scene, view_layer):
    if not settings.use_sun:
        return ""
    sun = brightest_sun(view_layer)
    if sun is None:
        raise Failure("no sun: expected a light of the type Sun in the scene, or the setting Sun turned off")
    sun_color(sun.data, scene.cycles.film_exposure)  # refuses a sun of unknown brightness
    return sun.name


def settings_of(settings):
    """The changes of the look, each operator.parameter=value."""
    try:
        return shlex.split(settings.settings)
    except ValueError as fault:
        raise Failure(f"settings '{settings.settings}': {fault}") from fault


def job_of(scene, view_layer, frames=""):
    """Throws Failure for the first error in the settings."""
    settings = scene.limpid
    expect_camera(scene.camera)
    if scene.render.use_multiview:
        raise Failure("the scene is stereoscopic: expected one view (Output > Stereoscopy turned off)")
    return Job(
        tool=find_tool(preferences.tool_path()), look=settings.look or "physical", folder=str(folder_of(settings)),
        scene=scene.name, view_layer=view_layer.name, frames=frames_wanted(scene, frames), settings=settings_of(settings),
        water=_water(settings, view_layer), height=settings.height,
        waves=settings.waves if settings.water_kind == "OBJECT" else "LIMPID", sun=_sun(settings, scene, view_layer),
        reflection=settings.reflection, below=settings.below, shadow=settings.shadow,
        surroundings=settings.surroundings, aovs=settings.aovs,
        motion="" if settings.motion == "NONE" else settings.motion.lower(),
        overscan=settings.overscan if settings.overscan_kind == "FIXED" else -1, samples=settings.samples)


LOOKS = 100  # of .1 s


def _stay_changed():
    """After a copy was saved, Blender takes the file itself for saved, and would end without the question whether to save. It does
    so a moment later; then a step in the undo history marks the file as changed."""
    looks = iter(range(LOOKS))

    def look():
        if bpy.data.is_dirty:
            return 0.1 if next(looks, None) is not None else None
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            bpy.ops.ed.undo_push(message="Before Add water")
        return None

    bpy.app.timers.register(look)


def _copy_into(folder):
    """Saves the file with its unsaved changes, beside a link to the caches with the file's name."""
    own = pathlib.Path(bpy.data.filepath)
    copy = folder / (own.name or "untitled.blend")
    changed = bpy.data.is_dirty and not bpy.app.background
    bpy.ops.wm.save_as_mainfile(filepath=str(copy), copy=True, check_existing=False)
    if changed:
        _stay_changed()
    caches = own.parent / f"blendcache_{own.stem}"
    if bpy.data.filepath and caches.is_dir():
        (folder / caches.name).symlink_to(caches, target_is_directory=True)
    return copy


class Started:
    """A job in a second process, which works on a copy of the file. The copy, the job and all temporary files are in one folder,
    and files that are not finished in another, beside the outputs. finish() removes both, after a cancelled job, too."""

    def __init__(self, job):
        if not bpy.app.binary_path:
            raise Failure("Blender runs as a Python module: expected the program Blender, which renders a copy of the file")
        self.job, folder, self.run, self._own = job, pathlib.Path(job.folder), None, []
        try:
            folder.mkdir(parents=True, exist_ok=True)
            own, job.unfinished = self._make(), str(self._make("unfinished_", folder))
            job.write(own / "job.json")  # not into the folder, which jobs on other machines may share
        except OSError as fault:
            self.finish()
            raise Failure(f"{fault.filename}: {fault.strerror}") from fault
        try:
            scripts = "--enable-autoexec" if bpy.context.preferences.filepaths.use_scripts_auto_execute \
                else "--disable-autoexec"
            factory = ["--factory-startup"] * ("--factory-startup" in sys.argv)
            self.run = Run([bpy.app.binary_path, "--background", *factory, scripts, str(_copy_into(own)),
                            "--python-exit-code", "1", "--python",
                            str(pathlib.Path(__file__).with_name("start_work.py")), "--", str(own / "job.json")],
                           folder / "limpid.log", dict(os.environ, TMPDIR=str(own)))
        except (OSError, RuntimeError) as fault:
            self.finish()
            raise Failure(f"the copy for rendering cannot be saved: {str(fault).strip()}") from fault

    def _make(self, prefix="limpid_", folder=None):
        self._own.append(pathlib.Path(tempfile.mkdtemp(prefix=prefix, dir=folder)))
        return self._own[-1]

    def finish(self):
        """Waits for the end of the process, which writes into these folders."""
        if self.run:
            self.run.wait()
        for folder in self._own:
            shutil.rmtree(folder, ignore_errors=True)
