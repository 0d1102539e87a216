"""The height of the water of a mesh."""
from mathutils import Vector

FLAT = 0.1  # the least part of its area that a level face turns up


def level_of(water, depsgraph):
    """Mean height, by area, least and largest height of the faces that face up; for a sheet that lies upside down, of those
    that face down. None if the mesh has no such face."""
    evaluated = water.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        return _level(mesh, evaluated.matrix_world)
    finally:
        evaluated.to_mesh_clear()


def _level(mesh, world):
    places = [world @ vertex.co for vertex in mesh.vertices]
    turned = world.to_3x3().inverted_safe().transposed()
    for side in (1, -1):
        area = height = 0
        lows, tops = [], []
        for face in mesh.polygons:
            up = side * (turned @ face.normal).normalized().z
            if up <= FLAT:
                continue
            heights = [places[vertex].z for vertex in face.vertices]
            area += face.area * up
            height += face.area * up * sum(heights) / len(heights)
            lows.append(min(heights))
            tops.append(max(heights))
        if area > 0:
            return height / area, min(lows), max(tops)
    return None


def crosses(thing, world, low, high):
    """Whether the box around an object begins under `high` and ends over `low`: water between these heights may cut it, and
    the clip at the water then exposes its inside."""
    heights = [(world @ Vector(corner)).z for corner in thing.bound_box]
    return min(heights) < high and max(heights) > low
