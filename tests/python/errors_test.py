"""What is wrong is refused with a sentence, before anything is written."""
import unittest

import numpy as np

import limpid
from support import HEIGHT, WIDTH, pond

FLOATS = np.zeros((HEIGHT, WIDTH), np.float32)


class Errors(unittest.TestCase):
    def refused(self, sentence, **changes):
        out = np.full((HEIGHT, WIDTH, 4), -1, np.float32)
        with self.assertRaises(limpid.Error) as caught:
            limpid.composite(**{**pond(), "out": out, "threads": 1, **changes})
        self.assertIn(sentence, str(caught.exception))
        self.assertTrue(np.all(out == -1))

    def test_error_is_a_value_error_of_the_module(self):
        self.assertTrue(issubclass(limpid.Error, ValueError))
        self.assertEqual(limpid.Error.__module__, "limpid")

    def test_types(self):
        for kind in ("float64", "int32", "uint8", ">f4", ">f2", "bool", "complex64", "object"):
            self.refused("expected float32 or float16", depth=FLOATS.astype(kind))
        self.refused("depth is a list, expected a numpy array", depth=FLOATS.tolist())
        self.refused("color is a NoneType, expected a numpy array", color=None)

    def test_shapes(self):
        self.refused(f"depth has the shape (4, {WIDTH}), expected ({HEIGHT}, {WIDTH})", depth=FLOATS[:4])
        self.refused("expected (35, 61)", depth=np.zeros((HEIGHT, WIDTH, 2), np.float32))
        self.refused("expected (35, 61, 3)", reflection=FLOATS)
        self.refused("expected (35, 61, 4)", color=FLOATS)
        self.refused("has 1 dimensions", shadow=np.zeros(9, np.float32))
        self.refused("has 4 dimensions", shadow=np.zeros((1, 1, 1, 1), np.float32))
        self.refused("shape (0, 61)", shadow=FLOATS[:0])
        self.refused("expected 1 ... ", shadow=np.broadcast_to(np.float32(1), (1 << 40, 2)))

    def test_out(self):
        self.refused("out has the shape (4, 61), expected (35, 61, 4)", out=FLOATS[:4])
        self.refused("out is an array of float64", out=np.zeros((HEIGHT, WIDTH, 4)))
        self.refused("out is read-only", out=np.broadcast_to(np.float32(0), (HEIGHT, WIDTH, 4)))
        self.refused("dtype: unknown 'float', expected one of float32, float16", out=None, dtype="float")
        thin = np.lib.stride_tricks.as_strided(np.zeros(4, np.float32), (HEIGHT, WIDTH, 4), (0, 0, 4))
        self.refused("pixels share bytes", out=thin)
        gray = np.lib.stride_tricks.as_strided(np.zeros((HEIGHT, WIDTH), np.float32), (HEIGHT, WIDTH, 3),
                                               (4 * WIDTH, 4, 0))
        self.refused("shares bytes with color", out=gray)
        one = np.zeros((HEIGHT, WIDTH), np.float32)
        self.refused("shares bytes with AOV ", aovs={"path": one, "fresnel": one})

    def test_aovs(self):
        self.refused("'pth' is not an AOV", aovs=["pth"])
        self.refused("did you mean 'path'?", aovs=["pth"])
        self.refused("expected a list of names", aovs="path")
        self.refused("AOV normal has the shape (35, 61), expected (35, 61, 3)", aovs={"normal": FLOATS})
        self.refused("stmap stands for three", aovs={"stmap": FLOATS})

    def test_colorspace(self):
        self.refused("colorspace: color space 'ACEScq': expected one of", colorspace="ACEScq")
        self.refused("colorspace is [1, 2], expected the name of a space, or eight numbers", colorspace=[1, 2])
        self.refused("colorspace: chromaticities ", colorspace=(.64, .33, .3, .6, .15, .06, .9, .05))

    def test_scene(self):
        self.refused("water: unknown 'hight', expected one of up, height, waves; did you mean 'height'?",
                     water={"hight": 1})
        self.refused("water is a float, expected a dict", water=1.0)
        self.refused("water.up is [0, 0, 0], expected a direction", water={"up": (0, 0, 0)})
        self.refused("water.up: expected three numbers", water={"up": (0, 1)})
        self.refused("water.height is a str, expected a number", water={"height": "0"})
        self.refused("water.waves: expected rows of amplitude", water={"waves": [[1, 2]]})
        self.refused("water.height is not a finite number", water={"height": np.inf})
        self.refused("sun.direction", sun={"direction": (np.nan, 0, 1)})
        self.refused("sun.color", sun={"color": (-1, 0, 1)})
        self.refused("camera.view: expected a matrix", camera=(np.eye(3), np.eye(4)))
        self.refused("view", camera=(2 * np.eye(4), pond()["camera"].projection))
        self.refused("camera is a NoneType, expected view and projection", camera=None)
        self.refused("time is not a finite number", time=float("nan"))
        self.refused("time is a str, expected a number", time="0")

    def test_display(self):
        for window in ((0, 0, 62, 35), (-1, 0, 5, 5), (0.5, 0, 5, 5), (5, 5, 5, 9), (0, 0, 5), "all"):
            self.refused("expected whole numbers (x0, y0, x1, y1)", display=window)

    def test_settings(self):
        self.refused("depth_kind: unknown 'eyes', expected one of eye, ", depth_kind="eyes")
        self.refused("clip: unknown 'dx', expected one of gl, d3d, reversed", clip="dx")
        self.refused("near", depth_kind="normalised")
        self.refused("trusted is a int, expected True or False", trusted=1)
        self.refused("far is a NoneType, expected a number", far=None)
        self.refused("mmx", simd="mmx")
        self.refused("-1", threads=-1)
        self.refused("max_error", max_error=-1.0)
        self.refused("runner: unknown 'cuda', expected one of fused, gpu", runner="cuda")
        self.refused("gpu or gpu_cache is 'H100', expected runner='gpu' beside it", gpu="H100")
        self.refused("gpu or gpu_cache is 'kept', expected runner='gpu' beside it", gpu_cache="kept")
        self.refused("expected 0 on a GPU, which leaves nothing out", runner="gpu", max_error=0.01)

    def test_looks(self):
        self.refused("unknown 'refracton', expected one of water, wave_normals", look={"refracton": {"steps": 2}})
        self.refused("did you mean 'refraction'?", look={"refracton": {}})
        self.refused("unknown key 'refraction.step'", look={"refraction": {"step": 2}})
        self.refused("did you mean 'steps'?", look={"refraction": {"step": 2}})
        self.refused("refraction.steps = two", look={"refraction": {"steps": "two"}})
        self.refused("refraction.steps is a NoneType", look={"refraction": {"steps": None}})
        self.refused("refraction.strength is a bool", look={"refraction": {"strength": True}})
        self.refused("water.ior = 9: expected 1 ... 4", look={"water": {"ior": 9}})
        self.refused("look: water is a float", look={"water": 1.5})
        self.refused("look is a str, expected a dict of dicts", look="realistic")

    def test_maps(self):
        self.refused("wave_map is float16", wave_map=np.zeros((4, 4, 3), np.float16))
        self.refused("wave_map has the shape (4, 4), expected (4, 4, 3)", wave_map=np.zeros((4, 4), np.float32))
        self.refused("environment: NaN or infinity", environment=np.full((4, 8, 3), np.nan, np.float32))

    def test_cameras(self):
        for wrong in (lambda: limpid.perspective(4, 1), lambda: limpid.perspective(1, 1, 2, 1),
                      lambda: limpid.orthographic(0, 1), lambda: limpid.perspective(1, 1, clip="dx"),
                      lambda: limpid.look_at((0, 0, 0), (0, 1, 0))):
            with self.assertRaises(limpid.Error):
                wrong()

    def test_a_word_that_is_no_keyword(self):
        with self.assertRaisesRegex(TypeError, "colour"):
            limpid.composite(**pond(), colour=FLOATS)

    def test_a_compositor_goes_on_after_an_error(self):
        compositor = limpid.Compositor(threads=1)
        expected = compositor.run(**pond())
        with self.assertRaises(limpid.Error):
            compositor.run(**{**pond(), "depth": FLOATS[:3]})
        with self.assertRaises(limpid.Error):
            compositor.look = {"water": {"ior": 1.5}, "refraction": {"strength": "x"}}
        np.testing.assert_array_equal(compositor.run(**pond()), expected)


if __name__ == "__main__":
    unittest.main()
