"""The panel in the sidebar of the 3D view."""
import blf
import bpy

from .lines import lines_of
from .state import state

MARGINS = 84  # of the sidebar, in unscaled pixels: its tabs, the panel's borders, and the icon before the text


def _words(layout, text, icon="NONE"):
    """The text in lines as wide as the panel: Blender cuts the middle out of longer labels."""
    context = bpy.context
    style, scale = context.preferences.ui_styles[0].widget, context.preferences.system.ui_scale
    if bpy.app.version < (4, 0, 0):
        blf.size(0, style.points * scale, 72)
    else:
        blf.size(0, style.points * scale)
    width = context.region.width - MARGINS * scale
    column = layout.column(align=True)
    for row, line in enumerate(lines_of(text, width, lambda words: blf.dimensions(0, words)[0])):
        column.label(text=line, icon=icon if row == 0 else "BLANK1" if icon != "NONE" else "NONE")


class LIMPID_PT_panel(bpy.types.Panel):
    bl_label = "limpid"
    bl_idname = "LIMPID_PT_panel"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "limpid"

    def draw(self, context):
        layout, settings = self.layout, context.scene.limpid
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(settings, "water_kind", expand=True)
        if settings.water_kind == "OBJECT":
            layout.prop(settings, "water")
            layout.prop(settings, "waves")
        else:
            layout.prop(settings, "height")
        layout.prop(settings, "look")
        layout.prop(settings, "settings")
        layout.prop(settings, "frames_kind")
        if settings.frames_kind == "LIST":
            layout.prop(settings, "frames", text=" ")
        self._draw_job(layout)

    def _draw_job(self, layout):
        layout.use_property_split = False
        if state.started:
            run = state.started.run
            _words(layout, f"{round(100 * run.share)} %, {run.text}", "RENDER_STILL")
            layout.operator("limpid.cancel")
        else:
            layout.operator("limpid.wet", icon="MOD_FLUIDSIM")
        layout.operator("limpid.view", icon="URL")
        if state.failure:
            _words(layout, state.failure, "ERROR")
        for text in state.said:
            _words(layout, text, "INFO")
        if state.failure or state.said:
            layout.operator("limpid.clear", icon="X")


class LIMPID_PT_options(bpy.types.Panel):
    """Closed at first, so that buttons and messages are in sight."""
    bl_label = "Options"
    bl_idname = "LIMPID_PT_options"
    bl_parent_id = "LIMPID_PT_panel"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "limpid"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.limpid
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="Render", align=True)
        for name in ("use_sun", "shadow", "reflection", "below", "surroundings", "aovs"):
            column.prop(settings, name)
        layout.prop(settings, "motion")
        layout.prop(settings, "samples")
        layout.prop(settings, "overscan_kind")
        if settings.overscan_kind == "FIXED":
            layout.prop(settings, "overscan")
        layout.prop(settings, "folder")
