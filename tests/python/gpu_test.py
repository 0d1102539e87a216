"""The runner on a GPU beside that of the CPU: Mesa's lavapipe, or whatever device comes first."""
import unittest

import numpy as np

import limpid
from support import LOOK, pond


class Gpu(unittest.TestCase):
    def setUp(self):
        try:
            self.water = limpid.Compositor(look=LOOK, runner="gpu")
        except limpid.Error as why:
            if "Vulkan" not in str(why):
                raise
            self.skipTest(str(why))

    def test_is_as_near_as_the_cpu(self):
        here = limpid.Compositor(look=LOOK)
        self.assertEqual(here.device, "")
        self.assertNotEqual(self.water.device, "")
        changed = {"picture": [], "path": []}
        for seed in range(1, 7):
            frame = pond(seed=seed)
            wet, parts = self.water.run(**frame, aovs=["path"])
            judge, path = here.run(**frame, aovs=["path"])
            # A bottom of noise is where roundings choose between two hits now and then.
            for name, ours, theirs in (("picture", wet, judge),
                                       ("path", parts["path"], path["path"])):
                off = np.abs(ours - theirs)
                self.assertLess(off[off < 1e-3].mean(), 2e-6)
                changed[name].append((off >= 1e-3).mean())
                self.assertLess(changed[name][-1], 5e-3)
            self.assertGreater(np.abs(wet - frame["color"]).mean(), 0.01)
        for name, shares in changed.items():
            self.assertLess(np.mean(shares), 2e-3, name)
        self.assertEqual(self.water.plan.text, here.plan.text)

    def test_other_devices_are_refused(self):
        with self.assertRaisesRegex(limpid.Error, "no GPU has 'no such device' in its name"):
            limpid.composite(**pond(), runner="gpu", gpu="no such device")


if __name__ == "__main__":
    unittest.main()
