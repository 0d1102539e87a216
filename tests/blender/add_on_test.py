"""The add-on in Blender: it comes and goes, refuses in words, and leaves the file as it was."""
import contextlib
import hashlib
import os
import re
import signal
import socket
import unittest
import urllib.request

from in_blender import InBlender

PLAIN = "settings.water = bpy.data.objects['water']; settings.overscan_kind = 'FIXED'; settings.samples = 1\n"


class Comes(InBlender):
    def test_it_registers_and_unregisters(self):
        (before, during, after) = self.said(None, """
def there():
    return [hasattr(bpy.types.Scene, "limpid"), bpy.types.Panel.bl_rna_get_subclass_py("LIMPID_PT_panel") is not None,
            bpy.types.Operator.bl_rna_get_subclass_py("LIMPID_OT_wet") is not None]
say(there())
bpy.ops.preferences.addon_disable(module="limpid_blender")
say(there())
bpy.ops.preferences.addon_enable(module="limpid_blender")
say(there())
""")
        self.assertEqual((before, during, after), ([True] * 3, [False] * 3, [True] * 3))

    def test_its_looks_are_those_of_the_tool(self):
        (names,) = self.said(None, """
from limpid_blender import properties
say(properties._known_looks(settings, bpy.context, "s"))
""")
        self.assertIn("physical", names)
        self.assertNotIn("fast_one", names)


class Refuses(InBlender):
    def test_what_is_missing_or_wrong_is_told_in_words(self):
        cases = {
            "no water: pick the water object, or give the height of the water": "settings.water = None",
            "is not in the view layer": "scene.collection.objects.unlink(settings.water)",
            "has no level face: expected a mesh with a level surface": "settings.water.rotation_euler = (1.5708, 0, 0)",
            "no sun: expected a light of the type Sun in the scene": "bpy.data.objects['Sun'].hide_render = True",
            "its brightness is unknown: expected one Emission node": """
sun = bpy.data.objects['Sun'].data
sun.use_nodes = True
tree = sun.node_tree
tree.links.new(tree.nodes.new('ShaderNodeTexSky').outputs[0], tree.nodes['Emission'].inputs['Color'])""",
            "no camera: expected a perspective or orthographic camera": "scene.camera = None",
            "is panoramic: expected a perspective or orthographic camera": "scene.camera.data.type = 'PANO'",
            "the scene is stereoscopic: expected one view": "scene.render.use_multiview = True",
            "frames '3-1': expected ascending ranges": "settings.frames_kind, settings.frames = 'LIST', '3-1'",
            "no program at ": "bpy.context.preferences.addons['limpid_blender'].preferences.tool = '//nowhere'",
            "no look is named 'nolook': expected one of": "settings.look = 'nolook'",
            "did you mean 'density'?": "settings.settings = 'depth_fog.densty=1'",
            "No closing quotation": "settings.settings = 'a.b=\"1'",
            "Not a directory": "settings.folder = bpy.data.filepath + '/within'",
        }
        script = """
bpy.ops.preferences.addon_disable(module="limpid_blender")
bpy.ops.preferences.addon_enable(module="limpid_blender")  # with preferences, which --addons leaves out
"""
        script += "path = bpy.data.filepath\nfrom limpid_blender.state import state\n"
        for change in cases.values():
            script += f"""
bpy.ops.wm.open_mainfile(filepath=path)
scene = bpy.context.scene
settings = scene.limpid
bpy.context.preferences.addons['limpid_blender'].preferences.tool = ''
{PLAIN}{change}
say([wet(), state.failure])
"""
        for wanted, (reported, shown) in zip(cases, self.said(self.scene("pool"), script), strict=True):
            self.assertIn(wanted, reported)
            self.assertIn(wanted, shown)  # in the panel
        self.assertFalse((self.folder / "pool/limpid/plates").exists())

    def test_a_file_that_was_never_saved_and_a_tool_that_is_not_there(self):
        (unsaved,) = self.said(None, "bpy.ops.mesh.primitive_plane_add()\nsettings.water = bpy.context.object\n"
                                     "bpy.data.lights[0].type = 'SUN'\nsay(wet())")
        self.assertIn("this file was never saved, so '//' names no folder", unsaved)
        (missing,) = self.said(self.scene("pool"), PLAIN + "say(wet())",
                               environment=dict(self.environment, PATH="/usr/bin:/bin"))
        self.assertIn("limpid is not on PATH: install limpid, or give its path", missing)

    def test_a_farm_sees_it_in_the_exit_status(self):
        expression = "import bpy; bpy.ops.limpid.wet()"
        said = self.blender("--addons", "limpid_blender", self.scene("pool"), "--python-exit-code", 3, "--python-expr",
                            expression, code=3)
        self.assertIn("no water: pick the water object", said)


class Leaves(InBlender):
    def test_the_file_is_as_it_was_after_success_and_failure(self):
        scene = self.scene("pool")
        before = hashlib.sha256(scene.read_bytes()).hexdigest()
        loaded, again, undone, after_error, copies = self.said(scene, f"""
from block_state import block_state, differences
from limpid_blender.load import load
{PLAIN}
scene.render.resolution_x, scene.render.resolution_y = 64, 36
bpy.data.objects["Sphere"].location.x = -1.5  # a change that is not saved
bpy.context.view_layer.update()
start = block_state()
assert wet() == "FINISHED"
say(differences(start, block_state()))
load(str(pathlib.Path(bpy.data.filepath).parent / "limpid"), [scene.frame_current])
say(differences(start, block_state()))
bpy.data.node_groups.remove(bpy.data.node_groups["limpid wet"])
bpy.data.images.remove(bpy.data.images["limpid wet"])
say(differences(start, block_state()))
settings.look = "nolook"
start = block_state()
assert "nolook" in wet()
say(differences(start, block_state()))
import tempfile, os
say([name for name in os.listdir(tempfile.gettempdir()) if name.startswith("limpid_")])
""")
        self.assertEqual((undone, after_error, copies), ([], [], []))
        self.assertEqual((loaded, again), (["images/limpid wet", "node_groups/limpid wet"],) * 2)
        self.assertEqual(hashlib.sha256(scene.read_bytes()).hexdigest(), before)

    def test_a_cancelled_job_leaves_the_files_of_the_one_before(self):
        before, sentence, after, temporary = self.said(self.scene("pool"), f"""
import hashlib, os, tempfile, threading
from limpid_blender import begin
from limpid_blender.run import Run
{PLAIN}
scene.render.resolution_x, scene.render.resolution_y = 64, 36
folder = pathlib.Path(bpy.data.filepath).parent / "cancelled"
settings.folder = str(folder)
def files():
    return {{str(path.relative_to(folder)): path.is_file() and hashlib.sha256(path.read_bytes()).hexdigest()
            for path in folder.rglob("*") if path.name != "limpid.log"}}
assert wet() == "FINISHED"
say(files())
settings.samples = 3000
mirror, hear = threading.Event(), Run._hear
def heard(run, line):
    hear(run, line)
    if run.text.endswith("mirror"):
        mirror.set()
Run._hear = heard
started = begin.Started(begin.job_of(scene, bpy.context.view_layer))
assert mirror.wait(600)
started.run.cancel()
started.finish()
say(started.run.failure())
say(files())
say([name for name in os.listdir(tempfile.gettempdir()) if name.startswith("limpid_")])
""")
        self.assertEqual((sentence, temporary), ("cancelled: 0 frames finished", []))
        self.assertIn("wet.0001.exr", before)
        self.assertEqual(after, before)

    def test_two_jobs_in_one_folder_have_each_its_frames(self):
        wet, left = self.said(self.scene("pool"), f"""
import os
from limpid_blender import begin
{PLAIN}
scene.render.resolution_x, scene.render.resolution_y = 64, 36
settings.folder = "//farm"
jobs = [begin.Started(begin.job_of(scene, bpy.context.view_layer, frame)) for frame in "34"]
for job in jobs:
    job.finish()
say([job.run.wet for job in jobs])
say(sorted(os.listdir(bpy.path.abspath("//farm"))))
""")
        self.assertEqual(wet, [[3], [4]])
        self.assertEqual(left, ["limpid.log", "plates", "scene.0003.toml", "scene.0004.toml", "wet.0003.exr", "wet.0004.exr"])

    def test_the_group_of_an_earlier_run_keeps_its_links_and_factors(self):
        links = self.said(self.scene("pool"), f"""
{PLAIN}
scene.render.resolution_x, scene.render.resolution_y = 64, 36
assert wet() == "FINISHED"
tree = bpy.data.node_groups.new("mine", "CompositorNodeTree")
group, end = tree.nodes.new("CompositorNodeGroup"), tree.nodes.new("CompositorNodeSetAlpha")
group.node_tree = bpy.data.node_groups["limpid wet"]
tree.links.new(group.outputs["Wet"], end.inputs[0])
tree.links.new(group.outputs["Alpha"], end.inputs[1])
group.inputs["reflected"].default_value = .5
def state():
    return [[link.from_socket.name for link in tree.links], [[one.name, one.default_value] for one in group.inputs],
            len(group.outputs) == len(set(one.name for one in group.outputs)), len(group.outputs)]
for settings.aovs in (True, False, True):
    assert wet() == "FINISHED"
    say(state())
""")
        factors = [["transmitted", 1], ["in_scatter", 1], ["reflected", .5], ["highlight", 1]]
        self.assertEqual(links[0][:3], [["Wet", "Alpha"], factors, True])
        self.assertEqual(links[1][:3], [["Wet", "Alpha"], [], True])
        self.assertLess(links[1][3], links[0][3])
        for factor in factors:  # the inputs were away for a run
            factor[1] = 1
        self.assertEqual(links[2], [["Wet", "Alpha"], factors, True, links[0][3]])

    def test_the_messages_go_with_the_button_and_with_the_file(self):
        said = self.said(self.scene("pool"), """
from limpid_blender.state import state
wet()
say(state.failure)
bpy.ops.limpid.clear()
say(state.failure)
wet()
bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
say(state.failure)
""")
        self.assertIn("no water", said[0])
        self.assertEqual(said[1:], ["", ""])

    def test_the_page_is_served_on_the_plates(self):
        no_plates, wrong, address, page = self.said(self.scene("lake"), """
settings.water_kind, settings.samples, settings.overscan_kind = "HEIGHT", 1, "FIXED"
scene.render.resolution_x, scene.render.resolution_y = 64, 36
try:
    bpy.ops.limpid.view(frames="2")
except RuntimeError as failure:
    say(str(failure))
assert wet(frames="2-3") == "FINISHED"
from limpid_blender.state import state
import urllib.request
settings.settings = "depth_fog.densty=1"
try:
    bpy.ops.limpid.view(frames="2-3")
except RuntimeError as failure:
    say(str(failure))
settings.settings = "depth_fog.density=1"
bpy.ops.limpid.view(frames="2-3")
assert state.page.address in state.said[0]
say(state.page.address)
say(urllib.request.urlopen(state.page.address).read().decode()[:9])
bpy.ops.preferences.addon_disable(module="limpid_blender")
""")
        self.assertIn("no plates of frame 2 in ", no_plates)
        self.assertIn("did you mean 'density'?", wrong)  # the page begins with the changes of the panel
        self.assertRegex(address, "http://127.0.0.1:")
        self.assertEqual(page.lower(), "<!doctype")
        with self.assertRaises(OSError):  # the add-on is gone, and the page with it
            urllib.request.urlopen(address)

    def test_the_page_ends_with_a_blender_that_is_killed(self):
        file = self.scene("lake")
        script = self.folder / "killed.py"
        script.write_text("""
import bpy, os, signal
settings = bpy.context.scene.limpid
settings.water_kind, settings.samples, settings.overscan_kind, settings.folder = "HEIGHT", 1, "FIXED", "//killed"
bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = 64, 36
bpy.ops.limpid.wet(frames="2")
bpy.ops.limpid.view(frames="2")
from limpid_blender.state import state
print("address", state.page.address, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
""")
        said = self.blender("--addons", "limpid_blender", file, "-P", script, code=-signal.SIGKILL)
        port = int(re.search(r"(?m)^address http://127.0.0.1:(\d+)/", said)[1])
        with self.assertRaises(ConnectionRefusedError):
            while True:  # a connection ends with the server, or when the server is tired of it
                with contextlib.suppress(ConnectionResetError), socket.create_connection(("127.0.0.1", port)) as connection:
                    while connection.recv(1):
                        pass


if __name__ == "__main__":
    unittest.main()
