"""Renders a scene of Blender's with Cycles, without its water, and lets limpid put that in.

    blender -b [SCENE.blend] --python-exit-code 1 -P wet.py -- --out wet.exr

A flat mesh called `water` says where the water is; it is never rendered as water. Without a scene a
pool is made. Writes wet.exr, scene-linear, and wet.png to look at. Besides limpid it needs Python's
OpenImageIO; Blender's Python must be the one that both are installed for, as it is in Debian.
"""
import argparse
import pathlib
import sys
import tempfile

import bpy
import numpy as np
import OpenImageIO as oiio
from mathutils import Euler, Vector

import limpid

# Rows of amplitude, k_x, k_y, phase: metres, rad / m, rad.
WAVES = [[0.006, 5.1, 2.0, 0.3], [0.004, -3.2, 7.4, 2.1], [0.002, 11.0, -4.7, 4.0], [0.001, 8.0, 17.0, 1.2]]
OVERSCAN = 0.15  # of the picture's longer side, rendered on each side: refracted rays leave the picture
SUN = (.75, .25, .6)  # of the pool: the lamp's rotation


def arguments():
    parser = argparse.ArgumentParser(prog="wet.py", description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=pathlib.Path, required=True, help="EXR to write")
    parser.add_argument("--look", default="physical", help="name, or look file")
    parser.add_argument("--samples", type=int, default=64, help="of each pixel of a render")
    parser.add_argument("--size", default="640x360", help="in pixels")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


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


def make_pool():
    """A tiled pool with things in it that pierce the water, stand in it and lie below it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    tiles = material("tiles", ("ShaderNodeTexChecker", {"Color1": (.75, .78, .74, 1), "Color2": (.3, .48, .52, 1),
                                                        "Scale": 10.0}), ("ShaderNodeBsdfDiffuse", {}))
    def put(add, look, scale=(1, 1, 1), **where):
        add(**where)
        thing = bpy.context.object
        thing.scale = scale
        thing.data.materials.append(look)
        return thing
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
    bpy.ops.object.light_add(type="SUN", rotation=SUN)
    bpy.context.object.data.energy, bpy.context.object.data.angle = 3.5, 0.01
    bpy.ops.object.camera_add(location=(0.6, -8.6, 4.2), rotation=(1.09, 0, .05))
    bpy.context.scene.camera = bpy.context.object
    world = bpy.context.scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    sky.sky_type, sky.turbidity = "PREETHAM", 2.5
    sky.sun_direction = Euler(SUN).to_matrix() @ Vector((0, 0, 1))
    world.node_tree.links.new(sky.outputs[0], world.node_tree.nodes["Background"].inputs["Color"])
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.35


def widen(camera, width, height):
    """Renders more than the picture on all sides, at the same scale. The picture in it: x0, y0, x1, y1."""
    render, lens = bpy.context.scene.render, camera.data
    margin = round(OVERSCAN * max(width, height))
    render.resolution_x, render.resolution_y = width + 2 * margin, height + 2 * margin
    across = lens.sensor_fit == "HORIZONTAL" or (lens.sensor_fit == "AUTO" and width >= height)
    ratio = 1 + 2 * margin / (width if across else height)
    lens.sensor_width, lens.sensor_height = ratio * lens.sensor_width, ratio * lens.sensor_height
    lens.ortho_scale *= ratio
    lens.shift_x, lens.shift_y = lens.shift_x / ratio, lens.shift_y / ratio
    return margin, margin, margin + width, margin + height


def the_only(what, wanted):
    things = [thing for thing in bpy.context.scene.objects if wanted(thing)]
    if len(things) != 1:
        raise SystemExit(f"wet.py: {len(things)} {what} in the scene, expected one")
    return things[0]


def render(folder, name):
    """Renders the scene as it is now. Its passes by name, as arrays whose row 0 is the top."""
    scene = bpy.context.scene
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(folder / f"{name}.exr")
    bpy.ops.render.render(write_still=True)
    picture = oiio.ImageInput.open(scene.render.filepath)
    pixels, names = picture.read_image(oiio.FLOAT), picture.spec().channelnames
    picture.close()
    def channels(of, letters):
        return pixels[..., [names.index(f"{bpy.context.view_layer.name}.{of}.{letter}") for letter in letters]]
    return {"color": channels("Combined", "RGBA"), "depth": channels("Depth", "Z"),
            "normal": channels("Normal", "XYZ")}


def cut(look, up, height):
    """Lets the camera see through all of a material above a height, and out of what was cut from inside."""
    tree = look.node_tree
    end = tree.get_output_node("CYCLES")
    if not end or not end.inputs["Surface"].is_linked:
        return
    surface = end.inputs["Surface"].links[0].from_socket
    def node(kind, *inputs, **settings):
        made = tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(made, name, value)
        for socket, value in zip(made.inputs, inputs):
            if isinstance(value, bpy.types.NodeSocket):
                tree.links.new(value, socket)
            else:
                socket.default_value = value
        return made.outputs
    def math(operation, *inputs):
        return node("ShaderNodeMath", *inputs, operation=operation)[0]
    here, path = node("ShaderNodeNewGeometry"), node("ShaderNodeLightPath")
    above = math("GREATER_THAN", node("ShaderNodeVectorMath", here["Position"], up, operation="DOT_PRODUCT")["Value"],
                 height)
    inside = math("MULTIPLY", here["Backfacing"], math("GREATER_THAN", path["Transparent Depth"], 0.5))
    seen_through = math("MULTIPLY", path["Is Camera Ray"], math("MAXIMUM", above, inside))
    mixed = node("ShaderNodeMixShader", seen_through, surface, node("ShaderNodeBsdfTransparent")[0])[0]
    tree.links.new(mixed, end.inputs["Surface"])


def render_below(folder, up, height):
    """What lies under a height, which is lit and shaded as it was: the camera sees through the rest."""
    plain = diffuse("plain", .8, .8, .8)  # Blender's own for what has no material
    for thing in bpy.context.scene.objects:
        if thing.type != "LIGHT" and hasattr(thing.data, "materials") and not any(thing.data.materials):
            thing.data.materials.clear()
            thing.data.materials.append(plain)
    for look in bpy.data.materials:
        if look.use_nodes:
            cut(look, up, height)
    passes = render(folder, "below")
    nothing = passes["depth"][..., 0] > 1e9
    passes["depth"][nothing] = np.inf
    return passes


def render_mirror(folder, water):
    """The water as a mirror, which alone meets the camera: everything else is seen in it only."""
    others = [thing for thing in bpy.context.scene.objects if thing is not water and thing.visible_camera]
    for thing in others:
        thing.visible_camera = False
    water.hide_render, water.visible_diffuse, water.visible_shadow = False, False, False
    mirror = material("mirror", ("ShaderNodeBsdfGlossy", {"Color": (1, 1, 1, 1), "Roughness": 0.0}))
    water.data.materials.clear()
    water.data.materials.append(mirror)
    passes = render(folder, "mirror")
    water.hide_render = True
    for thing in others:
        thing.visible_camera = True
    return passes


def render_shadow(folder, sun, towards_sun, samples):
    """The sun's visibility: what a white scene has of its light, and what it had without shadows."""
    scene, layer = bpy.context.scene, bpy.context.view_layer
    scene.world, layer.material_override = None, diffuse("white", 1, 1, 1)
    scene.cycles.max_bounces, scene.cycles.samples = 0, min(samples, 16)
    for lamp in scene.objects:
        if lamp.type == "LIGHT" and lamp is not sun:
            lamp.hide_render = True
    sun.data.color = (1, 1, 1)
    passes = render(folder, "shadow")
    facing = np.maximum(passes["normal"] @ np.float32(towards_sun), 0)
    lit = passes["color"][..., 0] / np.maximum(sun.data.energy / np.pi * facing, 1e-3)
    return np.where(facing > 0.02, np.clip(lit, 0, 1), 0).astype(np.float32)


def save(path, wet):
    """The EXR, and beside it the same as sRGB to look at."""
    spec = oiio.ImageSpec(wet.shape[1], wet.shape[0], 4, oiio.HALF)
    for target, kind in ((path, oiio.HALF), (path.with_suffix(".png"), oiio.UINT8)):
        picture = oiio.ImageBuf(spec)
        picture.set_pixels(spec.roi, wet)
        if kind == oiio.UINT8:
            picture = oiio.ImageBufAlgo.colorconvert(picture, "linear", "sRGB")
        if not picture.write(str(target), kind):
            raise SystemExit(f"wet.py: {picture.geterror()}")


def main():
    wanted = arguments()
    if not bpy.data.filepath:
        make_pool()
    scene = bpy.context.scene
    water = the_only("meshes 'water'", lambda thing: thing.type == "MESH" and thing.name == "water")
    sun = the_only("suns", lambda thing: thing.type == "LIGHT" and thing.data.type == "SUN")
    width, height = map(int, wanted.size.split("x"))
    scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
    scene.cycles.samples, scene.cycles.use_denoising = wanted.samples, False
    scene.render.resolution_percentage, scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = 100, 1, 1
    scene.render.use_compositing = scene.render.use_sequencer = False
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = True
    water.hide_render = True

    # What limpid needs to know, in Blender's own words: metres, z up, matrices for column vectors.
    bpy.context.view_layer.update()
    camera = scene.camera
    view = camera.matrix_world.normalized().inverted()
    projection = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=width, y=height)
    display = widen(camera, width, height)
    up = (water.matrix_world.to_3x3() @ Vector((0, 0, 1))).normalized()
    level = up.dot(water.matrix_world.translation)
    to_sun = (sun.matrix_world.to_3x3() @ Vector((0, 0, 1))).normalized()
    sunlight = [channel * sun.data.energy / np.pi for channel in sun.data.color]  # as radiance of white
    look = limpid.load_look(wanted.look)
    look["wave_normals"].update(model="sines", waves=WAVES, strength=1.0)

    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        dry = render(folder, "dry")
        mirror = render_mirror(folder, water)
        below = render_below(folder, up, level + sum(wave[0] for wave in WAVES))  # to the crests
        shadow = render_shadow(folder, sun, to_sun, wanted.samples)

    # The mirror is real where the water is; inside of things that pierce it there is no light.
    mirrored = mirror["color"][..., :3]
    real = (mirror["depth"][..., 0] < 1e9) & mirrored.any(axis=2)
    compositor = limpid.Compositor(look=look)
    wet = compositor.run(
        display=display, color=dry["color"], depth=dry["depth"],  # Cycles' Z is eye depth, 1e10 where nothing was hit
        shadow=shadow, reflection=mirrored, reflection_valid=real.astype(np.float32),
        below_color=below["color"][..., :3], below_depth=below["depth"],
        surface_depth=mirror["depth"], camera=limpid.Camera(view, projection),
        water={"up": up, "height": level},
        sun={"direction": to_sun, "color": sunlight})
    save(wanted.out, wet)
    print(compositor.plan)
    print(f"written: {wanted.out}, {wanted.out.with_suffix('.png')}")


main()
