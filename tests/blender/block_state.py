"""All that a .blend holds, as far as Python shows it: for a comparison of before and after. Runs in Blender."""
import bpy

LONGEST = 5000  # of a collection that is looked through
DEEP, NODES = 5, {"materials", "node_groups", "worlds", "lights"}  # whose nodes, sockets and links are looked at
SKIPPED = {"rna_type", "bl_rna", "depsgraph", "users", "is_updated", "is_updated_data", "original", "session_uid"}


def _value(value):
    if isinstance(value, (bool, int, float, str)) or value is None:
        return value
    if isinstance(value, (set, frozenset)):
        return sorted(map(str, value))
    try:
        return [_value(one) for one in value]
    except TypeError:
        return str(value)


def _struct(struct, depth):
    state = {}
    for prop in struct.bl_rna.properties:
        name = prop.identifier
        if name in SKIPPED:
            continue
        try:
            value = getattr(struct, name)
        except (AttributeError, RuntimeError):
            continue
        if prop.type == "POINTER":
            if isinstance(value, bpy.types.ID) and not value.is_embedded_data:
                state[name] = f"{type(value).__name__} {value.name_full}"
            elif value is not None and depth > 0:
                state[name] = _struct(value, depth - 1)
        elif prop.type == "COLLECTION":
            if depth > 0 and len(value) <= LONGEST:
                state[name] = [one.name_full if isinstance(one, bpy.types.ID) else _struct(one, depth - 1)
                               for one in value]
        else:
            state[name] = _value(value)
    return state


def block_state():
    """Kind and name of each data-block, and what it holds."""
    state = {}
    for prop in bpy.data.bl_rna.properties:
        if prop.type != "COLLECTION":
            continue
        for block in getattr(bpy.data, prop.identifier):
            if prop.identifier not in ("window_managers", "screens", "workspaces"):
                own = {key: _value(block[key]) for key in block.keys() if not hasattr(block[key], "keys")}
                depth = DEEP if prop.identifier in NODES else 3
                state[f"{prop.identifier}/{block.name_full}"] = [_struct(block, depth), own]
    return state


def differences(before, after):
    """Names of the blocks that are there alone, or differ."""
    return sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
