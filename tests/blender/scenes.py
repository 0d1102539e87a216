"""The scenes of the tests, made in Blender: blender -b --factory-startup -P scenes.py -- NAME FILE.blend

pool    a tiled pool with a ball through its surface, a post, a cube below, a sheet `water`, Blender's sky
lake    a hilly ground, water by its height alone, animated camera, an even sky
sea     an ocean modifier's waves, a rock, an orthographic camera, a picture of the sky
"""
import sys

import bpy
from mathutils import Euler, Vector

SUN = (.75, .25, .6)


def material(name, *nodes_of):
    """A material whose surface is the last node; each node is (type, inputs), fed by the one before."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    before = None
    for kind, inputs in nodes_of:
        node = nodes.new(kind)
        for key, value in inputs.items():
            node.inputs[key].default_value = value
        if before:
            links.new(before.outputs["Color"], node.inputs["Color"])
        before = node
    links.new(before.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def diffuse(name, *color):
    return material(name, ("ShaderNodeBsdfDiffuse", {"Color": (*color, 1)}))


def put(add, look, scale=(1, 1, 1), **where):
    add(**where)
    thing = bpy.context.object
    thing.scale = scale
    if look:
        thing.data.materials.append(look)
    return thing


def add_sun(rotation=SUN, energy=3.5):
    bpy.ops.object.light_add(type="SUN", rotation=rotation)
    bpy.context.object.data.energy, bpy.context.object.data.angle = energy, 0.01


def add_camera(**where):
    bpy.ops.object.camera_add(**where)
    bpy.context.scene.camera = bpy.context.object
    return bpy.context.object


def add_world(color=(.3, .4, .6, 1), strength=1.0):
    world = bpy.context.scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    world.cycles.sampling_method = "NONE"  # a map of what is bright in the sky takes longer than these renders
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = color, strength
    return world.node_tree, background


def pool():
    tiles = material("tiles", ("ShaderNodeTexChecker", {"Color1": (.75, .78, .74, 1), "Color2": (.3, .48, .52, 1),
                                                        "Scale": 10.0}), ("ShaderNodeBsdfDiffuse", {}))
    mesh, stone = bpy.ops.mesh, diffuse("stone", .55, .5, .42)
    put(mesh.primitive_plane_add, tiles, size=8, location=(0, 0, -1.4))
    for x, y, width, depth in ((-4.2, 0, .4, 8.8), (4.2, 0, .4, 8.8), (0, 4.2, 8, .4), (0, -4.2, 8, .4)):
        put(mesh.primitive_cube_add, stone, (width, depth, 1.7), size=1, location=(x, y, -.65))
    put(mesh.primitive_uv_sphere_add, diffuse("red", .7, .08, .05), radius=.8, location=(-1.6, .6, .1),
        segments=64, ring_count=32).data.polygons.foreach_set("use_smooth", [True] * (64 * 32))
    put(mesh.primitive_cylinder_add, diffuse("wood", .5, .3, .12), radius=.14, depth=3.4, location=(1.3, 1.6, .2))
    put(mesh.primitive_cube_add, diffuse("yellow", .8, .6, .08), size=.9, location=(1.5, -1.4, -.95),
        rotation=(0, 0, .6))
    put(mesh.primitive_plane_add, stone, size=8, location=(0, 0, 0)).name = "water"
    add_sun()
    add_camera(location=(0.6, -8.6, 4.2), rotation=(1.09, 0, .05))
    tree, background = add_world(strength=.35)
    sky = tree.nodes.new("ShaderNodeTexSky")
    sky.sky_type, sky.turbidity = "PREETHAM", 2.5
    sky.sun_direction = Euler(SUN).to_matrix() @ Vector((0, 0, 1))
    tree.links.new(sky.outputs[0], background.inputs["Color"])


def lake():
    ground = put(bpy.ops.mesh.primitive_grid_add, diffuse("ground", .4, .33, .2), size=40, x_subdivisions=80,
                 y_subdivisions=80)
    for vertex in ground.data.vertices:
        x, y = vertex.co.xy
        vertex.co.z = .12 * y - .9 + .25 * ((x * .7 + y) % 3 - 1.5) * .4
    put(bpy.ops.mesh.primitive_cone_add, diffuse("green", .05, .3, .07), radius1=1, depth=3, location=(2, 9, 1.5))
    put(bpy.ops.mesh.primitive_cube_add, None, size=1.2, location=(-1.5, 3, .1))
    add_sun((.9, 0, -.5), 2.0)
    camera = add_camera(location=(0, -9, 2), rotation=(1.4, 0, 0))
    camera.data.shift_x, camera.data.sensor_fit = .05, "VERTICAL"
    for frame, x in ((1, -1), (5, 1)):
        camera.location.x = x
        camera.keyframe_insert("location", frame=frame)
    add_world()


def sea():
    put(bpy.ops.mesh.primitive_plane_add, diffuse("sand", .6, .5, .3), size=60, location=(0, 0, -3))
    put(bpy.ops.mesh.primitive_ico_sphere_add, diffuse("rock", .2, .2, .22), radius=1.4, subdivisions=3,
        location=(1, 3, .2))
    water = put(bpy.ops.mesh.primitive_plane_add, diffuse("blue", 0, .1, .3), size=2, location=(0, 0, .5))
    water.name = "ocean"
    ocean = water.modifiers.new("Ocean", "OCEAN")
    ocean.geometry_mode, ocean.resolution, ocean.spatial_size, ocean.wave_scale = "GENERATE", 6, 30, 1
    add_sun()
    camera = add_camera(location=(0, -10, 6), rotation=(1.05, 0, 0))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 12
    tree, background = add_world()
    image = bpy.data.images.new("sky", 8, 4, float_buffer=True)
    image.pixels.foreach_set([channel for y in range(4) for x in range(8)
                              for channel in (.1 * x, .2 * y, .5, 1.0)])
    image.pack()
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = image
    tree.links.new(picture.outputs[0], background.inputs["Color"])


def main():
    name, path = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    {"pool": pool, "lake": lake, "sea": sea}[name]()
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    scene.render.resolution_x, scene.render.resolution_y = 160, 90
    bpy.ops.wm.save_as_mainfile(filepath=path)


main()
