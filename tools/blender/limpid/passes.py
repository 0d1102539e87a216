"""The passes of a frame: what each shows, and how the scene is set up for it.

A pass is a function of the studio that renders one EXR; what it sets is put back after it."""
import math

import bpy

from .changes import Changes
from .lens import Overscan
from .sight import seen_through, set_numbers

FEW = 16  # samples of what is nearly without noise
CLEAR = 256  # surfaces that a camera may see through, one behind the other
LEAST_AROUND, MOST_AROUND = 256, 2048  # pixels around the horizon


def _few_samples(studio, changes, count=FEW):
    changes.set(studio.scene.cycles, "samples", min(count, studio.samples))
    changes.set(studio.scene.cycles, "use_denoising", False)


def _without_disc(studio, changes):
    """What is mirrored has no sun in it: the highlight is limpid's."""
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
    """The scene without its water: color, depth, and what of the color is the sun's."""
    with Changes() as changes:
        changes.set(studio.scene.cycles, "samples", studio.samples)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def mirror(studio, path, overscan):
    """What a flat mirror in the water shows at each pixel, and how far it is."""
    with Changes() as changes:
        changes.set(studio.scene.cycles, "samples", studio.samples)
        changes.set(studio.scene.cycles, "transparent_max_bounces", CLEAR)
        changes.set(studio.scene.render, "film_transparent", False)
        _without_disc(studio, changes)
        set_numbers(studio.cut, side=-1, height=studio.height, spare=0, hold=1)
        seen_through(studio.cut, studio.materials, changes)
        studio.aim(studio.size, overscan, mirrored=True)
        studio.render(path, overscan)


def below(studio, path, overscan):
    """The dry scene without what stands above the water, lit and shaded as it was. Of that a strip of two pixels
    is left: what is looked up next to the waterline is then a thing that stands in the water, and not what is
    behind it."""
    with Changes() as changes:
        changes.set(studio.scene.cycles, "samples", studio.samples)
        changes.set(studio.scene.cycles, "transparent_max_bounces", CLEAR)
        strip = 2 * studio.pixel
        is_flat = studio.source.data.type == "ORTHO"
        set_numbers(studio.cut, side=1, height=studio.crest + strip * is_flat, spare=strip * (not is_flat), hold=0)
        seen_through(studio.cut, studio.materials, changes)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def shadow(studio, path, overscan):
    """Where the sun reaches the dry scene."""
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
    """The water alone: its depth, and where the sun reaches it, past all that casts a shadow."""
    with Changes() as changes:
        _few_samples(studio, changes, FEW if studio.sun else 1)
        if studio.sun:
            _only_the_sun(studio, changes)
        _water_alone(studio, changes)
        changes.set(studio.sheet, "visible_shadow", False)
        studio.aim(studio.size, overscan)
        studio.render(path, overscan)


def waves(studio, path, overscan):
    """The normals of the water alone. They are those of what it scatters light by: of a plain gray."""
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
    """The dry scene, or the water alone, small and coarse: for its depth."""
    with Changes() as changes:
        _few_samples(studio, changes, 1)
        changes.set(studio.scene, "world", None)
        if water:
            _water_alone(studio, changes)
        studio.aim(size, Overscan())
        studio.render(path, Overscan())


def surroundings(studio, path):
    """The world as far as it lights the scene, all around: its middle looks along x, as limpid wants it."""
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
            # The kind of panorama is the camera's own since 4.5, before it was Cycles'.
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
