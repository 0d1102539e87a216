"""The settings of a scene: water, look, passes."""
import bpy

from . import preferences
from .tool import find_tool, look_names
from .words import Failure

_looks = {}  # by tool: asked for once


def _known_looks(settings, _context, typed):
    """The names with the typed text in them; all names while the field still has the present look."""
    try:
        tool = find_tool(preferences.tool_path())
    except Failure:
        return []
    if tool not in _looks:
        _looks[tool] = look_names(tool)
    return [name for name in _looks[tool] if typed in name or typed == settings.look]


def _flag(name, description):
    return bpy.props.BoolProperty(name=name, default=True, description=description)


class LimpidSettings(bpy.types.PropertyGroup):
    water_kind: bpy.props.EnumProperty(name="Water", items=(
        ("OBJECT", "Object", "Water at the level of an object; the object itself is not rendered"),
        ("HEIGHT", "Height", "Water everywhere below a height")))
    water: bpy.props.PointerProperty(name="Object", type=bpy.types.Object, poll=lambda _, thing: thing.type == "MESH",
                                     description="The water mesh")
    height: bpy.props.FloatProperty(name="Height", unit="LENGTH", description="Height of the water along z")
    waves: bpy.props.EnumProperty(name="Waves", items=(
        ("LIMPID", "Of the look", "The waves of the look, on a level surface"),
        ("OBJECT", "Of the object", "The waves of the mesh, for example of an Ocean modifier")))
    look: bpy.props.StringProperty(name="Look", default="physical", search=_known_looks,
                                   search_options={"SORT", "SUGGESTION"},
                                   description="Name of a look or preset, or a look file")
    settings: bpy.props.StringProperty(name="Set", description="Parameters of the look to change, as in "
                                       "depth_fog.water_type=3C wave_normals.strength=0.3")
    frames_kind: bpy.props.EnumProperty(name="Frames", items=(
        ("CURRENT", "Current", "The current frame"),
        ("SCENE", "Scene", "The scene's frames, from start to end by its step"),
        ("LIST", "List", "Numbers and ranges of frames")))
    frames: bpy.props.StringProperty(name="Frames", default="1-48", description="Frames, as in 1-48 or 1-48x2,60")
    use_sun: _flag("Sun", "Light the water by the brightest sun lamp")
    reflection: _flag("Reflection", "Render the reflection: the view of the mirrored camera")
    below: _flag("Below", "Render the scene without the objects above the water")
    shadow: _flag("Shadow", "Render the sun's visibility at the bottom and at the water surface")
    surroundings: _flag("Surroundings", "Light the water by the world; a world of more than one color is rendered")
    aovs: _flag("AOVs", "Also write the AOVs")
    motion: bpy.props.EnumProperty(name="Motion", items=(
        ("NONE", "None", "No motion vectors"),
        ("NEXT", "To the next frame", "Motion vectors of what is seen through the water and of what it mirrors, by the "
         "camera and the waves of the next frame, for a scene that stands still"),
        ("PREVIOUS", "To the previous one", "The same to the previous frame")))
    overscan_kind: bpy.props.EnumProperty(name="Overscan", items=(
        ("PLAN", "Automatic", "The overscan that limpid computes from a small test render"),
        ("FIXED", "Fixed", "A fixed number of pixels on each side")))
    overscan: bpy.props.IntProperty(name="Pixels", min=0, max=4000, description="Pixels rendered beyond each side")
    samples: bpy.props.IntProperty(name="Samples", min=0, max=100000,
                                   description="Samples per pixel of a render; 0: the scene's sample count")
    folder: bpy.props.StringProperty(name="Folder", subtype="DIR_PATH", default="//limpid/",
                                     description="Folder for plates, scene files and wet pictures")
