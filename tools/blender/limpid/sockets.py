"""Sockets of node groups; Blender 4.0 moved them."""


def add_socket(tree, way, kind, name):
    """`way` is INPUT or OUTPUT, `kind` as in NodeSocketFloat. Returns the socket."""
    if hasattr(tree, "interface"):
        return tree.interface.new_socket(name, in_out=way, socket_type=kind)
    return (tree.inputs if way == "INPUT" else tree.outputs).new(kind, name)


def sockets_of(tree, way):
    """Each socket, with its kind and name before it."""
    if hasattr(tree, "interface"):
        return [((one.socket_type, one.name), one) for one in tree.interface.items_tree
                if one.item_type == "SOCKET" and one.in_out == way]
    return [((one.bl_socket_idname, one.name), one) for one in (tree.inputs if way == "INPUT" else tree.outputs)]


def remove_socket(tree, way, socket):
    if hasattr(tree, "interface"):
        tree.interface.remove(socket)
    else:
        (tree.inputs if way == "INPUT" else tree.outputs).remove(socket)
