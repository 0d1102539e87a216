"""One click on three scenes, a sequence, and a linked collection: what the plates and the wet pictures show."""
import tomllib
import unittest

import numpy as np
import OpenImageIO as oiio

from in_blender import InBlender

# Pixels of overscan for all, so that no test depends on a plan.
SMALL = "settings.overscan_kind, settings.overscan, settings.samples = 'FIXED', 8, 4\n"
POOL = "settings.water = bpy.data.objects['water']\n" + SMALL


class Plate:
    """Channels by name, pixels by place in the picture: negative in the overscan."""

    def __init__(self, path):
        picture = oiio.ImageInput.open(str(path))
        self.spec, self.pixels = picture.spec(), picture.read_image(oiio.FLOAT)
        picture.close()

    def channels(self, *names):
        """Rows and columns of the picture alone."""
        at = [list(self.spec.channelnames).index(name) for name in names]
        x, y = self.spec.full_x - self.spec.x, self.spec.full_y - self.spec.y
        return self.pixels[y:y + self.spec.full_height, x:x + self.spec.full_width, at]

    def color(self):
        letters = "RGB"
        own = f"ViewLayer.Combined.{letters[0]}" in self.spec.channelnames
        return self.channels(*(f"ViewLayer.Combined.{letter}" if own else letter for letter in letters))

    def depth(self):
        return self.channels("ViewLayer.Depth.Z")[..., 0]


class Pictures(InBlender):
    def wet(self, name, settings, frames="1", script=""):
        """The folder that one click on a scene fills."""
        scene = self.scene(name)
        (said,) = self.said(scene, script + settings + f"say(wet(frames='{frames}', load=False))")
        self.assertEqual(said, "FINISHED")
        return scene.parent / "limpid"

    def facts(self, folder, frame=1):
        return tomllib.loads((folder / f"scene.{frame:04d}.toml").read_text())

    def pixel_of(self, facts, point):
        """Column and row at which the camera sees a point."""
        clip = np.array(facts["camera"]["projection"]) @ np.array(facts["camera"]["view"]) @ [*point, 1]
        x, y = clip[:2] / clip[3]
        return int((x + 1) / 2 * 160), int((1 - y) / 2 * 90)

    def is_red(self, color):
        return color[0] > 3 * color[2]

    def test_a_pool(self):
        folder = self.wet("pool", POOL)
        facts = self.facts(folder)
        self.assertEqual(set(facts["plates"]), {
            "color", "depth", "sun_color", "shadow", "surface_shadow", "surface_depth", "reflection", "reflection_valid",
            "reflection_depth", "below_color", "below_depth", "environment"})
        dry, mirror, below, shadow, surface = (
            Plate(folder / f"plates/{name}.0001.exr") for name in ("dry", "mirror", "below", "shadow", "surface"))
        self.assertEqual((dry.spec.x, dry.spec.y, dry.spec.width, dry.spec.height), (-8, -8, 176, 106))
        # A point of the ball's front, above the water: where it is seen, and where it is mirrored.
        x, y = self.pixel_of(facts, (-1.6, -.05, .5))
        self.assertTrue(self.is_red(dry.color()[y, x]))
        self.assertFalse(self.is_red(below.color()[y, x]))
        x, y = self.pixel_of(facts, (-1.6, -.05, -.5))
        self.assertTrue(self.is_red(mirror.color()[y, x]))
        view = np.array(facts["camera"]["view"])
        self.assertAlmostEqual(mirror.depth()[y, x], -(view @ (-1.6, -.05, -.5, 1))[2], delta=.1)
        valid = mirror.channels("ViewLayer.Combined.A")[..., 0]
        self.assertEqual(valid[y, x], 1)
        x, y = self.pixel_of(facts, (-1.6, .6, 0))  # within the ball, in the water
        self.assertEqual(valid[y, x], 0)
        # The water's depth, and the sun on it: in the open, and in the ball's shadow.
        lit, dark = self.pixel_of(facts, (.5, 0, 0)), self.pixel_of(facts, (-2.4, 1.2, 0))
        self.assertAlmostEqual(surface.depth()[lit[1], lit[0]], -(view @ (.5, 0, 0, 1))[2], delta=.1)
        sun = surface.channels("ViewLayer.Combined.R")[..., 0]
        self.assertAlmostEqual(sun[lit[1], lit[0]], 1, delta=.02)
        self.assertEqual(sun[dark[1], dark[0]], 0)
        bottom = shadow.channels("ViewLayer.Combined.R")[..., 0]
        # Where a surface faces the sun at a grazing angle, the samples of the sun's disc differ.
        self.assertLess(bottom.max(), 1.3)
        self.assertLess((bottom > 1.02).mean(), .01)
        self.assertGreater((bottom > .9).mean(), .3)
        self.assertGreater((bottom < .1).mean(), .1)
        self.of_the_wet_pool(Plate(folder / "wet.0001.exr"))

    def test_a_sun_before_the_camera_lights_as_much_as_one_behind_it(self):
        script = "sun = next(o for o in bpy.data.objects if o.type == 'LIGHT')\nsun.rotation_euler = (-1.1, 0, .3)\n"
        folder = self.wet("pool", POOL + "settings.below = settings.reflection = settings.aovs = False\n", script=script)
        self.assertGreater(self.facts(folder)["sun"]["direction"][1], .5)  # the camera looks along y
        for name in "shadow", "surface":
            lit = Plate(folder / f"plates/{name}.0001.exr").channels("ViewLayer.Combined.R")[..., 0]
            self.assertGreater((lit > .97).mean(), .25, name)
            self.assertLess(((lit > .1) & (lit < .9)).mean(), .06, name)  # edges of shadows

    def test_leaves_on_the_water_are_not_in_the_layer_below_and_a_post_keeps_a_strip(self):
        script = """level = bpy.data.objects['water'].location.z
leaf = bpy.data.materials.new("leaf")
leaf.use_nodes = True
leaf.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (1, 0, 0, 1)
bpy.ops.mesh.primitive_cylinder_add(radius=.8, depth=.002, location=(.5, 0, level + .004))
bpy.context.object.data.materials.append(leaf)
bpy.ops.mesh.primitive_circle_add(radius=.7, fill_type='NGON', location=(.5, -2, level))
bpy.context.object.data.materials.append(leaf)
"""
        settings = "settings.reflection = settings.shadow = settings.surroundings = settings.aovs = False\n"
        folder = self.wet("pool", POOL + settings, script=script)
        dry, below = (Plate(folder / f"plates/{name}.0001.exr") for name in ("dry", "below"))
        for y in 0, -2:  # over the water, and exactly on it
            x, y = self.pixel_of(self.facts(folder), (.5, y, 0))
            around = slice(y - 1, y + 2), slice(x - 4, x + 5)
            self.assertTrue(all(map(self.is_red, dry.color()[around].reshape(-1, 3))))
            self.assertFalse(any(map(self.is_red, below.color()[around].reshape(-1, 3))))
        x, y = self.pixel_of(self.facts(folder), (1.3, 1.46, 0))  # of the post, at the water
        near = dry.depth()[y, x]
        self.assertAlmostEqual(below.depth()[y - 1, x], near, delta=.2)
        self.assertGreater(below.depth()[y - 4, x], near + .5)

    def of_the_wet_pool(self, wet):
        picture = wet.channels("R", "G", "B").astype(float)
        self.assertEqual(picture.shape, (90, 160, 3))
        self.assertTrue(np.isfinite(picture).all())
        self.assertIn("transmitted.R", wet.spec.channelnames)
        # Water takes red from the floor of a middle row, whose tiles have as much of it as of blue.
        floor = picture[55, 35:90].mean(0)
        self.assertLess(floor[0], .7 * floor[2])
        # The ball, above the water, is as red as it was.
        ball = picture[18:24, 38:45].mean((0, 1))
        self.assertGreater(ball[0], 4 * ball[2])

    def test_motion_vectors_of_a_lake(self):
        settings = SMALL + """settings.water_kind, settings.aovs, settings.look = 'HEIGHT', False, 'pool'
settings.below = settings.shadow = settings.surroundings = False
settings.motion = 'NEXT'
"""
        folder = self.wet("lake", settings, frames="2-3")
        self.assertFalse((folder / "scene.0004.toml").exists())  # of which camera and water were enough
        self.assertEqual(sorted(path.name for path in folder.glob("unfinished_*")), [])
        for frame in (2, 3):
            wet = Plate(folder / f"wet.{frame:04d}.exr")
            (right,), (up,) = (wet.channels(f"motion_forward.{c}").reshape(1, -1) for c in "uv")
            # The camera goes to the right, and all that is near goes to the left.
            self.assertLess(np.median(right[-160 * 10:]), -.5)
            self.assertLess(abs(np.median(up[-160 * 10:])), 1)
            self.assertIn("motion_reflected_forward.u", wet.spec.channelnames)

    def test_a_lake_in_three_frames(self):
        folder = self.wet("lake", SMALL + "settings.water_kind, settings.aovs = 'HEIGHT', False\n"
                          "settings.below = settings.shadow = False\n", frames="1-3")
        eyes = [self.facts(folder, frame)["camera"]["view"][0][3] for frame in (1, 2, 3)]
        self.assertEqual(sorted(eyes, reverse=True), eyes)  # the camera goes to the right
        self.assertEqual(len(set(eyes)), 3)
        facts = self.facts(folder, 2)
        self.assertEqual(set(facts["plates"]), {"color", "depth", "sun_color", "reflection", "reflection_valid",
                                                "reflection_depth"})
        self.assertAlmostEqual(facts["sky"]["radiance"][2], .6, places=6)
        self.assertAlmostEqual(facts["scene"]["time"], 2 / 24)
        pictures = [Plate(folder / f"wet.{frame:04d}.exr").channels("R", "G", "B") for frame in (1, 2, 3)]
        self.assertFalse(np.array_equal(pictures[0], pictures[2]))
        # Matrix and plate agree for a shifted lens that is fitted to the height: the cone's tip is green, and sky beside it.
        dry = Plate(folder / "plates/dry.0002.exr").color()
        x, y = self.pixel_of(facts, (2, 9, 2.8))
        self.assertGreater(dry[y, x][1], dry[y, x][2])
        self.assertGreater(dry[y, x - 4][2], dry[y, x - 4][1])
        mirror = Plate(folder / "plates/mirror.0002.exr").color()
        x, y = self.pixel_of(facts, (2, 9, -2.4))
        self.assertGreater(mirror[y, x][1], mirror[y, x][2])

    def test_a_sea_with_the_objects_waves_by_an_orthographic_camera(self):
        folder = self.wet("sea", SMALL + "settings.water, settings.waves = bpy.data.objects['ocean'], 'OBJECT'\n"
                          "settings.reflection = settings.below = settings.shadow = False\n")
        facts = self.facts(folder)
        self.assertEqual(facts["camera"]["projection"][3], [0, 0, 0, 1])
        self.assertAlmostEqual(facts["water"]["height"], .5, delta=.3)
        self.assertIn("surface_normal", facts["plates"])
        waves = Plate(folder / "plates/waves.0001.exr").channels(*(f"ViewLayer.Normal.{axis}" for axis in "XYZ"))
        self.assertGreater(waves[..., 2].mean(), .8)  # up, and not flat
        self.assertGreater(waves[..., 0].std(), .01)
        self.assertIn("environment", facts["plates"])
        around = Plate(folder / "plates/surroundings.0001.exr").channels("R", "G", "B")
        # The world's picture is redder to its right, greener to its top: so is what was rendered of it.
        columns, rows = around[..., 0].mean(0), around[..., 1].mean(1)
        self.assertGreater(columns[len(columns) * 3 // 4], 2 * columns[len(columns) // 4])
        self.assertGreater(rows[len(rows) // 4], rows[len(rows) * 3 // 4])

    def test_a_sea_with_the_waves_of_the_look_is_level(self):
        folder = self.wet("sea", SMALL + "settings.water = bpy.data.objects['ocean']\n"
                          "settings.reflection = settings.below = settings.shadow = settings.aovs = False\n")
        facts = self.facts(folder)
        self.assertNotIn("surface_normal", facts["plates"])
        depth, view = Plate(folder / "plates/surface.0001.exr").depth(), np.array(facts["camera"]["view"])
        for point in (0, 0), (2, 3), (-3, -1):
            point = (*point, facts["water"]["height"])
            x, y = self.pixel_of(facts, point)
            self.assertAlmostEqual(depth[y, x], -(view @ (*point, 1))[2], delta=.1)

    def test_the_layer_below_ends_at_the_objects_waves(self):
        for view in "ORTHO", "PERSP":
            folder = self.wet("sea", SMALL + "settings.water, settings.waves = bpy.data.objects['ocean'], 'OBJECT'\n"
                              "settings.reflection = settings.shadow = settings.aovs = False\n"
                              "scene.cycles.film_exposure, scene.cycles.sample_clamp_direct = 2, 5\n"  # of colors, not of depths
                              f"scene.camera.data.type, settings.folder = {view!r}, '//limpid'\n")
            dry, below, water = (Plate(folder / f"plates/{name}.0001.exr").depth() for name in ("dry", "below", "surface"))
            over = dry < water - .3  # the rock where it is above the wave in front of or behind it
            self.assertGreater(over.sum(), 100)
            self.assertLess((below < water - .3).sum(), .1 * over.sum())
            np.testing.assert_allclose(below[dry > water + .3], dry[dry > water + .3], atol=.1)

    def depths_on_waves(self, script):
        """Depths of the dry picture, of the layer below, and of the object's waves, whose mean height is .41."""
        folder = self.wet("sea", SMALL + "settings.water, settings.waves = bpy.data.objects['ocean'], 'OBJECT'\n"
                          "settings.reflection = settings.shadow = settings.aovs = False\n", script=script)
        self.assertAlmostEqual(self.facts(folder)["water"]["height"], .41, delta=.02)
        return (Plate(folder / f"plates/{name}.0001.exr").depth() for name in ("dry", "below", "surface"))

    def test_a_shoal_that_only_troughs_of_the_waves_cut_keeps_its_strip(self):
        dry, below, water = self.depths_on_waves(
            "bpy.ops.mesh.primitive_cylinder_add(radius=4, depth=1, location=(0, -2, .3 - .5))\n")
        strip = (dry > water - .1) & (dry < water)  # a pixel is .075 wide
        self.assertGreater(strip.sum(), 50)
        np.testing.assert_allclose(below[strip], dry[strip], atol=.1)

    def test_a_leaf_on_the_objects_waves_is_not_in_the_layer_below(self):
        depths = self.depths_on_waves(
            "bpy.ops.mesh.primitive_circle_add(radius=3, fill_type='NGON', location=(-4, -1, .5))\n")
        dry, below, water = (depth[:, :60] for depth in depths)  # left of the rock
        over = (dry < water - .02) & (dry > water - .12)  # by less than a strip
        self.assertGreater(over.sum(), 20)
        self.assertLess((below[over] < water[over]).mean(), .1)

    def test_a_linked_collection_is_cut_and_mirrored_like_the_rest(self):
        library = self.scene("pool")
        folder = self.folder / "linked"
        folder.mkdir()
        file = folder / "linked.blend"
        (said,) = self.said(None, f"""
bpy.ops.wm.read_factory_settings(use_empty=True)
with bpy.data.libraries.load({str(library)!r}, link=True) as (there, here):
    here.collections, here.worlds = ["Collection"] if "Collection" in there.collections else there.collections, there.worlds
    here.objects = [] if here.collections else there.objects
scene = bpy.context.scene
group = bpy.data.collections.new("all") if not here.collections else here.collections[0]
for thing in here.objects:
    if thing.name not in ("water", "Sun", "Camera"):
        group.objects.link(thing)
    else:
        scene.collection.objects.link(thing)
empty = bpy.data.objects.new("pool", None)
empty.instance_type, empty.instance_collection = "COLLECTION", group
scene.collection.objects.link(empty)
scene.world = here.worlds[0]
scene.camera = bpy.data.objects["Camera"]
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 4, False
scene.render.resolution_x, scene.render.resolution_y = 160, 90
bpy.ops.wm.save_as_mainfile(filepath={str(file)!r})
say(sorted(thing.name for thing in bpy.data.objects if thing.library))
""")
        self.assertIn("Sphere", said)
        (finished, linked) = self.said(file, POOL + "say(wet(frames='1', load=False))\n"
                                       "say(sum(thing.library is not None for thing in bpy.data.objects))")
        self.assertEqual(finished, "FINISHED")
        self.assertEqual(linked, len(said))
        facts = self.facts(folder / "limpid")
        x, y = self.pixel_of(facts, (-1.6, -.05, .5))
        self.assertTrue(self.is_red(Plate(folder / "limpid/plates/dry.0001.exr").color()[y, x]))
        self.assertFalse(self.is_red(Plate(folder / "limpid/plates/below.0001.exr").color()[y, x]))
        x, y = self.pixel_of(facts, (-1.6, -.05, -.5))
        self.assertTrue(self.is_red(Plate(folder / "limpid/plates/mirror.0001.exr").color()[y, x]))
        self.of_the_wet_pool(Plate(folder / "limpid/wet.0001.exr"))


if __name__ == "__main__":
    unittest.main()
