"""The operators of the buttons."""
import bpy

from . import begin
from .load import NAME, load
from .state import state
from .view import view
from .words import Failure

TICK = 0.25  # seconds between two looks at a job that runs


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


@bpy.app.handlers.persistent
def forget(*_):
    """Another file was opened: the messages are about the one before."""
    state.tell()


class LIMPID_OT_wet(bpy.types.Operator):
    """Renders the scene without its water in a second Blender, and composites the water with limpid"""
    bl_idname = "limpid.wet"
    bl_label = "Add water"
    bl_options = {"UNDO"}

    frames: bpy.props.StringProperty(name="Frames", description="Frames, as in 1-48x2; empty: the frames of the panel",
                                     options={"SKIP_SAVE"})
    load: bpy.props.BoolProperty(name="Load", default=True, options={"SKIP_SAVE"},
                                 description="Load the result as an image and a node group")
    _timer = None

    @classmethod
    def poll(cls, _context):
        return state.started is None

    def _start(self, context):
        state.tell()
        state.started = begin.Started(begin.job_of(context.scene, context.view_layer, self.frames))

    def _fail(self, sentence, kind="ERROR"):
        state.tell(sentence, state.said)
        self.report({kind}, sentence)
        return {"CANCELLED"}

    def _finish(self):
        started, state.started = state.started, None
        started.finish()
        run = started.run
        state.tell(said=[*run.notes, *run.warnings])
        for warning in run.warnings:
            self.report({"WARNING"}, warning)
        failure = run.failure()
        if failure:
            return self._fail(failure, "INFO" if run.cancelled else "ERROR")
        if self.load and load(started.job.folder, started.job.frames):
            state.said += (f"the picture is the image '{NAME}' of the Image Editor",)
        return {"FINISHED"}

    def execute(self, context):
        try:
            self._start(context)
        except Failure as failure:
            return self._fail(str(failure))
        state.started.run.wait()
        return self._finish()

    def invoke(self, context, _event):
        try:
            self._start(context)
        except Failure as failure:
            return self._fail(str(failure))
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        _redraw(context)
        if state.started.run.is_running():
            return {"PASS_THROUGH"}
        context.window_manager.event_timer_remove(self._timer)
        return self._finish()

    def cancel(self, _context):
        """Blender calls this when it opens another file, or ends."""
        if state.started:
            state.started.run.cancel()
            state.started.finish()
            state.started = None


class LIMPID_OT_cancel(bpy.types.Operator):
    """Ends the running job; finished frames stay"""
    bl_idname = "limpid.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, _context):
        return state.started is not None

    def execute(self, _context):
        state.started.run.cancel()
        return {"FINISHED"}


class LIMPID_OT_view(bpy.types.Operator):
    """Opens the plates of the frames in a browser, to tune the look"""
    bl_idname = "limpid.view"
    bl_label = "Tune the look"

    frames: bpy.props.StringProperty(name="Frames", options={"SKIP_SAVE"})

    def execute(self, context):
        try:
            state.page = view(context.scene, self.frames, state.page)
        except Failure as failure:
            state.tell(str(failure))
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        state.tell(said=[f"the look is tuned at {state.page.address}"])
        return {"FINISHED"}


class LIMPID_OT_clear(bpy.types.Operator):
    """Removes the messages from the panel"""
    bl_idname = "limpid.clear"
    bl_label = "Clear"
    bl_options = {"INTERNAL"}

    def execute(self, _context):
        state.tell()
        return {"FINISHED"}
