"""The light for the scene file: the sun, and an even sky."""
import math

from .words import Failure

RED, GREEN, BLUE = 0.2126, 0.7152, 0.0722  # luminance


def _emission(lamp):
    """The factor of a lamp's nodes on its strength: red, green, blue."""
    if not (lamp.use_nodes and lamp.node_tree):
        return 1.0, 1.0, 1.0
    ends = [node for node in lamp.node_tree.nodes if node.type == "OUTPUT_LIGHT" and node.is_active_output]
    links = ends[0].inputs["Surface"].links if ends else []
    node = links[0].from_node if links else None
    if node is None:
        return 0.0, 0.0, 0.0
    color, strength = node.inputs.get("Color"), node.inputs.get("Strength")
    if node.type != "EMISSION" or color.is_linked or strength.is_linked:
        raise Failure(f"sun '{lamp.name}': its brightness is unknown: expected one Emission node "
                      "of one color, or no nodes")
    return tuple(strength.default_value * channel for channel in color.default_value[:3])


def sun_color(lamp, exposure):
    """The radiance of a white surface that faces the sun: red, green, blue."""
    strength = lamp.energy / math.pi * exposure * 2 ** getattr(lamp, "exposure", 0.0)
    warmth = getattr(lamp, "temperature_color", (1, 1, 1)) if getattr(lamp, "use_temperature", False) else (1, 1, 1)
    return tuple(strength * a * b * c for a, b, c in zip(lamp.color, warmth, _emission(lamp)))


def is_sun(thing):
    return thing.type == "LIGHT" and thing.data.type == "SUN"


def brightest_sun(view_layer):
    """The sun lamp that lights the layer most, or None."""
    suns = [thing for thing in view_layer.objects if is_sun(thing) and not thing.hide_render]
    def brightness(thing):
        red, green, blue = sun_color(thing.data, 1)
        return RED * red + GREEN * green + BLUE * blue
    return max(suns, key=brightness, default=None)


def even_sky(world, exposure):
    """The world's radiance if it is a single color, else None: then the world is rendered."""
    if world is None:
        return 0.0, 0.0, 0.0
    if not (world.use_nodes and world.node_tree):
        return tuple(channel * exposure for channel in world.color)
    end = world.node_tree.get_output_node("CYCLES")
    links = end.inputs["Surface"].links if end else []
    if not links:
        return 0.0, 0.0, 0.0
    node = links[0].from_node
    if node.type != "BACKGROUND" or node.inputs["Color"].is_linked or node.inputs["Strength"].is_linked:
        return None
    strength = node.inputs["Strength"].default_value * exposure
    return tuple(strength * channel for channel in node.inputs["Color"].default_value[:3])
