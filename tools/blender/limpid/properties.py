"""What a scene remembers: which water, which look, what is rendered."""
import bpy

from . import preferences
from .tool import find_tool, look_names
from .words import Failure

_looks = {}  # by tool: asked for once


def _known_looks(_settings, _context, typed):
    try:
        tool = find_tool(preferences.tool_path())
    except Failure:
        return []
    if tool not in _looks:
        _looks[tool] = look_names(tool)
    return [name for name in _looks[tool] if typed in name]


def _flag(name, description):
    return bpy.props.BoolProperty(name=name, default=True, description=description)


class LimpidSettings(bpy.types.PropertyGroup):
    water_kind: bpy.props.EnumProperty(name="Water", items=(
        ("OBJECT", "Object", "An object is the water: its level is taken, and it is not rendered itself"),
        ("HEIGHT", "Height", "All below a height is under water")))
    water: bpy.props.PointerProperty(name="Object", type=bpy.types.Object, poll=lambda _, thing: thing.type == "MESH",
                                     description="The mesh that is the water")
    height: bpy.props.FloatProperty(name="Height", unit="LENGTH", description="Of the water, along z")
    waves: bpy.props.EnumProperty(name="Waves", items=(
        ("LIMPID", "The look's", "The object is level; the look makes the waves"),
        ("OBJECT", "The object's", "The object's mesh has the waves, as by an Ocean modifier")))
    look: bpy.props.StringProperty(name="Look", default="physical", search=_known_looks,
                                   search_options={"SORT", "SUGGESTION"},
                                   description="Name of a look of limpid's, or a look file")
    settings: bpy.props.StringProperty(name="Set", description="Parameters of the look that differ, as in "
                                       "depth_fog.water_type=3C wave_normals.strength=0.3")
    frames_kind: bpy.props.EnumProperty(name="Frames", items=(
        ("CURRENT", "This one", "The current frame"), ("SCENE", "The scene's", "From start to end, by its step"),
        ("LIST", "These", "Numbers and ranges")))
    frames: bpy.props.StringProperty(name="Frames", default="1-48", description="As in 1-48 or 1-48x2,60")
    use_sun: _flag("Sun", "The brightest sun lamp lights the water")
    reflection: _flag("Reflection", "Render what the water mirrors")
    below: _flag("Below", "Render the scene once more without what stands above the water")
    shadow: _flag("Shadow", "Render where the sun reaches the bottom and the water")
    surroundings: _flag("Surroundings", "Tell limpid of the world's light; a world of more than one color is rendered")
    aovs: _flag("AOVs", "Write the terms that the picture is made of, too")
    overscan_kind: bpy.props.EnumProperty(name="Overscan", items=(
        ("PLAN", "As asked for", "As much as limpid asks for by a small test render"),
        ("FIXED", "Fixed", "So many pixels on each side")))
    overscan: bpy.props.IntProperty(name="Pixels", min=0, max=4000, description="Rendered beyond each side")
    samples: bpy.props.IntProperty(name="Samples", min=0, max=100000,
                                   description="Of each pixel of a render; 0: as many as the scene has")
    folder: bpy.props.StringProperty(name="Folder", subtype="DIR_PATH", default="//limpid/",
                                     description="Where plates, scene files and wet pictures are written")
