#!/usr/bin/env python3
"""Writes 60 small glTF files, each with one or several features that exporters write.

    gltf_collection.py FOLDER

Writes NAME.gltf, with all its data, for each NAME of FILES in order, and beside it NAME.toml, a scene with the
same camera for all. TWINS lists pairs of files with equal pictures: the second of a pair has plain triangles only.
Every run writes the same bytes. Needs numpy.
"""
import base64
import json
import pathlib
import struct
import sys
import zlib

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from scenes import shapes  # noqa: E402

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
TYPES = {BYTE: "<i1", UBYTE: "<u1", SHORT: "<i2", USHORT: "<u2", UINT: "<u4", FLOAT: "<f4"}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
POINTS, LINES, STRIP, FAN = 0, 1, 5, 6
CLAMP, MIRROR = 33071, 33648

SCENE = """[geometry]
gltf = "{name}.gltf"
[camera]
view = [[1, 0, 0, 0], [0, 0.96, -0.28, 0], [0, 0.28, 0.96, -3.2], [0, 0, 0, 1]]
fov_y = 40
[water]
up = [0, 1, 0]
height = -0.8
[sun]
direction = [0.5, 1, 0.8]
"""

FILES = {}  # name -> function of a File
TWINS = {}  # name -> name of the file with the same picture without the feature


def file(twin=None):
    def add(make):
        FILES[make.__name__] = make
        if twin:
            TWINS[make.__name__] = twin
        return make
    return add


class File:
    def __init__(self):
        self.gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.binary = bytearray()

    def add(self, kind, thing):
        self.gltf.setdefault(kind, []).append(thing)
        return len(self.gltf[kind]) - 1

    def extension(self, *names, required=False):
        for name in names:
            self.add("extensionsUsed", name)
            if required:
                self.add("extensionsRequired", name)

    def view(self, data, **more):
        offset = len(self.binary)
        self.binary += data + b"\0" * (-len(data) % 4)
        return self.add("bufferViews", {"buffer": 0, "byteOffset": offset, "byteLength": len(data), **more})

    def accessor(self, values, kind=FLOAT, normalized=False):
        """Adds an accessor. Elements whose size is no multiple of four bytes are padded to one."""
        values = np.asarray(values)
        values = values.reshape(len(values), -1).astype(TYPES[kind])
        count, components = values.shape
        stride = {}
        if components > 1 and values.itemsize * components % 4:
            pad = -values.itemsize * components % 4 // values.itemsize
            values = np.pad(values, ((0, 0), (0, pad)))
            stride = {"byteStride": values.itemsize * (components + pad)}
        accessor = {"bufferView": self.view(values.tobytes(), **stride), "componentType": kind,
                    "count": count, "type": KINDS[components]}
        if normalized:
            accessor["normalized"] = True
        return self.add("accessors", accessor)

    def empty(self, count, components):
        return self.add("accessors", {"componentType": FLOAT, "count": count, "type": KINDS[components]})

    def sparse(self, values, base):
        """Adds a sparse accessor with the elements that differ from `base`; None: from zeros, without a buffer view."""
        values = np.asarray(values, "<f4")
        other = np.zeros_like(values) if base is None else np.asarray(base, "<f4")
        which = np.flatnonzero((values != other).any(axis=1))
        at = self.empty(*values.shape) if base is None else self.accessor(base)
        self.gltf["accessors"][at]["sparse"] = {
            "count": len(which),
            "indices": {"bufferView": self.view(which.astype("<u2").tobytes()), "componentType": USHORT},
            "values": {"bufferView": self.view(values[which].tobytes())}}
        return at

    def texture(self, picture, sampler=None, in_view=False):
        data = png(picture)
        if in_view:
            image = self.add("images", {"bufferView": self.view(data), "mimeType": "image/png"})
        else:
            image = self.add("images", {"uri": "data:image/png;base64," + base64.b64encode(data).decode()})
        texture = {"source": image}
        if sampler:
            texture["sampler"] = self.add("samplers", sampler)
        return self.add("textures", texture)

    def material(self, color=(0.8, 0.5, 0.3, 1), texture=None, info=None, **more):
        base = {"baseColorFactor": list(color)}
        if texture is not None:
            base["baseColorTexture"] = {"index": texture, **(info or {})}
        return self.add("materials", {"pbrMetallicRoughness": base, **more})

    def primitive(self, shape, material=None, **more):
        attributes = {"POSITION": self.accessor(shape.positions)}
        if shape.normals is not None:
            attributes["NORMAL"] = self.accessor(shape.normals)
        if shape.uvs is not None:
            attributes["TEXCOORD_0"] = self.accessor(shape.uvs)
        primitive = {"attributes": attributes, "indices": self.accessor(shape.triangles.reshape(-1, 1), USHORT),
                     "material": self.material() if material is None else material}
        primitive.update(more)
        return primitive

    def mesh(self, *primitives, **more):
        return self.add("meshes", {"primitives": list(primitives), **more})

    def node(self, root=True, **node):
        index = self.add("nodes", node)
        if root:
            self.gltf["scenes"][0]["nodes"].append(index)
        return index

    def show(self, *primitives, **node):
        return self.node(mesh=self.mesh(*primitives), **node)

    def text(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(bytes(self.binary)).decode()
        self.gltf["buffers"] = [{"byteLength": len(self.binary), "uri": uri}]
        return json.dumps(self.gltf, allow_nan=False) + "\n"


# --- pictures and meshes ---

def png(picture):
    """A PNG of RGB or RGBA with 8 bits."""
    picture = np.asarray(picture, np.uint8)
    height, width, channels = picture.shape

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + row.tobytes() for row in picture)
    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


def picture(alpha=False):
    """A picture with a different field in each corner, so that every rotation is visible."""
    y, x = np.mgrid[0:32, 0:32]
    cells = (x // 4 + y // 4) % 2
    colors = np.stack([255 - 5 * x, 60 + 6 * y, 80 + 100 * cells], -1)
    if not alpha:
        return colors
    holes = np.where((x - 15.5) ** 2 + (y - 15.5) ** 2 < 100, 40, 255)
    return np.concatenate([colors, holes[..., None]], -1)


def ball(radius=0.7):
    return shapes.ball(radius, 20, 10)


def box(size=0.5):
    return shapes.box((-size,) * 3, (size,) * 3)


def sheet(size=0.7, cells=6):
    """An upright square that faces the camera."""
    side = np.linspace(-size, size, cells + 1)
    shape = shapes.flat_grid(side, side)
    x, z = shape.positions[:, 0], shape.positions[:, 2]
    return shapes.Shape(np.stack([x, -z, 0 * x], -1), shape.triangles, np.tile([0.0, 0.0, 1.0], (len(x), 1)),
                        np.stack([x, z], -1) / (2 * size) + 0.5)


def post(rings=12):
    """A round post along Y, to be bent."""
    turn = np.linspace(0, 2 * np.pi, 13)
    angle, height = np.meshgrid(turn, np.linspace(0.7, -0.7, rings + 1))
    around = np.stack([np.sin(angle), 0 * angle, np.cos(angle)], -1).reshape(-1, 3)
    positions = 0.25 * around + height.reshape(-1, 1) * [0, 1, 0]
    columns = len(turn)
    a = (np.arange(rings)[:, None] * columns + np.arange(columns - 1)).ravel()
    triangles = np.concatenate([np.stack([a, a + columns, a + columns + 1], 1),
                                np.stack([a, a + columns + 1, a + 1], 1)])
    return shapes.Shape(positions, triangles, around, None)


def strip_of_sheet(cells=6):
    """A sheet as one strip: rows joined by triangles without area. Also the list of its triangles."""
    columns, corners = cells + 1, []
    for row in range(cells):
        line = [index for i in range(columns) for index in (row * columns + i, (row + 1) * columns + i)]
        corners += ([corners[-1], line[0]] if corners else []) + line
    triangles = [(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]) for i in range(len(corners) - 2)]
    return np.array(corners), np.array([t for t in triangles if len(set(t)) == 3])


def fan_of_disc(sides=16):
    turn = np.linspace(0, 2 * np.pi, sides + 1)
    rim = 0.7 * np.stack([np.cos(turn), np.sin(turn), 0 * turn], -1)
    positions = np.vstack([[0, 0, 0.3], rim])
    triangles = np.array([(i + 1, i + 2, 0) for i in range(sides)])
    return shapes.Shape(positions, triangles, None, None)


def without_normals(shape):
    return shapes.Shape(shape.positions, shape.triangles, None, shape.uvs)


# --- lists, strips, fans; storage of numbers ---

@file()
def triangles(f):
    f.show(f.primitive(ball()))


@file(twin="triangles")
def bytes_for_indices(f):
    shape = ball()
    f.show(f.primitive(shape, indices=f.accessor(shape.triangles.reshape(-1, 1), UBYTE)))


@file(twin="triangles")
def long_indices(f):
    shape = ball()
    f.show(f.primitive(shape, indices=f.accessor(shape.triangles.reshape(-1, 1), UINT)))


@file(twin="triangles")
def no_indices(f):
    shape = ball()
    corners = shape.triangles.reshape(-1)
    part = f.primitive(shapes.Shape(shape.positions[corners], np.arange(len(corners)).reshape(-1, 3),
                                    shape.normals[corners], None))
    del part["indices"]
    f.show(part)


@file(twin="triangles")
def interleaved(f):
    shape = ball()
    both = np.concatenate([shape.positions, shape.normals], 1).astype("<f4")
    view = f.view(both.tobytes(), byteStride=24)
    attributes = {name: f.add("accessors", {"bufferView": view, "byteOffset": offset, "type": "VEC3",
                                            "componentType": FLOAT, "count": len(both)})
                  for name, offset in (("POSITION", 0), ("NORMAL", 12))}
    f.show(f.primitive(shape, attributes=attributes))


@file()
def strip_twin(f):
    shape = sheet()
    shape.triangles = strip_of_sheet()[1]
    f.show(f.primitive(shape, f.material(texture=f.texture(picture()))))


@file(twin="strip_twin")
def strip(f):
    indices = f.accessor(strip_of_sheet()[0].reshape(-1, 1), USHORT)
    f.show(f.primitive(sheet(), f.material(texture=f.texture(picture())), mode=STRIP, indices=indices))


@file(twin="strip_twin")
def strip_without_indices(f):
    shape = sheet()
    corners = strip_of_sheet()[0]
    part = f.primitive(shapes.Shape(shape.positions[corners], shape.triangles, shape.normals[corners],
                                    shape.uvs[corners]), f.material(texture=f.texture(picture())), mode=STRIP)
    del part["indices"]
    f.show(part)


@file()
def fan_twin(f):
    f.show(f.primitive(fan_of_disc()))


@file(twin="fan_twin")
def fan(f):
    shape = fan_of_disc()
    indices = f.accessor(np.arange(len(shape.positions)).reshape(-1, 1), USHORT)
    f.show(f.primitive(shape, mode=FAN, indices=indices))


@file(twin="triangles")
def points_and_lines(f):
    shape = ball()
    cage = ball(0.9)
    f.show(f.primitive(shape), f.primitive(cage, mode=POINTS), f.primitive(cage, mode=LINES))


@file(twin="triangles")
def no_positions(f):
    shape = ball()
    f.show(f.primitive(shape), {"attributes": {"NORMAL": f.accessor(shape.normals)}})


@file()
def no_normals(f):
    f.show(f.primitive(without_normals(ball())))


@file()
def zeros_for_normals(f):
    shape = ball()
    part = f.primitive(shape)
    part["attributes"]["NORMAL"] = f.empty(len(shape.positions), 3)
    f.show(part)


def dented():
    shape = sheet()
    dent = shape.positions.copy()
    dent[:, 2] += 0.6 * (np.linalg.norm(dent[:, :2], axis=1) < 0.4)
    return shapes.Shape(dent, shape.triangles, None, shape.uvs)


@file()
def sparse_twin(f):
    f.show(f.primitive(dented()))


@file(twin="sparse_twin")
def sparse(f):
    part = f.primitive(dented())
    part["attributes"]["POSITION"] = f.sparse(dented().positions, sheet().positions)
    f.show(part)


@file(twin="sparse_twin")
def sparse_on_zeros(f):
    part = f.primitive(dented())
    part["attributes"]["POSITION"] = f.sparse(dented().positions, None)
    f.show(part)


# --- KHR_mesh_quantization ---

@file()
def quantized_twin(f):
    f.show(f.primitive(ball(), f.material(texture=f.texture(picture()))))


def quantized(f, attributes, **node):
    f.extension("KHR_mesh_quantization", required=True)
    f.show(f.primitive(ball(), f.material(texture=f.texture(picture())), attributes=attributes), **node)


@file(twin="quantized_twin")
def quantized_shorts(f):
    shape = ball()
    quantized(f, {"POSITION": f.accessor(np.round(shape.positions * 32767), SHORT, True),
                  "NORMAL": f.accessor(np.round(shape.normals * 32767), SHORT, True),
                  "TEXCOORD_0": f.accessor(np.round(shape.uvs * 65535), USHORT, True)})


@file(twin="quantized_twin")
def quantized_plain(f):
    """Integer positions that the node scales down."""
    shape = ball()
    quantized(f, {"POSITION": f.accessor(np.round(shape.positions * 20000 + 3000), SHORT),
                  "NORMAL": f.accessor(np.round(shape.normals * 127), BYTE, True),
                  "TEXCOORD_0": f.accessor(shape.uvs)}, scale=[1 / 20000] * 3, translation=[-0.15] * 3)


@file()
def quantized_bytes(f):
    shape = ball()
    quantized(f, {"POSITION": f.accessor(np.round(shape.positions * 127), BYTE, True),
                  "NORMAL": f.accessor(np.round(shape.normals * 127), BYTE, True),
                  "TEXCOORD_0": f.accessor(np.round(shape.uvs * 255), UBYTE, True)})


# --- morph targets and skins ---

def bulge(shape):
    """The morph target that makes a post thick in the middle, with its normals."""
    around = shape.positions * [1, 0, 1]
    return around * (1.5 * np.cos(np.pi / 1.4 * shape.positions[:, 1:2])), 0.3 * shape.positions * [0, 1, 0]


def lean(shape):
    return np.stack([0.5 * shape.positions[:, 1] ** 2, 0 * shape.positions[:, 1], 0 * shape.positions[:, 1]], -1)


def morphed(f, weights, of_node=None, sparse=False):
    shape = post()
    accessor = (lambda values: f.sparse(values, None)) if sparse else f.accessor
    positions, normals = bulge(shape)
    targets = [{"POSITION": accessor(positions), "NORMAL": accessor(normals)}, {"POSITION": accessor(lean(shape))}]
    mesh = f.mesh(f.primitive(shape, targets=targets), weights=weights)
    f.node(mesh=mesh, **({"weights": of_node} if of_node else {}))


@file()
def morph_twin(f):
    shape = post()
    positions, normals = bulge(shape)
    f.show(f.primitive(shapes.Shape(shape.positions + 0.5 * positions + 0.8 * lean(shape), shape.triangles,
                                    shape.normals + 0.5 * normals, None)))


@file(twin="morph_twin")
def morph(f):
    morphed(f, [0.5, 0.8])


@file(twin="morph_twin")
def morph_of_node(f):
    morphed(f, [0, 0], [0.5, 0.8])


@file(twin="morph_twin")
def morph_sparse(f):
    morphed(f, [0.5, 0.8], sparse=True)


BEND, ELBOW = 60, np.array([0, 0.1, 0])  # degrees about Z at the elbow


def share_above(shape):
    """The weight of the upper joint at a vertex."""
    return np.clip(shape.positions[:, 1] / 0.6 + 0.4, 0, 1)


def turn_z(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def bent(shape):
    """The post, bent by linear blending of two joints: one that stays, and one that turns about the elbow."""
    above = share_above(shape)[:, None, None]
    linear = (1 - above) * np.eye(3) + above * turn_z(BEND)
    moved = (1 - above[:, 0]) * shape.positions + above[:, 0] * (
        (shape.positions - ELBOW) @ turn_z(BEND).T + ELBOW)
    normals = np.einsum("nij,nj->ni", np.linalg.inv(linear).transpose(0, 2, 1), shape.normals)
    return shapes.Shape(moved, shape.triangles, normals / np.linalg.norm(normals, axis=1, keepdims=True), None)


def joints(f, matrices=True):
    """Joints whose lower one is below a node that moves it; inverse bind matrices undo this motion."""
    half = np.radians(BEND) / 2
    upper = f.node(root=False, translation=list(ELBOW), rotation=[0, 0, np.sin(half), np.cos(half)])
    lower = f.node(root=False, children=[upper])
    f.node(children=[lower], name="rig")
    skin = {"joints": [lower, upper]}
    if matrices:
        bind = np.tile(np.eye(4), (2, 1, 1))
        bind[1, :3, 3] = -ELBOW
        skin["inverseBindMatrices"] = f.accessor(bind.transpose(0, 2, 1).reshape(2, 16))
    return f.add("skins", skin)


def bound(f, shape, kind=FLOAT):
    above = share_above(shape)
    weights = np.stack([1 - above, above, 0 * above, 0 * above], -1)
    largest = {FLOAT: 1, UBYTE: 255, USHORT: 65535}[kind]
    return {"JOINTS_0": f.accessor(np.tile([0, 1, 0, 0], (len(above), 1)), UBYTE),
            "WEIGHTS_0": f.accessor(weights if kind == FLOAT else np.round(weights * largest), kind, kind != FLOAT)}


@file()
def skin_twin(f):
    f.show(f.primitive(bent(post())))


@file(twin="skin_twin")
def skin(f):
    part = f.primitive(post())
    part["attributes"].update(bound(f, post()))
    f.show(part, skin=joints(f), translation=[9, 9, 9])  # the position of the node has no effect


@file(twin="skin_twin")
def skin_shorts(f):
    part = f.primitive(post())
    part["attributes"].update(bound(f, post(), USHORT))
    f.show(part, skin=joints(f))


@file(twin="skin_twin")
def skin_two_sets(f):
    shape, above = post(), share_above(post())
    part = f.primitive(shape)
    zero = 0 * above
    for n, (joint, weight) in enumerate([(0, 1 - above), (1, above)]):
        part["attributes"][f"JOINTS_{n}"] = f.accessor(np.tile([joint, 0, 0, 0], (len(above), 1)), USHORT)
        part["attributes"][f"WEIGHTS_{n}"] = f.accessor(np.stack([weight, zero, zero, zero], -1))
    f.show(part, skin=joints(f))


@file(twin="skin_twin")
def skin_without_matrices(f):
    """A rigid skin: each half lies in the space of its joint."""
    shape = post()
    f.gltf["nodes"] = [{"translation": [0, 0, 0]}]
    f.gltf["scenes"][0]["nodes"] = [0]
    part = f.primitive(bent(shape))
    part["attributes"].update({"JOINTS_0": f.accessor(np.zeros((len(shape.positions), 4)), UBYTE),
                               "WEIGHTS_0": f.accessor(np.tile([1, 0, 0, 0], (len(shape.positions), 1)))})
    f.show(part, skin=f.add("skins", {"joints": [0]}))


@file()
def skin_morph_twin(f):
    shape = post()
    positions, normals = bulge(shape)
    f.show(f.primitive(bent_as(shape, shapes.Shape(shape.positions + 0.5 * positions, shape.triangles,
                                                   shape.normals + 0.5 * normals, None))))


def bent_as(shape, other):
    """`other`, bent with the shares of `shape`."""
    above = share_above(shape)[:, None, None]
    linear = (1 - above) * np.eye(3) + above * turn_z(BEND)
    offset = above[:, 0] * (ELBOW - turn_z(BEND) @ ELBOW)
    normals = np.einsum("nij,nj->ni", np.linalg.inv(linear).transpose(0, 2, 1), other.normals)
    return shapes.Shape(np.einsum("nij,nj->ni", linear, other.positions) + offset, other.triangles, normals, None)


@file(twin="skin_morph_twin")
def skin_morph(f):
    shape = post()
    positions, normals = bulge(shape)
    part = f.primitive(shape, targets=[{"POSITION": f.accessor(positions), "NORMAL": f.accessor(normals)}])
    part["attributes"].update(bound(f, shape))
    f.node(mesh=f.mesh(part), weights=[0.5], skin=joints(f))


# --- nodes ---

PLACES = np.array([[-0.7, 0, 0], [0, 0.3, -0.5], [0.7, 0, 0]])
SIZES = np.array([[1, 1, 1], [1, 2, 1], [-1, 1, 1]])
TURNS = np.array([[0, 0, 0, 1], [0, np.sin(0.4), 0, np.cos(0.4)], [np.sin(0.3), 0, 0, np.cos(0.3)]])


@file()
def instances_twin(f):
    mesh = f.mesh(f.primitive(box(0.2)))
    for place, turn, size in zip(PLACES, TURNS, SIZES):
        f.node(mesh=mesh, translation=list(place), rotation=list(turn), scale=list(map(float, size)))


@file(twin="instances_twin")
def instances(f):
    f.extension("EXT_mesh_gpu_instancing", required=True)
    attributes = {"TRANSLATION": f.accessor(PLACES), "ROTATION": f.accessor(TURNS), "SCALE": f.accessor(SIZES)}
    f.show(f.primitive(box(0.2)), extensions={"EXT_mesh_gpu_instancing": {"attributes": attributes}})


@file(twin="instances_twin")
def instances_of_shorts(f):
    f.extension("EXT_mesh_gpu_instancing", required=True)
    attributes = {"TRANSLATION": f.accessor(PLACES - [0, 0.1, 0]), "SCALE": f.accessor(SIZES),
                  "ROTATION": f.accessor(np.round(TURNS * 32767), SHORT, True)}
    f.show(f.primitive(box(0.2)), translation=[0, 0.1, 0],
           extensions={"EXT_mesh_gpu_instancing": {"attributes": attributes}})


@file(twin="triangles")
def hidden(f):
    f.extension("KHR_node_visibility")
    f.show(f.primitive(ball()))
    child = f.node(root=False, mesh=f.mesh(f.primitive(box(1))))
    f.node(children=[child], name="hidden", extensions={"KHR_node_visibility": {"visible": False}})


@file(twin="triangles")
def animated(f):
    node = f.show(f.primitive(ball()))
    sampler = {"input": f.accessor(np.array([[0.0], [1.0]])), "output": f.accessor(np.array([[0, 0, 0], [5, 5, 5]]))}
    f.add("animations", {"samplers": [sampler],
                         "channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}}]})


@file()
def deep_tree(f):
    """Nodes in a chain: each is rotated against its parent, and the last is mirrored."""
    mesh = f.mesh(f.primitive(box(0.25)))
    last = f.node(root=False, mesh=mesh, translation=[0.6, 0, 0], scale=[-0.7, 0.7, 0.7])
    middle = f.node(root=False, mesh=mesh, translation=[0.6, 0, 0], rotation=[0, 0, np.sin(0.3), np.cos(0.3)],
                    children=[last])
    c, s = np.cos(0.4), np.sin(0.4)
    f.node(mesh=mesh, children=[middle], matrix=[c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, -0.7, -0.2, 0, 1])


# --- textures ---

@file()
def textured(f):
    f.show(f.primitive(sheet(), f.material(texture=f.texture(picture()))))


@file(twin="textured")
def texture_in_a_view(f):
    f.show(f.primitive(sheet(), f.material(texture=f.texture(picture(), in_view=True))))


@file(twin="textured")
def webp_beside_png(f):
    f.extension("EXT_texture_webp")
    texture = f.texture(picture())
    webp = f.add("images", {"uri": "data:image/webp;base64,UklGRg=="})
    f.gltf["textures"][texture]["extensions"] = {"EXT_texture_webp": {"source": webp}}
    f.show(f.primitive(sheet(), f.material(texture=texture)))


@file(twin="textured")
def draco_beside_plain(f):
    f.extension("KHR_draco_mesh_compression")
    part = f.primitive(sheet(), f.material(texture=f.texture(picture())))
    part["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
    f.show(part)


def transformed(uvs, offset=(0, 0), turn=0.0, scale=(1, 1)):
    """Transforms as KHR_texture_transform: counter-clockwise with v down."""
    u, v = uvs[:, 0] * scale[0], uvs[:, 1] * scale[1]
    c, s = np.cos(turn), np.sin(turn)
    return np.stack([c * u + s * v + offset[0], -s * u + c * v + offset[1]], -1)


TRANSFORM = {"offset": [0.25, 0.5], "rotation": 0.5, "scale": [2, 0.75]}


@file()
def transform_twin(f):
    shape = sheet()
    shape.uvs = transformed(shape.uvs, (0.25, 0.5), 0.5, (2, 0.75))
    f.show(f.primitive(shape, f.material(texture=f.texture(picture()))))


@file(twin="transform_twin")
def transform(f):
    f.extension("KHR_texture_transform", required=True)
    info = {"extensions": {"KHR_texture_transform": TRANSFORM}}
    f.show(f.primitive(sheet(), f.material(texture=f.texture(picture()), info=info)))


@file(twin="transform_twin")
def transform_of_second_set(f):
    """The extension's texCoord takes precedence; the first set would give another picture."""
    f.extension("KHR_texture_transform")
    shape = sheet()
    info = {"texCoord": 0, "extensions": {"KHR_texture_transform": {**TRANSFORM, "texCoord": 1}}}
    part = f.primitive(shape, f.material(texture=f.texture(picture()), info=info))
    part["attributes"]["TEXCOORD_1"] = part["attributes"]["TEXCOORD_0"]
    part["attributes"]["TEXCOORD_0"] = f.empty(len(shape.positions), 2)
    f.show(part)


@file(twin="textured")
def second_set(f):
    shape = sheet()
    part = f.primitive(shape, f.material(texture=f.texture(picture()), info={"texCoord": 1}))
    part["attributes"]["TEXCOORD_1"] = part["attributes"]["TEXCOORD_0"]
    part["attributes"]["TEXCOORD_0"] = f.empty(len(shape.positions), 2)
    f.show(part)


@file()
def two_sets(f):
    """Base color by the second set, emission by the first, rotated and scaled down."""
    f.extension("KHR_texture_transform")
    shape = sheet()
    texture = f.texture(picture())
    glow = {"index": texture, "extensions": {"KHR_texture_transform": {"rotation": 0.8, "scale": [3, 3]}}}
    part = f.primitive(shape, f.material(texture=texture, info={"texCoord": 1}, emissiveFactor=[0.4, 0.2, 0.1],
                                         emissiveTexture=glow))
    part["attributes"]["TEXCOORD_1"] = f.accessor(shape.uvs * [2, 2])
    f.show(part)


def wrapped(f, **sampler):
    shape = sheet()
    shape.uvs = shape.uvs * 3 - 1
    f.show(f.primitive(shape, f.material(texture=f.texture(picture(), sampler))))


@file()
def repeated(f):
    wrapped(f)


@file()
def clamped(f):
    wrapped(f, wrapS=CLAMP, wrapT=CLAMP)


@file()
def mirrored(f):
    wrapped(f, wrapS=MIRROR, wrapT=CLAMP)


# --- materials ---

def before_ball(f, primitive):
    f.show(f.primitive(ball(0.4), f.material((0.2, 0.3, 0.8, 1))), translation=[0, 0, -0.8])
    f.show(primitive)


@file()
def mask(f):
    material = f.material(texture=f.texture(picture(alpha=True)), alphaMode="MASK", alphaCutoff=0.5)
    before_ball(f, f.primitive(sheet(), material))


@file()
def blend(f):
    before_ball(f, f.primitive(sheet(), f.material((0.9, 0.3, 0.2, 0.6), alphaMode="BLEND")))


@file()
def blend_of_two(f):
    material = f.material(texture=f.texture(picture(alpha=True)), alphaMode="BLEND", doubleSided=True)
    f.show(f.primitive(sheet(), material), translation=[0.2, 0.1, 0.3])
    before_ball(f, f.primitive(sheet(), material))


def colors_of(shape):
    return 0.5 + 0.5 * shape.positions / np.abs(shape.positions).max()


@file()
def vertex_colors(f):
    part = f.primitive(ball(), f.material((1, 1, 1, 1)))
    part["attributes"]["COLOR_0"] = f.accessor(colors_of(ball()))
    f.show(part)


@file()
def vertex_colors_blended(f):
    shape = sheet()
    part = f.primitive(shape, f.material((1, 1, 1, 1), alphaMode="BLEND"))
    colors = np.concatenate([colors_of(shape), shape.uvs[:, :1]], 1)
    part["attributes"]["COLOR_0"] = f.accessor(np.round(255 * colors), UBYTE, True)
    before_ball(f, part)


@file()
def emission(f):
    f.extension("KHR_materials_emissive_strength")
    glow = {"emissiveFactor": [0.2, 0.6, 0.3], "emissiveTexture": {"index": f.texture(picture())},
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}}
    f.show(f.primitive(ball(), f.material((0.1, 0.1, 0.1, 1), **glow)))


@file(twin="textured")
def specular_glossiness(f):
    f.extension("KHR_materials_pbrSpecularGlossiness")
    diffuse = {"diffuseFactor": [0.8, 0.5, 0.3, 1], "diffuseTexture": {"index": f.texture(picture())},
               "specularFactor": [0.1, 0.1, 0.1]}
    material = f.add("materials", {"extensions": {"KHR_materials_pbrSpecularGlossiness": diffuse}})
    f.show(f.primitive(sheet(), material))


@file()
def unlit(f):
    f.extension("KHR_materials_unlit")
    f.show(f.primitive(ball(), f.material((0.3, 0.7, 0.4, 1), extensions={"KHR_materials_unlit": {}})))


@file()
def double_sided(f):
    """A surface seen from behind."""
    f.show(f.primitive(sheet(), f.material(doubleSided=True)), rotation=[0, 1, 0, 0])


# --- together ---

@file()
def all_together(f):
    """A quantized strip with a transformed, clamped, masked texture and colors at its vertices, twice."""
    f.extension("KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_texture_transform", required=True)
    shape = sheet()
    sampler = {"wrapS": CLAMP, "wrapT": MIRROR}
    info = {"extensions": {"KHR_texture_transform": {"offset": [-0.5, -0.5], "scale": [2, 2]}}}
    material = f.material((1, 1, 1, 1), f.texture(picture(alpha=True), sampler), info, alphaMode="MASK",
                          doubleSided=True)
    attributes = {"POSITION": f.accessor(np.round(shape.positions * 32767), SHORT, True),
                  "NORMAL": f.accessor(np.round(shape.normals * 127), BYTE, True),
                  "TEXCOORD_0": f.accessor(np.round(shape.uvs * 65535), USHORT, True),
                  "COLOR_0": f.accessor(np.round(65535 * colors_of(shape)), USHORT, True)}
    indices = f.accessor(strip_of_sheet()[0].reshape(-1, 1), USHORT)
    places = {"TRANSLATION": f.accessor(np.array([[-0.4, 0, 0], [0.5, 0.1, -0.6]]))}
    f.show(f.primitive(shape, material, attributes=attributes, indices=indices, mode=STRIP),
           extensions={"EXT_mesh_gpu_instancing": {"attributes": places}})


def main(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in FILES.items():
        f = File()
        make(f)
        (folder / f"{name}.gltf").write_text(f.text())
        (folder / f"{name}.toml").write_text(SCENE.format(name=name))
    (folder / "names").write_text("\n".join(FILES) + "\n")
    (folder / "twins").write_text("".join(f"{name} {twin}\n" for name, twin in TWINS.items()))


if __name__ == "__main__":
    main(sys.argv[1])
