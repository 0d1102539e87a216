"""Sockets of node groups, which Blender 4.0 moved."""


def add_socket(tree, way, kind, name):
    """`way` is INPUT or OUTPUT, `kind` as in NodeSocketFloat. Returns the socket, whose default may be set."""
    if hasattr(tree, "interface"):
        return tree.interface.new_socket(name, in_out=way, socket_type=kind)
    return (tree.inputs if way == "INPUT" else tree.outputs).new(kind, name)
