"""limpid for Blender: renders a scene without its water, and composites the water."""

bl_info = {
    "name": "limpid",
    "description": "Renders the scene without its water, and composites the water with limpid",
    "author": "The authors of limpid",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > limpid",
    "category": "Render",
}


def _classes():
    from .operators import LIMPID_OT_cancel, LIMPID_OT_clear, LIMPID_OT_view, LIMPID_OT_wet
    from .panel import LIMPID_PT_options, LIMPID_PT_panel
    from .preferences import LimpidPreferences
    from .properties import LimpidSettings
    return (LimpidPreferences, LimpidSettings, LIMPID_OT_wet, LIMPID_OT_cancel, LIMPID_OT_view, LIMPID_OT_clear, LIMPID_PT_panel,
            LIMPID_PT_options)


def register():
    import bpy
    from .properties import LimpidSettings
    for one in _classes():
        bpy.utils.register_class(one)
    bpy.types.Scene.limpid = bpy.props.PointerProperty(type=LimpidSettings)
    from .operators import forget
    bpy.app.handlers.load_post.append(forget)


def unregister():
    import bpy
    from .operators import forget
    from .state import state
    if forget in bpy.app.handlers.load_post:
        bpy.app.handlers.load_post.remove(forget)
    if state.started:
        state.started.run.cancel()
        state.started.finish()
        state.started = None
    if state.page:
        state.page.close()
        state.page = None
    del bpy.types.Scene.limpid
    for one in reversed(_classes()):
        bpy.utils.unregister_class(one)
