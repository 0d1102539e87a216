"""Materials as the camera sees them: clipped at the water, or lit by the sun alone.

Only the source of a material's surface shader changes: a node group is inserted, and removed after the pass. Rays
other than the camera's meet the original material, so that visible surfaces are lit, shaded and mirrored as in the
dry picture."""
import bpy

from .sockets import add_socket

CROSSING = "limpid_crossing"  # property: 1 for objects that the water cuts, 0 for others
LEAF = 0.05  # the part of the strip by which the water is lower for objects that it does not cut: they may lie exactly on it


class _Group:
    """A node group under construction, whose input and output are shaders."""

    def __init__(self, name):
        self.tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
        for way in ("INPUT", "OUTPUT"):
            add_socket(self.tree, way, "NodeSocketShader", "Shader")
        self.before = self.node("NodeGroupInput")[0]

    def node(self, kind, *inputs, **settings):
        made = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(made, name, value)
        for socket, value in zip(made.inputs, inputs):
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
            elif value is not None:
                socket.default_value = value
        return made.outputs

    def math(self, operation, *inputs):
        return self.node("ShaderNodeMath", *inputs, operation=operation)[0]

    def number(self, name, value=0.0):
        """A value node that is set before a pass."""
        output = self.node("ShaderNodeValue", name=name)[0]
        output.default_value = value
        return output

    def mix(self, share, first, second):
        return self.node("ShaderNodeMixShader", share, first, second)[0]

    def finish(self, shader):
        self.node("NodeGroupOutput", shader)
        return self.tree


def _is_over_waves(group, here, rise):
    """Whether a surface is in front of waves, by more height than the rise."""
    image = group.node("ShaderNodeTexImage", group.node("ShaderNodeTexCoord")["Window"], name="depth", interpolation="Closest",
                       extension="CLIP")["Color"]
    gap = group.math("SUBTRACT", image, group.node("ShaderNodeCameraData")["View Z Depth"])
    slope = group.math("ABSOLUTE", group.node("ShaderNodeSeparateXYZ", here["Incoming"])[2])
    over = group.math("GREATER_THAN", group.math("MULTIPLY", gap, slope), rise)
    return group.math("MULTIPLY", over, group.math("GREATER_THAN", image, 0.0))


def depth_material():
    """The brightness is the depth."""
    made = bpy.data.materials.new("limpid depth")
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    glow = nodes.new("ShaderNodeEmission")
    links.new(nodes.new("ShaderNodeCameraData").outputs["View Z Depth"], glow.inputs["Color"])
    links.new(glow.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def cut_group():
    """Surfaces on one `side` of the `height` (1 above, -1 below), which for objects that the water cuts rises by `spare` per
    unit of distance and by `spare_flat`, and for others falls by the part LEAF of that, are transparent to the camera. The
    exposed inside of a clipped object is transparent, too, or a holdout with `hold`. With `waves`, surfaces in front of the
    depth of the image `depth`, by more than the rise, are transparent as well."""
    group = _Group("limpid cut")
    here, path = group.node("ShaderNodeNewGeometry"), group.node("ShaderNodeLightPath")
    side, height, hold = (group.number(name) for name in ("side", "height", "hold"))
    crossing = group.node("ShaderNodeAttribute", attribute_type="OBJECT", attribute_name=CROSSING)["Fac"]
    rise = group.math("MULTIPLY_ADD", group.number("spare"), group.node("ShaderNodeCameraData")["View Distance"],
                      group.number("spare_flat"))
    rise = group.math("MULTIPLY", rise, group.math("MULTIPLY_ADD", crossing, 1 + LEAF, -LEAF))
    limit = group.math("ADD", height, rise)
    z = group.node("ShaderNodeSeparateXYZ", here["Position"])[2]
    beyond = group.math("GREATER_THAN", group.math("MULTIPLY", side, z), group.math("MULTIPLY", side, limit))
    beyond = group.math("MAXIMUM", beyond, group.math("MULTIPLY", group.number("waves"), _is_over_waves(group, here, rise)))
    inside = group.math("MULTIPLY", here["Backfacing"], crossing)
    inside = group.math("MULTIPLY", inside, group.math("GREATER_THAN", path["Transparent Depth"], 0.5))
    clear = group.node("ShaderNodeBsdfTransparent")[0]
    hole = group.mix(hold, clear, group.node("ShaderNodeHoldout")[0])
    camera = path["Is Camera Ray"]
    shown = group.mix(group.math("MULTIPLY", camera, inside), group.before, hole)
    return group.finish(group.mix(group.math("MULTIPLY", camera, beyond), shown, clear))


def sunlit_group():
    """All surfaces reflect as if they faced the sun, whose direction is `x`, `y`, `z`: with a sun of strength pi, the
    brightness of a pixel is the sun's visibility. Surfaces that face away are black. Shadow rays meet the original
    material."""
    group = _Group("limpid sunlit")
    sun = group.node("ShaderNodeCombineXYZ", *(group.number(axis) for axis in "xyz"))[0]
    here = group.node("ShaderNodeNewGeometry")
    def cosine(normal):
        return group.node("ShaderNodeVectorMath", here[normal], sun, operation="DOT_PRODUCT")["Value"]
    # The color, not the normal, makes up for the slope: Cycles turns normals that face away from the camera.
    white = group.tree.nodes.new("ShaderNodeBsdfDiffuse")
    group.tree.links.new(group.math("DIVIDE", group.math("GREATER_THAN", cosine("True Normal"), 1e-4),
                                    group.math("MAXIMUM", cosine("Normal"), .002)), white.inputs["Color"])
    shadow = group.node("ShaderNodeLightPath")["Is Shadow Ray"]
    return group.finish(group.mix(shadow, white.outputs[0], group.before))


def material_of(group):
    """A material of the group alone."""
    made = bpy.data.materials.new(group.name)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    node = nodes.new("ShaderNodeGroup")
    node.node_tree = group
    made.node_tree.links.new(node.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def set_numbers(group, **numbers):
    for name, value in numbers.items():
        group.nodes[name].outputs[0].default_value = value


def seen_through(group, materials, changes):
    """Inserts the group between each material and its surface, until the changes are restored."""
    for material in materials:
        tree = material.node_tree
        end = tree.get_output_node("CYCLES") if tree else None
        if not end or not end.inputs["Surface"].is_linked:
            continue
        surface = end.inputs["Surface"].links[0].from_socket
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = group
        tree.links.new(surface, node.inputs[0])
        tree.links.new(node.outputs[0], end.inputs["Surface"])
        def undo(tree=tree, node=node, surface=surface, end=end):
            tree.links.new(surface, end.inputs["Surface"])
            tree.nodes.remove(node)
        changes.afterwards(undo)
