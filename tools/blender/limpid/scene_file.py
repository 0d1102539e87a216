"""The text of a limpid scene file: the camera of a frame, its water, its light and its buffers."""
from dataclasses import dataclass, field
from typing import Optional

LAYER = "ViewLayer"  # the name that each rendered view layer has in its file


@dataclass
class SceneFacts:
    """Matrices are four rows, for column vectors; lengths in scene units, z is up."""
    view: list
    projection: list
    near: float
    far: float
    height: float
    time: float = 0.0
    sun_direction: Optional[tuple] = None
    sun_color: tuple = (1.0, 1.0, 1.0)
    sun_diameter: float = 0.533  # degrees
    sky: Optional[tuple] = None
    plates: dict = field(default_factory=dict)  # key of [plates]: FILE or FILE:CHANNELS


def _toml(value):
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        return '"' + "".join(f"\\u{ord(c):04X}" if ord(c) < 32 or ord(c) == 127 else c for c in escaped) + '"'
    if isinstance(value, (int, float)):
        return repr(float(value))
    return "[" + ", ".join(_toml(one) for one in value) + "]"


def _table(name, entries):
    return [f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in entries.items()), ""]


def scene_text(facts, about):
    """The text of the file; `about` is a comment line."""
    lines = [f"# {about}", "# Metres or whatever unit the scene has, z up; written by limpid's add-on for Blender.", ""]
    lines += _table("plates", facts.plates)
    lines += _table("camera", {"view": facts.view, "projection": facts.projection, "clip": "gl",
                               "near": facts.near, "far": facts.far, "depth": "eye"})
    lines += _table("water", {"up": (0, 0, 1), "height": facts.height})
    if facts.sun_direction is not None:
        lines += _table("sun", {"direction": facts.sun_direction, "color": facts.sun_color,
                                "diameter": min(max(facts.sun_diameter, 0.01), 90)})
    if facts.sky is not None:
        lines += _table("sky", {"radiance": facts.sky})
    lines += _table("scene", {"time": facts.time})
    return "\n".join(lines)


# The inputs from each pass: key of [plates], and the layer or channel of the pass's file.
CHANNELS = {
    "dry": {"color": "Combined", "depth": "Depth"},
    "sun": {"sun_color": "Combined_sun"},
    "shadow": {"shadow": "Combined.R"},
    "surface": {"surface_depth": "Depth"},
    "surface_shadow": {"surface_shadow": "Combined.R"},
    "waves": {"surface_normal": "Normal"},
    "mirror": {"reflection": "Combined", "reflection_valid": "Combined.A", "reflection_depth": "Depth"},
    "below": {"below_color": "Combined", "below_depth": "Depth"},
}
SHARED = {"sun": "dry", "surface_shadow": "surface"}  # passes that lie in the file of another


def files_of(passes):
    """The files of these passes, each once, in order."""
    return list(dict.fromkeys(SHARED.get(name, name) for name in passes))


def plates_of(passes, name_of, environment=None):
    """The entries of [plates] for the rendered passes; `name_of` returns the path of a file."""
    plates = {role: f"{name_of(SHARED.get(name, name))}:{LAYER}.{channel}"
              for name in passes for role, channel in CHANNELS[name].items()}
    if environment:
        plates["environment"] = environment
    return plates
