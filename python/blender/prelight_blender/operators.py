"""The actions of the panel's buttons."""

import bpy

from . import package, show
from .problems import Problem
from .run import Run
from .settings import state


def _tell_problem(operator, context, problem):
    told = state(context)
    told.problem, told.fix = problem.what, problem.fix
    operator.report({"ERROR"}, str(problem))
    return {"CANCELLED"}


class PRELIGHT_OT_bake(bpy.types.Operator):
    bl_idname = "prelight.bake"
    bl_label = "Bake"
    bl_description = "Bakes the selected meshes; Esc ends it and leaves the scene as it was"
    bl_options = {"REGISTER", "UNDO"}

    _run = None
    _timer = None

    @classmethod
    def poll(cls, context):
        if state(context).running:
            cls.poll_message_set("A bake is running")
            return False
        return context.mode == "OBJECT" or not context.object

    def execute(self, context):
        """Bakes and waits until the bake is done, for scripts."""
        try:
            self._begin(context)
            return self._finish(context)
        except Problem as problem:
            return _tell_problem(self, context, problem)

    def invoke(self, context, event):
        if bpy.app.background:
            return self.execute(context)
        try:
            self._begin(context)
        except Problem as problem:
            return _tell_problem(self, context, problem)
        manager = context.window_manager
        self._timer = manager.event_timer_add(0.1, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        state(context).running = True
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        told = state(context)
        if event.type == "ESC" and event.value == "PRESS" or told.stop:
            self._run.cancel()
        if event.type != "TIMER":
            return {"RUNNING_MODAL"} if event.type == "ESC" else {"PASS_THROUGH"}
        if not self._run.is_done():
            self._tell_progress(context)
            return {"PASS_THROUGH"}
        self._leave_modal(context)
        try:
            return self._finish(context)
        except Problem as problem:
            return _tell_problem(self, context, problem)

    def cancel(self, context):
        """Called when Blender ends or another file is opened."""
        self._leave_modal(context)
        self._run.cancel()
        self._run.finish()

    def _begin(self, context):
        told = state(context)
        told.problem = told.fix = told.notes = told.stage = ""
        told.stop, told.done = False, 0.0
        self._run = Run(context, context.scene.prelight.request())

    def _finish(self, context):
        finished = self._run.finish()
        notes = self._run.notes()
        state(context).notes = "\n".join(notes)
        for note in notes:
            self.report({"WARNING"}, note)
        if not finished:
            self.report({"INFO"}, "Bake ended; nothing was changed")
        return {"FINISHED"} if finished else {"CANCELLED"}

    def _tell_progress(self, context):
        told = state(context)
        stage, done = self._run.progress()
        if (stage, int(100.0 * done)) == (told.stage, int(100.0 * told.done)):
            return  # redrawing takes time from the bake
        told.stage, told.done = stage, done
        context.window_manager.progress_update(int(100.0 * done))
        context.workspace.status_text_set(f"Prelight: {stage} {100.0 * done:.0f} %    Esc: end")
        for area in context.screen.areas if context.screen else ():
            if area.type == "VIEW_3D":
                area.tag_redraw()

    def _leave_modal(self, context):
        manager = context.window_manager
        state(context).running = False
        if self._timer is not None:
            manager.event_timer_remove(self._timer)
            manager.progress_end()
            self._timer = None
        if context.workspace:
            context.workspace.status_text_set(None)


class PRELIGHT_OT_stop(bpy.types.Operator):
    bl_idname = "prelight.stop"
    bl_label = "Cancel"
    bl_description = "Ends the bake and leaves the scene as it was"

    def execute(self, context):
        state(context).stop = True
        return {"FINISHED"}


class PRELIGHT_OT_show(bpy.types.Operator):
    bl_idname = "prelight.show"
    bl_label = "Show or Hide Result"
    bl_description = "Switches the selected objects between their own materials and those that show the bake"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        items = [item for item in context.selected_objects if item.type == "MESH"]
        if any(show.is_shown(item) for item in items):
            show.hide(items)
            return {"FINISHED"}
        what = context.scene.prelight.what
        lacking = [item for item in items if not show.has_result(item, what)]
        if lacking or not items:
            name = f'"{lacking[0].name}" has no such result' if lacking else "No mesh is selected"
            return _tell_problem(self, context, Problem(name, "bake it, or choose a result that it has under Bake"))
        show.show(items, what)
        return {"FINISHED"}


class PRELIGHT_OT_look_again(bpy.types.Operator):
    bl_idname = "prelight.look_again"
    bl_label = "Look Again"
    bl_description = "Looks for the Python package prelight, which may have been installed meanwhile"

    def execute(self, context):
        import importlib

        importlib.invalidate_caches()
        try:
            package.find()
        except Problem as problem:
            return _tell_problem(self, context, problem)
        state(context).problem = state(context).fix = ""
        return {"FINISHED"}


CLASSES = (PRELIGHT_OT_bake, PRELIGHT_OT_stop, PRELIGHT_OT_show, PRELIGHT_OT_look_again)
