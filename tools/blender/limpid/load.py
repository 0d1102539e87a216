"""The wet pictures in Blender: an image for the image editor, and a node group for the compositor."""
import os
import pathlib

import bpy

from .frames import numbered
from .sockets import add_socket, remove_socket, sockets_of

NAME = "limpid wet"
TERMS = ("transmitted", "in_scatter", "reflected", "highlight")  # they sum to the picture


def load_image(folder, frames):
    """One frame, or the sequence that begins with the first frame; reuses the image of an earlier run."""
    path = str(pathlib.Path(folder) / f"{numbered('wet', frames[0])}.exr")
    image = bpy.data.images.get(NAME)
    if image is None:
        image = bpy.data.images.load(path)
        image.name = NAME
    image.source = "SEQUENCE" if len(frames) > 1 else "FILE"
    image.filepath = path
    if bpy.data.filepath:
        try:
            image.filepath = bpy.path.relpath(path)
        except ValueError:  # on another drive
            pass
    image.reload()
    return image


def _mix(tree, blend, first, second):
    node = tree.nodes.new("CompositorNodeMixRGB")
    node.blend_type = blend
    for socket, source in zip(node.inputs[1:], (first, second)):
        tree.links.new(source, socket)
    return node.outputs[0]


def make_group(image, frames):
    """A group whose output Wet is the picture: the sum of its terms, each times a factor, if the file has the terms.
    The other layers of the file are outputs, too. The group of an earlier run is refilled, so that nodes keep it."""
    tree = bpy.data.node_groups.get(NAME) or bpy.data.node_groups.new(NAME, "CompositorNodeTree")
    tree.nodes.clear()
    picture = tree.nodes.new("CompositorNodeImage")
    picture.image = image
    if len(frames) > 1:
        picture.frame_start, picture.frame_duration = frames[0], frames[-1] - frames[0] + 1
        picture.frame_offset = frames[0] - 1
    found = {socket.name: socket for socket in picture.outputs if socket.enabled}
    is_parted = all(term in found for term in TERMS)
    wet = found.get("Combined") or found.get("Image")
    wanted = {"INPUT": [("NodeSocketFloat", term) for term in TERMS if is_parted],
              "OUTPUT": [("NodeSocketColor", "Wet")] + [(socket.bl_idname, name) for name, socket in found.items()]}
    _renew_sockets(tree, wanted)
    ends = tree.nodes.new("NodeGroupOutput")
    if is_parted:
        gains = tree.nodes.new("NodeGroupInput")
        parts = [_mix(tree, "MULTIPLY", found[term], gains.outputs[term]) for term in TERMS]
        wet = parts[0]
        for part in parts[1:]:
            wet = _mix(tree, "ADD", wet, part)
        alpha = tree.nodes.new("CompositorNodeSetAlpha")
        tree.links.new(wet, alpha.inputs[0])
        tree.links.new(found["Alpha"], alpha.inputs[1])
        wet = alpha.outputs[0]
    tree.links.new(wet, ends.inputs["Wet"])
    for name, socket in found.items():
        tree.links.new(socket, ends.inputs[name])
    for column, node in enumerate(tree.nodes):
        node.location.x = 200 * column
    return tree


def _nodes_of(group):
    """The nodes that show the group, in all compositors and groups."""
    trees = [*bpy.data.node_groups, *filter(None, (getattr(scene, "node_tree", None) for scene in bpy.data.scenes))]
    return [node for tree in trees for node in tree.nodes if getattr(node, "node_tree", None) == group]


def _renew_sockets(tree, wanted):
    """Keeps the sockets of an earlier run, and with them the links of nodes in the compositor."""
    for way, sockets in wanted.items():
        there = dict(sockets_of(tree, way))
        for key in there.keys() - set(sockets):
            remove_socket(tree, way, there[key])
        for kind, name in sockets:
            if (kind, name) in there:
                continue
            socket = add_socket(tree, way, kind, name)
            if way == "INPUT":
                socket.default_value = 1.0
                for node in _nodes_of(tree):  # which got the socket before its default
                    node.inputs[name].default_value = 1.0


def show(image, frames):
    """Shows the image in the open image editors."""
    window = bpy.context.window
    for area in window.screen.areas if window and not bpy.app.background else ():
        if area.type == "IMAGE_EDITOR":
            space = area.spaces.active
            space.image = image
            if len(frames) > 1:
                space.image_user.frame_start, space.image_user.frame_duration = frames[0], frames[-1] - frames[0] + 1
                space.image_user.frame_offset = frames[0] - 1


def load(folder, frames):
    frames = [frame for frame in frames
              if os.path.isfile(pathlib.Path(folder) / f"{numbered('wet', frame)}.exr")]
    if not frames:
        return None
    image = load_image(folder, frames)
    tree = make_group(image, frames)
    show(image, frames)
    return tree
