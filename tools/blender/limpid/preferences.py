"""The path of the program limpid, for a program that is not on PATH."""
import bpy


class LimpidPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    tool: bpy.props.StringProperty(
        name="Program limpid", subtype="FILE_PATH",
        description="Path of the program limpid; empty: limpid on PATH")

    def draw(self, _):
        self.layout.prop(self, "tool")


def tool_path():
    addon = bpy.context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.tool) if addon and addon.preferences.tool else ""
