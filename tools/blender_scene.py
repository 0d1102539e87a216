"""What the scripts for Blender share: a fresh file with one glTF scene in it."""
import sys

import bpy
import numpy

# The importer of Blender 3.4 uses this name, which the numpy of the same Debian has dropped.
if "bool" not in vars(numpy):
    numpy.bool = bool


def arguments(usage, count):
    """The words behind `--`."""
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if len(words) != count:
        sys.exit(f"usage: blender -b --python-exit-code 1 -P {usage}")
    return words


def import_scene(path):
    """Throws for what Blender's importer refuses."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if bpy.ops.import_scene.gltf(filepath=path) != {"FINISHED"}:
        raise RuntimeError(f"{path}: Blender did not import it")
    cameras = [thing for thing in bpy.data.objects if thing.type == "CAMERA"]
    if not cameras:
        raise RuntimeError(f"{path}: expected a camera")
    bpy.context.scene.camera = cameras[0]


def water():
    """The objects that are the water surface."""
    return [thing for thing in bpy.data.objects
            if (thing.get("limpid") or {}).get("water")]


def render(path, width, height, samples):
    """Renders with Cycles on the CPU to an 8-bit PNG."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False  # the build of Debian has no denoiser
    scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
