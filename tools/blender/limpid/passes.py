"""The passes of a frame: the content of each, and the setup of the scene for it.

A pass is a function of the studio that renders one EXR; it restores its settings afterwards."""
import math
import pathlib

import bpy

from .changes import Changes
from .lens import Overscan
from .sight import seen_through, set_numbers

FEW = 16  # samples of passes with little noise
CLEAR = 256  # surfaces that a camera may see through, one behind the other
LEAST_AROUND, MOST_AROUND = 256, 2048  # pixels around the horizon


def _few_samples(studio, changes, count=FEW):
    changes.set(studio.scene.cycles, "samples", min(count, studio.samples))
    changes.set(studio.scene.cycles, "use_denoising", False)


def _without_disc(studio, changes):
    """Removes the sun from the reflection: limpid adds the highlight."""
    world = studio.scene.world
    for node in world.node_tree.nodes if world and world.node_tree else ():
        if node.type == "TEX_SKY" and node.sky_type not in ("PREETHAM", "HOSEK_WILKIE"):
            changes.set(node, "sun_disc", False)


def _only_the_sun(studio, changes):
    """A white sun of strength pi, and no other light."""
    for thing in bpy.data.objects:
        if thing.type == "LIGHT" and thing != studio.sun:
            changes.set(thing, "hide_render", True)
    lamp = studio.sun.data.copy()
    lamp.animation_data_clear()
    lamp.use_nodes, lamp.color, lamp.energy = False, (1, 1, 1), math.pi
    for name, value in (("exposure", 0.0), ("use_temperature", False)):
        if hasattr(lamp, name):
            setattr(lamp, name, value)
    changes.afterwards(lambda: bpy.data.lights.remove(lamp))
    changes.set(studio.sun, "data", lamp)
    changes.set(studio.scene, "world", None)
    changes.set(studio.scene.cycles, "film_exposure", 1.0)
    changes.set(studio.scene.cycles, "max_bounces", 0)
    direction = studio.towards_sun()
    set_numbers(studio.sunlit, x=direction.x, y=direction.y, z=direction.z)


def dry(studio, path, overscan):
    """The scene without its water: color, depth, and the sun's part of the color."""
    with Changes() as changes:
        changes.set(studio.scene.cycles, "samples", studio.samples)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def mirror(studio, path, overscan):
    """The picture of a flat mirror in the water plane at each pixel, and its depth."""
    with Changes() as changes:
        changes.set(studio.scene.cycles, "samples", studio.samples)
        changes.set(studio.scene.cycles, "transparent_max_bounces", CLEAR)
        changes.set(studio.scene.render, "film_transparent", False)
        _without_disc(studio, changes)
        studio.mark_crossing(studio.height, studio.height)
        set_numbers(studio.cut, side=-1, height=studio.height, spare=0, spare_flat=0, hold=1, waves=0)
        seen_through(studio.cut, studio.materials, changes)
        studio.aim(studio.size, overscan, mirrored=True)
        studio.render(path, overscan)


def _with_depth_of_waves(studio, changes, overscan):
    """Gives the cut a picture of the waves' depth, from the camera of the pass."""
    path = str(pathlib.Path(studio.job.unfinished) / "depth.exr")
    with Changes() as own:
        _few_samples(studio, own, 1)
        own.set(studio.scene, "world", None)
        own.set(studio.scene.cycles, "film_exposure", 1.0)  # the brightness is a depth
        own.set(studio.scene.cycles, "sample_clamp_direct", 0.0)
        _water_alone(studio, own)
        for slot in studio.sheet.material_slots:
            own.set(slot, "material", studio.depth_material)
        studio.write_layers(False)
        own.afterwards(studio.write_layers)
        studio.aim(studio.size, overscan)
        studio.render_all(path)
    image = bpy.data.images.load(path)
    studio.cut.nodes["depth"].image = image
    changes.afterwards(lambda: bpy.data.images.remove(image))


def below(studio, path, overscan):
    """The dry scene without the objects above the water, or above the object's waves, lit and shaded as before. A strip of
    two pixels of objects that the water cuts remains, so that lookups next to the waterline find the object in the water,
    and not the scene behind the object. Objects that lie on the water or above it as a whole, like a leaf, are left out; on
    the object's waves those that lie above its mean height."""
    with Changes() as changes:
        changes.set(studio.scene.cycles, "samples", studio.samples)
        changes.set(studio.scene.cycles, "transparent_max_bounces", CLEAR)
        strip = 2 * studio.pixel
        is_flat = studio.source.data.type == "ORTHO"
        has_waves = studio.job.waves == "OBJECT"
        if has_waves:
            _with_depth_of_waves(studio, changes, overscan)
        studio.mark_crossing(studio.trough, studio.height)  # objects that begin over the mean height float
        set_numbers(studio.cut, side=1, height=studio.crest, spare=strip * (not is_flat), spare_flat=strip * is_flat, hold=0,
                    waves=has_waves)
        seen_through(studio.cut, studio.materials, changes)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def shadow(studio, path, overscan):
    """Visibility of the sun on the dry scene."""
    with Changes() as changes:
        _few_samples(studio, changes)
        _only_the_sun(studio, changes)
        seen_through(studio.sunlit, studio.materials, changes)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def _water_alone(studio, changes):
    for thing in bpy.data.objects:
        changes.set(thing, "visible_camera", thing == studio.sheet)
    changes.set(studio.sheet, "hide_render", False)


def surface(studio, path, overscan):
    """The water alone: its depth, and the visibility of the sun on it, with all objects that cast shadows."""
    with Changes() as changes:
        _few_samples(studio, changes, FEW if studio.sun else 1)
        if studio.sun:
            _only_the_sun(studio, changes)
        _water_alone(studio, changes)
        changes.set(studio.sheet, "visible_shadow", False)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def waves(studio, path, overscan):
    """The normals of the water alone, rendered with a plain gray material."""
    with Changes() as changes:
        _few_samples(studio, changes)
        changes.set(studio.scene, "world", None)
        _water_alone(studio, changes)
        changes.set(studio.layer, "use_pass_normal", True)
        for slot in studio.sheet.material_slots:
            changes.set(slot, "material", studio.plain)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def test_plate(studio, path, size, water):
    """A small, coarse render of the dry scene, or of the water alone: for its depth."""
    with Changes() as changes:
        _few_samples(studio, changes, 1)
        changes.set(studio.scene, "world", None)
        if water:
            _water_alone(studio, changes)
        studio.aim(size, Overscan())
        studio.render(path, Overscan())


def surroundings(studio, path):
    """The world that lights the scene, as a panorama: its middle looks along x, as limpid requires."""
    width = min(MOST_AROUND, max(LEAST_AROUND, 2 * max(studio.size)))
    scene = bpy.data.scenes.new("limpid surroundings")
    camera = bpy.data.objects.new("limpid surroundings", bpy.data.cameras.new("limpid surroundings"))
    try:
        with Changes() as changes:
            _without_disc(studio, changes)
            scene.world = studio.scene.world
            scene.render.engine = "CYCLES"
            scene.cycles.samples, scene.cycles.use_denoising = 4, False
            scene.cycles.device = studio.scene.cycles.device
            scene.cycles.film_exposure = studio.scene.cycles.film_exposure
            scene.collection.objects.link(camera)
            camera.rotation_euler = (math.pi / 2, 0, -math.pi / 2)
            camera.data.type = "PANO"
            # Blender 4.5 moved the kind of panorama from Cycles' settings to the camera.
            kind = camera.data if hasattr(camera.data, "panorama_type") else camera.data.cycles
            kind.panorama_type = "EQUIRECTANGULAR"
            scene.camera = camera
            scene.render.resolution_x, scene.render.resolution_y = width, width // 2
            scene.render.resolution_percentage = 100
            settings = scene.render.image_settings
            settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
            scene.render.filepath = path
            bpy.ops.render.render(write_still=True, scene=scene.name)
    finally:
        bpy.data.cameras.remove(camera.data)
        bpy.data.scenes.remove(scene)
