"""Looks, plans and tables as plain data, the same as the tool tells."""
import inspect
import json
import pathlib
import subprocess
import tempfile
import tomllib
import unittest

import numpy as np

import limpid
from support import DATA, TOOL, pond

LOOKS = DATA.parent / "looks"
PRESETS = ("basin", "creek", "harbour", "lake_at_dusk", "open_sea", "pool")


def tool(*words):
    return subprocess.run([TOOL, *map(str, words)], check=True, capture_output=True, text=True).stdout


class Looks(unittest.TestCase):
    def test_waters_are_fitted_to_the_colorspace(self):
        def wet(**space):
            return limpid.composite(**pond(), threads=1, look={"depth_fog": {"water_type": "3C"}}, **space)
        acescg = (.713, .293, .165, .83, .128, .044, .32168, .33767)
        np.testing.assert_array_equal(wet(colorspace="Rec.709"), wet())
        np.testing.assert_array_equal(wet(colorspace=acescg), wet(colorspace="ACEScg"))
        self.assertTrue(np.any(wet(colorspace="ACEScg") != wet()))

    def test_a_look_is_plain_data_and_reads_back(self):
        for name in ("physical", "realistic", "rito", "monogame", "fast", *PRESETS):
            look = limpid.load_look(name)
            self.assertEqual(json.loads(json.dumps(look)), json.loads(json.dumps(limpid.full_look(look))))
            self.assertEqual(limpid.full_look(tomllib.loads(limpid.look_to_toml(look))), look)

    def test_a_file_says_what_it_leaves_out(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "own.toml"
            path.write_text('[wave_normals]\nmap = "maps/waves.png"\n[water]\nior = 1.4\n')
            look = limpid.load_look(path)
            self.assertEqual(look["wave_normals"]["map"], str(path.parent / "maps/waves.png"))
            del look["wave_normals"]["map"]
            expected = limpid.full_look({"water": {"ior": 1.4}})
            del expected["wave_normals"]["map"]
            self.assertEqual(look, expected)
            path.write_text("[water]\nior = 9\n")
            with self.assertRaisesRegex(limpid.Error, "own.toml: water.ior = 9: expected"):
                limpid.load_look(path)
            path.write_text("[water\n")
            with self.assertRaisesRegex(limpid.Error, "own.toml"):
                limpid.load_look(path)
        with self.assertRaisesRegex(limpid.Error, "expected one of basin, creek, fast, harbour, lake_at_dusk, monogame"):
            limpid.load_look("unreal")

    def test_presets_are_what_the_tool_makes_of_them(self):
        physical = limpid.load_look("physical")
        for name in PRESETS:
            look = limpid.load_look(name)
            self.assertEqual(look["depth_fog"]["water_type"], "case_1", name)
            self.assertEqual(look["wave_normals"]["map"], physical["wave_normals"]["map"])
            self.assertNotEqual(look["wave_normals"]["tile_size"], physical["wave_normals"]["tile_size"])
            listed = tool("operators", "depth_fog", "--look", name)
            for key in ("murkiness", "sediment", "cdom", "anisotropy"):
                self.assertRegex(listed, rf"\n  {key} += {look['depth_fog'][key]:g} ")

    def test_a_file_says_what_its_base_does_not(self):
        with tempfile.TemporaryDirectory() as folder:
            path, base = pathlib.Path(folder) / "own.toml", pathlib.Path(folder) / "far" / "base.toml"
            base.parent.mkdir()
            base.write_text('[wave_normals]\nmap = "waves.png"\nspeed = 7\n[depth_fog]\nwater_type = "IB"\n')
            path.write_text('about = "Mine."\nbase = "far/base.toml"\n[depth_fog]\nmurkiness = 0.25\n')
            look = limpid.load_look(path)
            self.assertEqual(look["wave_normals"]["map"], str(base.parent / "waves.png"))
            self.assertEqual(look["wave_normals"]["speed"], 7)
            self.assertEqual(look["depth_fog"]["water_type"], "case_1")  # what a murkiness brings
            path.write_text('base = "physical"\n')
            self.assertEqual(limpid.load_look(path), limpid.load_look("physical"))
            path.write_text('base = "own.toml"\n')
            with self.assertRaisesRegex(limpid.Error, "own.toml: base = 'own.toml': expected a look that is not based"):
                limpid.load_look(path)
            path.write_text("base = 3\n")
            with self.assertRaisesRegex(limpid.Error, "own.toml: base: expected the name"):
                limpid.load_look(path)
            path.write_text('base = "unreal"\n')
            with self.assertRaisesRegex(limpid.Error, "own.toml: no look is named 'unreal'"):
                limpid.load_look(path)

    def test_only_what_is_named_changes(self):
        compositor = limpid.Compositor(look={"water": {"ior": 1.5}}, threads=1)
        compositor.look = {"refraction": {"steps": 2}, "depth_fog": {"color": np.array([0.1, 0.2, 0.3])}}
        self.assertEqual(compositor.look["water"]["ior"], 1.5)
        self.assertEqual(compositor.look["refraction"]["steps"], 2)
        self.assertEqual(compositor.look["depth_fog"]["color"], (0.1, 0.2, 0.3))
        with self.assertRaises(TypeError):
            compositor.look["water"]["ior"] = 1.3  # it would change nothing
        fresh = limpid.Compositor(look=compositor.look, threads=1)
        self.assertEqual(fresh.look, compositor.look)
        np.testing.assert_array_equal(fresh.run(**pond()), compositor.run(**pond()))

    def test_an_error_changes_nothing(self):
        compositor = limpid.Compositor(threads=1)
        before = compositor.look
        with self.assertRaises(limpid.Error):
            compositor.look = {"water": {"ior": 1.5}, "refraction": {"steps": "two"}}
        self.assertEqual(compositor.look, before)


class Plans(unittest.TestCase):
    def test_a_plan_says_what_ran_and_why(self):
        frame = pond()
        compositor = limpid.Compositor(look={"water_shadow": {"strength": 0}}, threads=1)
        with self.assertRaisesRegex(limpid.Error, "no frame has been run"):
            compositor.plan
        compositor.run(**frame)
        plan = compositor.plan
        self.assertEqual([op.name for op in plan], [op["name"] for op in limpid.operators()[:-1]])
        verdicts = {op.name: op.verdict for op in plan}
        self.assertEqual(verdicts["refraction"], "kept")
        self.assertEqual(verdicts["water_shadow"], "neutral")
        self.assertEqual(verdicts["wave_normals"], "absent")  # there is no map
        for op in plan:
            self.assertIn(op.name, str(plan))
            self.assertIn(op.reason, str(plan))
        self.assertEqual(set(plan.reads) & {"color", "depth", "reflection"}, {"color", "depth", "reflection"})
        compositor.look = {"water_shadow": {"strength": 1}}
        with self.assertRaisesRegex(limpid.Error, "no frame has been run"):
            compositor.plan
        compositor.run(**frame)
        self.assertNotEqual(str(compositor.plan), str(plan))


class Tables(unittest.TestCase):
    def test_operators_are_those_of_the_tool(self):
        shown = tool("operators")
        for operator in limpid.operators():
            self.assertIn(f"{operator['name']:19} {operator['about']}", shown)
            parameters = tool("operators", operator["name"])
            lines = [line for line in parameters.splitlines() if line.startswith("  ") and line[2] != " "]
            self.assertEqual([line.split()[0] for line in lines], [p["name"] for p in operator["parameters"]])
            for parameter in operator["parameters"]:
                self.assertIn(parameter["about"], parameters)
                for word in (parameter["unit"], *parameter["choices"]):
                    self.assertIn(word, parameters)

    def test_defaults_are_those_of_a_look(self):
        look = limpid.full_look()
        declared = {operator["name"]: {p["name"]: p["default"] for p in operator["parameters"]}
                    for operator in limpid.operators()}
        self.assertEqual(declared, look)

    def test_ranges_hold(self):
        for operator in limpid.operators():
            for p in operator["parameters"]:
                if p["kind"] != "real":
                    continue
                for end in p["range"]:
                    limpid.full_look({operator["name"]: {p["name"]: end}})
                for wrong in (np.nextafter(p["range"][0], -np.inf), np.nextafter(p["range"][1], np.inf), np.nan):
                    with self.assertRaises(limpid.Error):
                        limpid.full_look({operator["name"]: {p["name"]: wrong}})

    def test_every_role_is_a_keyword(self):
        keywords = inspect.signature(limpid.Compositor.run).parameters
        for role in limpid.roles():
            self.assertIn(role["name"], keywords)
            self.assertIn(role["name"], limpid.Compositor.run.__doc__)

    def test_composite_has_the_settings_of_the_class(self):
        of_class = dict(inspect.signature(limpid.Compositor).parameters)
        of_function = dict(inspect.signature(limpid.composite).parameters)
        del of_function["frame"]
        self.assertEqual(of_function, of_class)
        for name in of_class:
            self.assertIn(name, limpid.Compositor.__doc__)

    def test_all_that_is_public_has_docs(self):
        for name in limpid.__all__:
            self.assertTrue(inspect.getdoc(getattr(limpid, name)), name)
        self.assertEqual(limpid.__version__, tool("--version").split()[-1])


if __name__ == "__main__":
    unittest.main()
