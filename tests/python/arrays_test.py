"""Whatever way an array lies in memory, the picture is the same to the bit, and it is not copied."""
import unittest

import numpy as np

import limpid
from support import HEIGHT, LOOK, WIDTH, pond

ARRAYS = ("color", "depth", "shadow", "reflection")


def changed(frame, change):
    return {**frame, **{name: change(frame[name]) for name in ARRAYS}}


def every_other(array):
    """The same pixels, with others between them in both directions."""
    wide = np.full((2 * array.shape[0], 3 * array.shape[1]) + array.shape[2:], np.nan, array.dtype)
    wide[::2, ::3] = array
    return wide[::2, ::3]


def planar(array):
    """Channels one after another."""
    return array if array.ndim == 2 else np.moveaxis(np.ascontiguousarray(np.moveaxis(array, 2, 0)), 0, 2)


def unaligned(array):
    memory = np.empty(array.nbytes + 1, np.uint8)
    view = np.ndarray(array.shape, array.dtype, memory.data, offset=1)
    view[...] = array
    return view


class Arrays(unittest.TestCase):
    def setUp(self):
        self.frame = pond()
        self.compositor = limpid.Compositor(look=LOOK, threads=1)
        self.expected = self.compositor.run(**self.frame)

    def expect_same(self, frame, **more):
        np.testing.assert_array_equal(self.compositor.run(**frame, **more), self.expected)

    def test_the_picture_has_water(self):
        wet = np.any(self.expected != self.frame["color"], axis=2)
        self.assertGreater(wet.mean(), 0.3)
        self.assertFalse(wet[:, : WIDTH // 4].any())
        self.assertEqual((self.expected.dtype, self.expected.shape), (np.float32, (HEIGHT, WIDTH, 4)))
        self.assertTrue(np.all(self.expected[wet][:, 3] == 1))

    def test_strides(self):
        for change in (every_other, planar, unaligned, np.asfortranarray,
                       lambda array: np.flipud(np.ascontiguousarray(np.flipud(array))),
                       lambda array: np.fliplr(np.ascontiguousarray(np.fliplr(array))),
                       lambda array: array[..., None] if array.ndim == 2 else array):
            self.expect_same(changed(self.frame, change))

    def test_read_only_arrays(self):
        def frozen(array):
            array = array.copy()
            array.flags.writeable = False
            return array
        self.expect_same(changed(self.frame, frozen))

    def test_broadcast_arrays(self):
        whole = {**self.frame, "shadow": np.full((HEIGHT, WIDTH), 0.25, np.float32),
                 "reflection": np.full((HEIGHT, WIDTH, 3), 0.5, np.float32)}
        thin = {**self.frame, "shadow": np.broadcast_to(np.float32(0.25), (HEIGHT, WIDTH)),
                "reflection": np.broadcast_to(np.float32(0.5), (HEIGHT, WIDTH, 3))}
        np.testing.assert_array_equal(self.compositor.run(**thin), self.compositor.run(**whole))

    def test_half(self):
        half = changed(self.frame, lambda array: array.astype(np.float16))
        as_float = changed(half, lambda array: array.astype(np.float32))
        from_half, from_float = self.compositor.run(**half), self.compositor.run(**as_float)
        np.testing.assert_array_equal(from_half, from_float)
        rounded = self.compositor.run(**half, dtype="float16")
        self.assertEqual(rounded.dtype, np.float16)
        self.assertTrue((self.compositor.run(**half, dtype=np.float16) == rounded).all())
        np.testing.assert_array_equal(rounded, from_float.astype(np.float16))

    def test_color_without_alpha(self):
        wet = self.compositor.run(**{**self.frame, "color": self.frame["color"][..., :3]})
        np.testing.assert_array_equal(wet, self.expected[..., :3])

    def test_out_is_written_where_it_lies(self):
        for change in (every_other, planar, unaligned, np.flipud, np.fliplr):
            out = change(np.full_like(self.expected, -1))
            self.assertIs(self.compositor.run(**self.frame, out=out), out)
            np.testing.assert_array_equal(out, self.expected)
        around = np.full((HEIGHT + 2, WIDTH + 2, 5), -1, np.float32)
        self.compositor.run(**self.frame, out=around[1:-1, 1:-1, :4])
        np.testing.assert_array_equal(around[1:-1, 1:-1, :4], self.expected)
        around[1:-1, 1:-1, :4] = -1
        self.assertTrue(np.all(around == -1))

    def test_in_place(self):
        color = self.frame["color"].copy()
        self.assertIs(self.compositor.run(**{**self.frame, "color": color}, out=color), color)
        np.testing.assert_array_equal(color, self.expected)

    def test_arrays_are_read_as_they_lie(self):
        # A broadcast frame of 2^44 pixels could not be copied; the display window asks for few. A search for what hides
        # the sun would look at all of them.
        huge = (1 << 22, 1 << 22)
        frame = {**self.frame, "color": np.broadcast_to(np.float32(0.5), huge + (3,)),
                 "depth": np.broadcast_to(np.float32(9), huge)}
        del frame["shadow"], frame["reflection"]
        small = {**frame, "color": np.full((8, 8, 3), 0.5, np.float32), "depth": np.full((8, 8), 9, np.float32)}
        trusting = limpid.Compositor(look={"refraction": {"model": "normal_offset", "strength": 0},
                                           "water_shadow": {"strength": 0}},
                                     trusted=True, threads=1)
        np.testing.assert_array_equal(trusting.run(**frame, display=(0, 0, 8, 8)), trusting.run(**small))

    def test_overscan(self):
        frame = {**self.frame, "camera": pond(HEIGHT - 6, WIDTH - 10)["camera"]}
        wet = self.compositor.run(**frame, display=(4, 2, WIDTH - 6, HEIGHT - 4))
        self.assertEqual(wet.shape, (HEIGHT - 6, WIDTH - 10, 4))
        alone = changed(frame, lambda array: array[2:-4, 4:-6])
        dry = np.all(wet == alone["color"], axis=2)
        self.assertTrue(dry[:, : WIDTH // 4 - 4].all())
        # What lies beyond the picture is looked up: at its rim, nowhere else in the same place.
        differs = np.any(wet != self.compositor.run(**alone), axis=2)
        self.assertTrue(differs.any())
        self.assertFalse(differs.all())

    def test_values_that_mean_nothing_are_replaced_and_told(self):
        color, depth = self.frame["color"].copy(), self.frame["depth"].copy()
        color[3, 40:42, 0], color[4, 40, 1], depth[5, 40] = np.nan, np.inf, np.nan
        wet = self.compositor.run(**{**self.frame, "color": color, "depth": depth})
        self.assertTrue(np.isfinite(wet).all())
        self.assertEqual(self.compositor.replaced, {"color": {"nan": 2, "inf": 1}, "depth": {"nan": 1}})
        self.compositor.run(**self.frame)
        self.assertEqual(self.compositor.replaced, {})


class Aovs(unittest.TestCase):
    def test_parts_sum_to_the_picture(self):
        parts = ["transmitted", "in_scatter", "reflected", "highlight"]
        wet, aovs = limpid.composite(**pond(), look=LOOK, aovs=parts)
        self.assertEqual(list(aovs), parts)
        np.testing.assert_allclose(sum(aovs.values()), wet[..., :3], rtol=1e-5, atol=1e-6)

    def test_shapes(self):
        names = [aov["name"] for aov in limpid.aovs()]
        _, aovs = limpid.composite(**pond(), look=LOOK, aovs=names)
        for aov in limpid.aovs():
            channels = len(aov["channels"])
            self.assertEqual(aovs[aov["name"]].shape, (HEIGHT, WIDTH) + ((channels,) if channels > 1 else ()))

    def test_stmap_stands_for_three_and_shows_where_dry_pixels_are(self):
        _, aovs = limpid.composite(**pond(), look=LOOK, aovs=["stmap"])
        self.assertEqual(list(aovs), ["stmap.r", "stmap.g", "stmap.b"])
        np.testing.assert_allclose(aovs["stmap.g"][0, 0], (0.5 / WIDTH, 1 - 0.5 / HEIGHT), rtol=1e-6)

    def test_arrays_of_ones_own(self):
        path = np.full((HEIGHT, WIDTH), -1, np.float16)
        wet, aovs = limpid.composite(**pond(), look=LOOK, aovs={"path": path, "normal": None})
        self.assertIs(aovs["path"], path)
        _, whole = limpid.composite(**pond(), look=LOOK, aovs=["path", "normal"])
        np.testing.assert_array_equal(path, whole["path"].astype(np.float16))
        np.testing.assert_array_equal(aovs["normal"], whole["normal"])


if __name__ == "__main__":
    unittest.main()
