"""The silhouette of a glTF scene, seen by its camera: white where there is an object, black where
the background shows; the water is left out. One sample at the centre of each pixel, no filter.

    blender -b --python-exit-code 1 -P tools/blender_mask.py -- SCENE.gltf OUT.png WIDTH HEIGHT
"""
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import blender_scene  # noqa: E402


def white(backface_culling):
    """Emits 1; what is one-sided is seen through from behind, as glTF says."""
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    surface = nodes.new("ShaderNodeEmission").outputs[0]
    if backface_culling:
        mix = nodes.new("ShaderNodeMixShader")
        links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], mix.inputs[0])
        links.new(surface, mix.inputs[1])
        links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[2])
        surface = mix.outputs[0]
    links.new(surface, output.inputs[0])
    return material


def main():
    path, out, width, height = blender_scene.arguments(
        "tools/blender_mask.py -- SCENE.gltf OUT.png WIDTH HEIGHT", 4)
    blender_scene.import_scene(path)
    for thing in blender_scene.water():
        bpy.data.objects.remove(thing)
    one_sided, two_sided = white(True), white(False)
    for mesh in bpy.data.meshes:
        for slot, material in enumerate(mesh.materials):
            mesh.materials[slot] = one_sided if material.use_backface_culling else two_sided
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("black")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    scene.view_settings.view_transform = "Standard"
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01  # the centre of the pixel
    scene.cycles.transparent_max_bounces = 64
    scene.render.image_settings.color_mode = "BW"
    scene.render.dither_intensity = 0
    blender_scene.render(str(pathlib.Path(out).resolve()), width, height, 1)


main()
