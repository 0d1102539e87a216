"""A quick picture of a glTF scene with simple water, to judge how it is composed.

    blender -b --python-exit-code 1 -P tools/blender_preview.py -- SCENE.gltf OUT.png WIDTH HEIGHT
"""
import json
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import blender_scene  # noqa: E402


def make_mirror(thing):
    """Water that reflects by its angle and lets the rest through, tinted."""
    material = bpy.data.materials.new("simple water")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    output, mix = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeMixShader")
    fresnel, mirror = nodes.new("ShaderNodeFresnel"), nodes.new("ShaderNodeBsdfGlossy")
    through = nodes.new("ShaderNodeBsdfTransparent")
    fresnel.inputs["IOR"].default_value = 1.333
    mirror.inputs["Roughness"].default_value = 0.02
    through.inputs["Color"].default_value = (0.45, 0.78, 0.80, 1)
    links.new(fresnel.outputs[0], mix.inputs[0])
    links.new(through.outputs[0], mix.inputs[1])
    links.new(mirror.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], output.inputs[0])
    thing.data.materials.clear()
    thing.data.materials.append(material)


def main():
    path, out, width, height = blender_scene.arguments(
        "tools/blender_preview.py -- SCENE.gltf OUT.png WIDTH HEIGHT", 4)
    blender_scene.import_scene(path)
    for thing in blender_scene.water():
        make_mirror(thing)
    gltf = json.loads(pathlib.Path(path).read_text())
    light = gltf["extensions"]["KHR_lights_punctual"]["lights"][0]
    for lamp in bpy.data.lights:
        lamp.energy = 3.1416 * light["intensity"]
        lamp.angle = 0.01
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    background = gltf["scenes"][gltf["scene"]]["extras"]["limpid"]["background"]
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (*background, 1)
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.6
    scene.view_settings.view_transform = "Standard"
    scene.cycles.max_bounces = 4
    blender_scene.render(str(pathlib.Path(out).resolve()), width, height, 24)


main()
