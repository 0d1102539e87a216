"""Imports a glTF scene and compares what came of it with the file.

    blender -b --python-exit-code 1 -P tools/blender_check.py -- SCENE.gltf
"""
import json
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import blender_scene  # noqa: E402


def main():
    (path,) = blender_scene.arguments("tools/blender_check.py -- SCENE.gltf", 1)
    gltf = json.loads(pathlib.Path(path).read_text())
    blender_scene.import_scene(path)
    accessors = gltf["accessors"]
    def triangles_of(mesh):
        return sum(accessors[part["indices"]]["count"] // 3 for part in mesh["primitives"])
    def base_of(material):  # Blender leaves out images that only limpid's extras name
        return material["pbrMetallicRoughness"].get("baseColorTexture", {}).get("index")
    expected = {
        "triangles": sum(triangles_of(gltf["meshes"][node["mesh"]]) for node in gltf["nodes"]
                         if "mesh" in node),
        "materials": len(gltf["materials"]),
        "images": len({base_of(material) for material in gltf["materials"]} - {None}),
        "cameras": len(gltf["cameras"]),
        "lights": len(gltf["extensions"]["KHR_lights_punctual"]["lights"]),
        "water": sum("extras" in node for node in gltf["nodes"]),
    }
    found = {
        "triangles": sum(len(thing.data.polygons) for thing in bpy.data.objects
                         if thing.type == "MESH"),
        "materials": len(bpy.data.materials),
        "images": sum(image.size[0] > 0 for image in bpy.data.images),
        "cameras": len(bpy.data.cameras),
        "lights": len(bpy.data.lights),
        "water": len(blender_scene.water()),
    }
    if found != expected:
        raise RuntimeError(f"{path}: found {found}, expected {expected}")
    print(f"imported {pathlib.Path(path).name}: "
          + ", ".join(f"{count} {what}" for what, count in found.items()))


main()
