"""The interpreter's lock is released while a picture is computed."""
import sys
import threading
import unittest

import numpy as np

import limpid
from support import LOOK, pond


class Threads(unittest.TestCase):
    def other_thread_runs_during(self, work):
        """Whether another thread gets the lock while `work` is called again and again, though the
        interpreter itself takes it from nobody."""
        interval = sys.getswitchinterval()
        gate, ran = threading.Lock(), []
        def other():
            with gate:
                ran.append(True)
        gate.acquire()
        thread = threading.Thread(target=other)
        thread.start()
        sys.setswitchinterval(1000)
        try:
            gate.release()
            for _ in range(2000):
                work()
                if ran:
                    break
            return bool(ran)
        finally:
            sys.setswitchinterval(interval)
            thread.join()

    def test_the_lock_is_released(self):
        frame, compositor = pond(), limpid.Compositor(look=LOOK, threads=1)
        compositor.run(**frame)
        self.assertTrue(self.other_thread_runs_during(lambda: compositor.run(**frame)))
        self.assertFalse(self.other_thread_runs_during(lambda: sum(range(100))))

    def test_compositors_at_once_give_the_same_bits(self):
        frame = pond(211, 307)
        expected = limpid.composite(**frame, look=LOOK)
        wrong = []
        def work():
            compositor = limpid.Compositor(look=LOOK, threads=2)
            wrong.extend(i for i in range(5) if not np.array_equal(compositor.run(**frame), expected))
        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_one_compositor_is_for_one_thread_at_a_time(self):
        frame, compositor = pond(211, 307), limpid.Compositor(look=LOOK, threads=1)
        expected = compositor.run(**frame)
        outcomes, meet = [], threading.Barrier(2)
        def work():
            meet.wait()
            while len(outcomes) < 10000 and not any(isinstance(each, limpid.Error) for each in outcomes):
                try:
                    outcomes.append(np.array_equal(compositor.run(**frame), expected))
                except limpid.Error as error:
                    outcomes.append(error)
        threads = [threading.Thread(target=work) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        errors = [str(outcome) for outcome in outcomes if isinstance(outcome, limpid.Error)]
        self.assertTrue(errors)
        self.assertTrue(all("at work in another thread" in error for error in errors), errors)
        self.assertNotIn(False, outcomes)

    def test_instruction_sets_and_threads(self):
        frame = pond()
        expected = limpid.composite(**frame, look=LOOK, threads=1)
        np.testing.assert_array_equal(limpid.composite(**frame, look=LOOK, threads=3), expected)
        # In noise a rounding tells whether a ray that ends on the edge is out of the picture, and
        # whether one has passed behind something, as sunlight on its way down; what meets the
        # bottom in two steps and straight sunlight is the same.
        frames = [pond(seed=seed) for seed in range(1, 5)]
        for steps, sunlight, share in (2, "straight", 0), ("march", "refracted", 1e-3):
            look = dict(LOOK, refraction={"steps": steps, "off_frame": "shorten"}, caustics={"sunlight": sunlight})
            far = []
            for frame in frames:
                expected = limpid.composite(**frame, look=look, threads=1)
                scalar = limpid.composite(**frame, look=look, simd="scalar")
                far.append(~np.isclose(scalar, expected, rtol=0, atol=1e-3))
            self.assertLessEqual(np.mean(far), share, steps)


if __name__ == "__main__":
    unittest.main()
