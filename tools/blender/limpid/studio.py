"""The copy of the scene, prepared for its passes. The copy is never saved, so changes are not restored."""
import math

import bpy
from mathutils import Matrix, Vector

from .exr_window import place
from .frames import camera_at
from .lens import Lens, widened
from .level import crosses, level_of
from .light import even_sky, sun_color
from .scene_file import LAYER, SceneFacts
from .sight import CROSSING, cut_group, depth_material, material_of, sunlit_group
from .words import Failure

SHOWN = {"MESH", "CURVE", "SURFACE", "FONT", "META", "CURVES", "POINTCLOUD", "VOLUME"}


def expect_camera(camera):
    """Returns the camera. Throws Failure without a camera, and for a kind that limpid does not support."""
    if camera is None:
        raise Failure("no camera: expected a perspective or orthographic camera in the scene")
    if camera.data.type not in ("PERSP", "ORTHO"):
        raise Failure(f"camera '{camera.name}' is panoramic: expected a perspective or orthographic camera")
    return camera


class Studio:
    def __init__(self, job):
        self.job = job
        self.scene = bpy.data.scenes[job.scene]
        self.layer = self.scene.view_layers[job.view_layer]
        bpy.context.window.scene = self.scene
        bpy.context.window.view_layer = self.layer
        self._make_local()
        # Names are unique only now, when all data is local.
        self.sun = self.scene.objects[job.sun] if job.sun else None
        self.water = self.scene.objects[job.water] if job.water else None
        self.sheet = self.water if job.waves == "OBJECT" else self._make_sheet()
        self._settle()
        self._give_plain_materials()
        self.cut, self.sunlit = cut_group(), sunlit_group()
        self._dress_water()
        self.materials = [material for material in bpy.data.materials
                          if material.node_tree and material not in (self.sunlit_material, self.depth_material)]
        self.camera = bpy.data.objects.new("limpid camera", bpy.data.cameras.new("limpid camera"))
        self.scene.collection.objects.link(self.camera)

    # ---- once

    def _make_local(self):
        """Makes linked library data local: linked data is read-only, and passes change visibility and shaders."""
        for things in (bpy.data.objects, bpy.data.materials, bpy.data.lights, bpy.data.worlds, bpy.data.collections):
            for thing in list(things):
                if thing.library:
                    thing.make_local()

    def _make_sheet(self):
        """The level water: a plane up to the camera's far clip, or the outline of the object."""
        mesh = bpy.data.meshes.new("limpid water")
        mesh.from_pydata([(x, y, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [], [(0, 1, 2, 3)])
        sheet = bpy.data.objects.new("limpid water", mesh)
        self.scene.collection.objects.link(sheet)
        return sheet

    def _settle(self):
        """Sets the options that all passes share."""
        scene, render = self.scene, self.scene.render
        for layer in scene.view_layers:
            layer.use = layer == self.layer
        self.layer.name = LAYER
        render.engine = "CYCLES"
        render.use_compositing = render.use_sequencer = render.use_border = render.use_multiview = False
        render.use_file_extension = render.use_overwrite = True
        render.use_single_layer = False
        percentage = render.resolution_percentage / 100
        self.size = (max(1, int(render.resolution_x * percentage)), max(1, int(render.resolution_y * percentage)))
        self.aspect = render.pixel_aspect_x, render.pixel_aspect_y
        render.resolution_percentage = 100
        self.write_layers()
        self.layer.material_override = None
        self.layer.use_pass_combined = self.layer.use_pass_z = True
        self.samples = self.job.samples or scene.cycles.samples
        self.bound = [(marker.frame, marker.camera) for marker in scene.timeline_markers if marker.camera]
        for marker in scene.timeline_markers:
            marker.camera = None
        self.own_camera = scene.camera
        if self.sun:
            for group in list(self.layer.lightgroups):
                self.layer.lightgroups.remove(group)
            self.layer.lightgroups.add(name="sun")
            self.sun.lightgroup = "sun"

    def write_layers(self, many=True):
        """Makes renders write all layers and passes, or the picture alone."""
        settings = self.scene.render.image_settings
        if hasattr(settings, "media_type"):  # since 5.0
            settings.media_type = "MULTI_LAYER_IMAGE" if many else "IMAGE"
        settings.file_format = "OPEN_EXR_MULTILAYER" if many else "OPEN_EXR"
        settings.color_depth, settings.exr_codec = "32", "ZIP"

    def _give_plain_materials(self):
        """Gives Blender's default gray to objects without a material: only a material can be made transparent."""
        self.plain = plain = bpy.data.materials.new("limpid plain")
        plain.use_nodes = True
        nodes = plain.node_tree.nodes
        nodes.clear()
        gray = nodes.new("ShaderNodeBsdfDiffuse")
        plain.node_tree.links.new(gray.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        for thing in bpy.data.objects:
            if thing.type not in SHOWN or not hasattr(thing.data, "materials"):
                continue
            if not thing.material_slots:
                if thing.data.library:
                    thing.data.make_local()
                thing.data.materials.append(plain)
            for slot in thing.material_slots:
                if slot.material is None:
                    slot.link = "OBJECT"
                    slot.material = plain
        for material in list(bpy.data.materials):
            if not material.use_nodes and not material.grease_pencil:
                material.use_nodes = True
                nodes = material.node_tree.nodes
                nodes.clear()
                color = nodes.new("ShaderNodeBsdfDiffuse")
                color.inputs["Color"].default_value = material.diffuse_color
                material.node_tree.links.new(color.outputs[0],
                                             nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])

    def _dress_water(self):
        self.sunlit_material, self.depth_material = material_of(self.sunlit), depth_material()
        mesh = self.sheet.data
        if mesh.library:
            mesh.make_local()
        if not self.sheet.material_slots:
            mesh.materials.append(self.sunlit_material)
        for slot in self.sheet.material_slots:
            slot.link = "OBJECT"
            slot.material = self.sunlit_material
        self.sheet.hide_render = True
        if self.water:
            self.water.hide_render = True

    # ---- each frame

    def at(self, frame):
        """Goes to the frame, and returns its facts for the scene file, without the plates."""
        scene = self.scene
        scene.camera = camera_at(frame, self.bound) or self.own_camera
        scene.frame_set(frame)
        camera = expect_camera(scene.camera)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        self.height, self.trough, self.crest = self._levels(depsgraph)
        position, turn, _ = camera.matrix_world.decompose()
        self.world = Matrix.Translation(position) @ turn.to_matrix().to_4x4()
        self.source = camera
        projection = camera.calc_matrix_camera(depsgraph, x=self.size[0], y=self.size[1], scale_x=self.aspect[0],
                                               scale_y=self.aspect[1])
        self.pixel = 2 / (projection[0][0] * self.size[0])  # its width, at distance 1
        facts = SceneFacts(view=[list(row) for row in self.world.inverted()],
                           projection=[list(row) for row in projection], near=camera.data.clip_start,
                           far=camera.data.clip_end, height=self.height,
                           time=frame * scene.render.fps_base / scene.render.fps)
        if self.sun:
            facts.sun_direction = tuple(self.towards_sun())
            facts.sun_color = sun_color(self.sun.data, scene.cycles.film_exposure)
            facts.sun_diameter = math.degrees(self.sun.data.angle)
        facts.sky = even_sky(scene.world, scene.cycles.film_exposure)
        return facts

    def _levels(self, depsgraph):
        if not self.job.water:
            far = 4 * self.scene.camera.data.clip_end
            self.sheet.matrix_world = Matrix.LocRotScale(Vector((0, 0, self.job.height)), None, Vector((far, far, 1)))
            return (self.job.height,) * 3
        level = level_of(self.water, depsgraph)
        if level is None:
            raise Failure(f"water '{self.water.name}' has no level face: expected a mesh with a level surface")
        if self.sheet == self.water:
            return level
        self._level(depsgraph, level[0])
        return (level[0],) * 3

    def _level(self, depsgraph, height):
        """Gives the sheet the mesh of the water, all of it at the height: the water of the look has no waves of the mesh."""
        water = self.water.evaluated_get(depsgraph)
        mesh = bpy.data.meshes.new_from_object(water)
        mesh.transform(Matrix.Translation((0, 0, height)) @ Matrix.Diagonal((1, 1, 0, 1)) @ water.matrix_world)
        mesh.materials.clear()
        mesh.materials.append(self.sunlit_material)
        before, self.sheet.data = self.sheet.data, mesh
        bpy.data.meshes.remove(before)

    def mark_crossing(self, low, high):
        """Marks the objects that water between the heights may cut."""
        crossing = {instance.object.original.name for instance in bpy.context.evaluated_depsgraph_get().object_instances
                    if instance.object.type in SHOWN and crosses(instance.object, instance.matrix_world, low, high)}
        for thing in bpy.data.objects:
            value = float(thing.name in crossing)
            if thing.get(CROSSING) != value:
                thing[CROSSING] = value
                thing.update_tag()

    def towards_sun(self):
        return (self.sun.matrix_world.to_3x3() @ Vector((0, 0, 1))).normalized()

    def is_under_water(self):
        return self.world.translation.z <= self.height

    def aim(self, size, overscan, mirrored=False):
        """Sets up the camera of the passes: the scene's, with overscan; or its mirror image at the water."""
        scene, source = self.scene, self.source.data
        lens = Lens(source.sensor_fit, source.sensor_width, source.sensor_height, source.ortho_scale, source.shift_x,
                    source.shift_y)
        data = source.copy()
        data.animation_data_clear()
        for name, value in vars(widened(lens, size, self.aspect, overscan)).items():
            setattr(data, name, value)
        if data.dof.focus_object:
            focus = self.world.inverted() @ data.dof.focus_object.matrix_world.translation
            data.dof.focus_object, data.dof.focus_distance = None, abs(focus.z)
        before, self.camera.data = self.camera.data, data
        bpy.data.cameras.remove(before)
        mirror = Matrix.Translation((0, 0, 2 * self.height)) @ Matrix.Diagonal((1, 1, -1, 1))
        self.camera.matrix_world = mirror @ self.world if mirrored else self.world
        scene.camera = self.camera
        scene.render.resolution_x, scene.render.resolution_y = overscan.around(size)

    def render(self, path, overscan):
        """Renders the current scene into an EXR of all passes, with overscan."""
        self.render_all(path)
        place(path, overscan)

    def render_all(self, path):
        """Renders the current scene into a file that does not tell picture and overscan apart."""
        self.scene.render.filepath = path
        try:
            result = bpy.ops.render.render(write_still=True, scene=self.scene.name)
        except RuntimeError as fault:
            raise Failure(f"Blender could not render {path}: {str(fault).strip().removeprefix('Error: ')}") from fault
        if "FINISHED" not in result:
            raise Failure(f"Blender stopped the render of {path}")
