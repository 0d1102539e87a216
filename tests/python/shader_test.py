"""A look as a shader, with the values of a frame of arrays; lagoon_test has it beside the tool's."""
import inspect
import struct
import unittest

import numpy as np

import limpid
from support import HEIGHT, LOOK, WIDTH, pond


def named(things):
    return {thing.name: thing for thing in things}


class Shaders(unittest.TestCase):
    def test_fields(self):
        shader = limpid.Compositor(look=LOOK, threads=1).shader(
            **pond(), stage="compute", function="wet", set=2, first_binding=5, aovs=["path", "normal"])
        self.assertTrue(shader.text.startswith("#version 450"))
        self.assertIn(" wet(", shader.text)
        self.assertRegex(shader.id, "^[0-9a-f]{16}$")
        self.assertEqual((shader.stage, shader.function, shader.set), ("compute", "wet", 2))
        self.assertEqual(shader.block_binding, 5)
        self.assertIn("set = 2, binding = 5", shader.text)
        self.assertEqual(shader.work, (0, 0, WIDTH, HEIGHT))
        self.assertEqual([output[:2] for output in shader.outputs], [("color", 4), ("path", 1), ("normal", 3)])
        self.assertEqual([output.binding for output in shader.outputs], [6, 7, 8])

    def test_numbers_are_in_the_block(self):
        look = {**LOOK, "water_shadow": {"strength": 0.25}}
        compositor = limpid.Compositor(look=look, threads=1)
        shader = compositor.shader(**pond())
        self.assertEqual(len(shader.block) % 16, 0)
        for number in shader.numbers:
            in_block, = struct.unpack_from("f", shader.block, number.offset)
            self.assertEqual(in_block, number.value, number.name)
        strength = named(shader.numbers)["water_shadow.strength"]
        self.assertEqual(strength.value, 0.25)
        parameters = {p["name"]: p for operator in limpid.operators() if operator["name"] == "water_shadow"
                      for p in operator["parameters"]}
        self.assertEqual(strength.range, parameters["strength"]["range"])
        self.assertIsNone(named(shader.numbers)["water.up[1]"].range)
        compositor.look = {"water_shadow": {"strength": 0.5}}
        changed = compositor.shader(**{**pond(), "time": 3})
        self.assertEqual(changed.id, shader.id)
        self.assertEqual(changed.text, shader.text)
        self.assertEqual(named(changed.numbers)["water_shadow.strength"].value, 0.5)
        self.assertNotEqual(changed.block, shader.block)

    def test_textures(self):
        random = np.random.default_rng(3)
        wave_map = random.uniform(0.3, 0.7, (8, 16, 3)).astype(np.float32)
        compositor = limpid.Compositor(look={"wave_normals": {"model": "four_maps"}}, wave_map=wave_map, threads=1)
        shader = compositor.shader(**pond())
        bindings = [texture.binding for texture in shader.textures]
        self.assertEqual(bindings, sorted(set(bindings)))
        for texture in shader.textures:
            self.assertIn(f"binding = {texture.binding}) uniform sampler2D {texture.name};", shader.text)
            if texture.source == "planes":
                self.assertIsNone(texture.texels)
                self.assertEqual((texture.width, texture.height), (WIDTH, HEIGHT))
                self.assertIn(texture.role, {role["name"] for role in limpid.roles()})
                continue
            channels = () if texture.channels == 1 else (texture.channels,)
            self.assertEqual(texture.texels.shape, (texture.height, texture.width, *channels))
            self.assertEqual(texture.texels.dtype, np.float32)
            with self.assertRaises(ValueError):
                texture.texels[0] = 0
        roles = {texture.role for texture in shader.textures if texture.source == "planes"}
        self.assertLessEqual({"color", "depth", "shadow", "reflection"}, roles)
        maps = [t.texels for t in shader.textures if t.texels is not None and t.texels.shape == wave_map.shape]
        self.assertEqual(len(maps), 1)
        np.testing.assert_array_equal(maps[0], wave_map)

    def test_the_text_is_of_any_size_and_of_its_planes_and_look(self):
        compositor = limpid.Compositor(look=LOOK, threads=1)
        shader = compositor.shader(**pond())
        self.assertEqual(compositor.shader(**pond(17, 29)).id, shader.id)
        self.assertEqual(compositor.shader(**pond(), display=(3, 2, 40, 30)).id, shader.id)
        self.assertEqual(compositor.shader(**pond(), display=(3, 2, 40, 30)).work, (0, 0, 37, 28))
        without = {name: thing for name, thing in pond().items() if name != "shadow"}
        self.assertNotEqual(compositor.shader(**without).id, shader.id)
        self.assertEqual(compositor.shader(**without, shadow=None).id, compositor.shader(**without).id)
        self.assertNotEqual(limpid.Compositor(threads=1).shader(**pond()).id, shader.id)

    def test_runs_do_not_see_it(self):
        compositor = limpid.Compositor(look=LOOK, threads=1)
        with self.assertRaisesRegex(limpid.Error, "no frame has been run"):
            compositor.shader(**pond()) and compositor.plan
        wet = compositor.run(**pond())
        plan = str(compositor.plan)
        compositor.shader(**pond(17, 29), aovs=["path"])
        self.assertEqual(str(compositor.plan), plan)
        np.testing.assert_array_equal(compositor.run(**pond()), wet)

    def test_what_is_wrong_is_refused(self):
        compositor = limpid.Compositor(look=LOOK, threads=1)
        def refused(sentence, **changes):
            with self.assertRaises(limpid.Error) as caught:
                compositor.shader(**{**pond(), **changes})
            self.assertIn(sentence, str(caught.exception))
        refused("stage: unknown 'vertex', expected one of function, compute, fragment", stage="vertex")
        refused("stage is a int", stage=1)
        refused("'2d' is not a function name", function="2d")
        refused("descriptor set 32 is out of 0 ... 31", set=32)
        refused("set is 0.5, expected a whole number", set=0.5)
        refused("set is nan, expected a whole number", set=float("nan"))
        refused("first_binding is inf, expected a whole number", first_binding=float("inf"))
        refused("first binding -1 is out of 0 ... 1000", first_binding=-1)
        refused("did you mean 'path'?", aovs=["pth"])
        refused("expected a list of names", aovs="path")
        refused("the AOV sky shows a buffer of the frame", aovs=["sky"])
        refused("depth is a NoneType", depth=None)
        refused("camera is a NoneType, expected view and projection", camera=None)
        refused("time is not a finite number", time=float("nan"))
        refused("expected whole numbers (x0, y0, x1, y1)", display=(0, 0, 62, 35))
        with self.assertRaisesRegex(TypeError, "shader\\(\\) got an unexpected keyword argument 'colour'"):
            compositor.shader(**pond(), colour=None)

    def test_keywords_of_a_frame_are_those_of_run(self):
        of_run = inspect.signature(limpid.Compositor.run).parameters
        of_shader = inspect.signature(limpid.Compositor.shader).parameters
        both = set(of_run) & set(of_shader)
        self.assertLessEqual({"color", "depth", "camera", "water", "sun", "time", "sky_radiance", "display"}, both)
        for name in both - {"self", "aovs"}:
            self.assertEqual(of_run[name], of_shader[name])
        frame = pond()
        for role in limpid.roles():
            if role["name"] in frame:
                continue
            shape = (HEIGHT, WIDTH) if role["channels"] == 1 else (HEIGHT, WIDTH, role["channels"])
            limpid.Compositor(threads=1).shader(**frame, **{role["name"]: np.ones(shape, np.float32)})


if __name__ == "__main__":
    unittest.main()
