"""Sockets of node groups; Blender 4.0 moved them."""


def add_socket(tree, way, kind, name):
    """`way` is INPUT or OUTPUT, `kind` as in NodeSocketFloat. Returns the socket."""
    if hasattr(tree, "interface"):
        return tree.interface.new_socket(name, in_out=way, socket_type=kind)
    return (tree.inputs if way == "INPUT" else tree.outputs).new(kind, name)
