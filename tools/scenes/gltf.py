"""A glTF 2.0 scene in the making: materials, meshes, nodes, a camera and a sun."""
import json

import numpy as np

from . import png

FLOAT, USHORT, UINT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


def plain(values, digits=6):
    return [round(float(v), digits) + 0.0 for v in values]


def rotation_of(right, up, back):
    """The quaternion (x, y, z, w) that turns the axes into these three."""
    m = np.array([right, up, back]).T
    w = np.sqrt(max(0.0, 1 + m[0, 0] + m[1, 1] + m[2, 2])) / 2
    x = np.copysign(np.sqrt(max(0.0, 1 + m[0, 0] - m[1, 1] - m[2, 2])) / 2, m[2, 1] - m[1, 2])
    y = np.copysign(np.sqrt(max(0.0, 1 - m[0, 0] + m[1, 1] - m[2, 2])) / 2, m[0, 2] - m[2, 0])
    z = np.copysign(np.sqrt(max(0.0, 1 - m[0, 0] - m[1, 1] + m[2, 2])) / 2, m[1, 0] - m[0, 1])
    return plain([x, y, z, w], 9)


def facing(direction):
    """The rotation of a thing that looks down its -Z, so that it looks along `direction`."""
    back = -np.asarray(direction, float) / np.linalg.norm(direction)
    right = np.cross([0, 1, 0], back)
    right /= np.linalg.norm(right)
    return rotation_of(right, np.cross(back, right), back)


def turned(degrees, axis=(0, 1, 0)):
    half = np.radians(degrees) / 2
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    return plain([*(np.sin(half) * axis), np.cos(half)], 9)


class Scene:
    def __init__(self, sentence, background):
        self.sentence = sentence
        self._textures = {}
        self._binary = bytearray()
        self._gltf = {
            "asset": {"version": "2.0", "generator": "limpid tools/make_scenes"},
            "extensionsUsed": ["KHR_lights_punctual"],
            "scene": 0,
            "scenes": [{"nodes": [], "extras": {"limpid": {"background": plain(background)}}}],
            "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [],
        }

    # --- looks ---

    def texture(self, name, picture):
        """A texture of its own file, NAME_SCENE.png; returns its index."""
        self._textures[name] = png.encode(picture)
        return len(self._textures) - 1

    def material(self, name, color=(1, 1, 1), texture=None, double_sided=False, **extras):
        """`extras` are limpid's: shading, ambient, power, specular, specular_texture."""
        base = {"baseColorFactor": plain([*color, 1]), "metallicFactor": 0, "roughnessFactor": 0.8}
        if texture is not None:
            base["baseColorTexture"] = {"index": texture}
        material = {"name": name, "pbrMetallicRoughness": base}
        if double_sided:
            material["doubleSided"] = True
        if extras:
            if "specular_texture" in extras:
                extras["specular_texture"] = {"index": extras["specular_texture"]}
            material["extras"] = {"limpid": extras}
        return self._add("materials", material)

    # --- shapes ---

    def mesh(self, name, *parts):
        """`parts` are pairs of a shape and a material."""
        primitives = []
        for shape, material in parts:
            shape.check()
            attributes = {"POSITION": self._accessor(shape.positions, "VEC3", True)}
            if shape.normals is not None:
                attributes["NORMAL"] = self._accessor(shape.normals, "VEC3")
            if shape.uvs is not None:
                attributes["TEXCOORD_0"] = self._accessor(shape.uvs, "VEC2")
            primitives.append({"attributes": attributes, "material": material,
                               "indices": self._indices(shape.triangles)})
        return self._add("meshes", {"name": name, "primitives": primitives})

    def node(self, name, mesh, at=(0, 0, 0), rotation=None, scale=None):
        node = {"name": name, "mesh": mesh, "translation": plain(at)}
        if rotation is not None:
            node["rotation"] = rotation
        if scale is not None:
            node["scale"] = plain(np.broadcast_to(scale, 3))
        return self._root(node)

    def water(self, shape):
        """The surface; blended in other programs, so that one sees the ground through it."""
        material = self._add("materials", {
            "name": "water", "alphaMode": "BLEND", "doubleSided": True,
            "pbrMetallicRoughness": {"baseColorFactor": [0.05, 0.25, 0.3, 0.4],
                                     "metallicFactor": 0, "roughnessFactor": 0.05}})
        mesh = self.mesh("water", (shape, material))
        self._root({"name": "water", "mesh": mesh, "extras": {"limpid": {"water": True}}})

    # --- camera and sun ---

    def camera(self, eye, target, fov_y, near, far, aspect=16 / 9):
        lens = {"yfov": round(float(np.radians(fov_y)), 9), "aspectRatio": round(aspect, 9),
                "znear": near, "zfar": far}
        self._gltf["cameras"] = [{"name": "camera", "type": "perspective", "perspective": lens}]
        self._root({"name": "camera", "camera": 0, "translation": plain(eye),
                    "rotation": facing(np.subtract(target, eye))})

    def sun(self, towards, color, intensity):
        light = {"name": "sun", "type": "directional", "color": plain(color),
                 "intensity": intensity}
        self._gltf["extensions"] = {"KHR_lights_punctual": {"lights": [light]}}
        self._root({"name": "sun", "rotation": facing(-np.asarray(towards, float)),
                    "extensions": {"KHR_lights_punctual": {"light": 0}}})

    # --- writing ---

    def triangles(self):
        accessors = self._gltf["accessors"]
        corners = [sum(accessors[part["indices"]]["count"] for part in mesh["primitives"])
                   for mesh in self._gltf["meshes"]]
        return sum(corners[node["mesh"]] for node in self._gltf["nodes"] if "mesh" in node) // 3

    def save(self, folder, name):
        """Returns the bytes written."""
        gltf = dict(self._gltf)
        gltf["buffers"] = [{"uri": f"{name}.bin", "byteLength": len(self._binary)}]
        files = {f"{name}.bin": bytes(self._binary)}
        if self._textures:
            images = [f"{name}_{texture}.png" for texture in self._textures]
            files.update(zip(images, self._textures.values()))
            gltf["images"] = [{"uri": image, "mimeType": "image/png"} for image in images]
            gltf["samplers"] = [{"magFilter": 9729, "minFilter": 9987}]
            gltf["textures"] = [{"source": i, "sampler": 0} for i in range(len(images))]
        files[f"{name}.gltf"] = (json.dumps(gltf, separators=(",", ":"), allow_nan=False) + "\n").encode()
        for file, data in files.items():
            (folder / file).write_bytes(data)
        return sum(len(data) for data in files.values())

    # --- parts ---

    def _add(self, kind, thing):
        self._gltf[kind].append(thing)
        return len(self._gltf[kind]) - 1

    def _root(self, node):
        self._gltf["scenes"][0]["nodes"].append(self._add("nodes", node))

    def _view(self, data, target):
        view = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": len(data),
                "target": target}
        self._binary += data + b"\0" * (-len(data) % 4)
        return self._add("bufferViews", view)

    def _accessor(self, values, kind, bounds=False):
        # Rounded, so that the last bits of a sine do not depend on the machine.
        values = np.round(values, 5).astype("<f4") + np.float32(0)
        accessor = {"bufferView": self._view(values.tobytes(), ARRAY_BUFFER),
                    "componentType": FLOAT, "count": len(values), "type": kind}
        if bounds:
            accessor["min"] = [float(v) for v in values.min(axis=0)]
            accessor["max"] = [float(v) for v in values.max(axis=0)]
        return self._add("accessors", accessor)

    def _indices(self, triangles):
        small = triangles.max() < 65535
        data = triangles.astype("<u2" if small else "<u4").tobytes()
        return self._add("accessors", {
            "bufferView": self._view(data, ELEMENT_ARRAY_BUFFER), "type": "SCALAR",
            "componentType": USHORT if small else UINT, "count": triangles.size})
