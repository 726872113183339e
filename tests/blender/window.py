"""Uses the add-on in a real window: bakes, ends a bake by Esc, bakes again, undoes.

    blender --factory-startup --python-use-system-env --enable-event-simulate --python window.py -- [SCREENSHOT.png]

Says what it saw, a line each, and ends with "all is well" if that is so.
"""

import os
import sys
import time
import traceback

import bpy

import prelight_blender

SHOT = sys.argv[sys.argv.index("--") + 1] if "--" in sys.argv[:-1] else ""
MOST_SECONDS = 120.0


class Session:
    """The steps of a user. Blender calls one after another and redraws in between."""

    def __init__(self):
        self.window = bpy.context.window_manager.windows[0]
        self.area = next(area for area in self.window.screen.areas if area.type == "VIEW_3D")
        self.area.spaces[0].show_region_ui = True
        self.state = bpy.context.window_manager.prelight_state
        self.settings = bpy.context.scene.prelight
        bpy.ops.mesh.primitive_plane_add(size=7, location=(0, 0, -1))
        self.cube, self.floor = bpy.data.objects["Cube"], bpy.context.object
        self.steps = [self.open_tab, self.begin_long, self.see_progress, self.press_escape, self.see_nothing_changed,
                      self.begin_short, self.see_result, self.look, self.take_picture, self.undo, self.see_undone]

    def context(self):
        region = next(region for region in self.area.regions if region.type == "WINDOW")
        return bpy.context.temp_override(window=self.window, area=self.area, region=region)

    def press(self, kind, x, y):
        self.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
        for value in ("PRESS", "RELEASE"):
            self.window.event_simulate(type=kind, value=value, x=x, y=y)

    def step(self):
        """Runs a step and returns the seconds until the next one; a step that waits for something is repeated."""
        try:
            wait = self.steps[0]()
            if wait is None:
                if time.monotonic() - self.begun > MOST_SECONDS:
                    raise AssertionError(f"{self.steps[0].__name__} takes too long")
                return 0.2
            self.steps.pop(0)
            self.begun = time.monotonic()
            if self.steps:
                return wait
            print("all is well", flush=True)
            os._exit(0)
        except Exception:
            traceback.print_exc()
            sys.stderr.flush()
            os._exit(1)

    begun = time.monotonic()

    def open_tab(self):
        """Finds the add-on's tab at the sidebar's right edge, since tabs have no names in Python."""
        sidebar = next(region for region in self.area.regions if region.type == "UI")
        x = sidebar.x + sidebar.width - 12
        self.press("LEFTMOUSE", x, self.area.y + self.area.height - 222)
        return 1.0

    def bake(self, what, rays):
        self.settings.what, self.settings.rays = what, rays
        bpy.ops.object.select_all(action="DESELECT")
        self.cube.select_set(True)
        self.floor.select_set(True)
        with self.context():
            assert bpy.ops.prelight.bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}

    def begin_long(self):
        self.before = (bpy.data.images.keys(), bpy.data.materials.keys(), self.cube.data.attributes.keys())
        self.bake("LIGHT_MAP", 20_000)
        return 0.5

    def see_progress(self):
        assert self.state.running, "it does not run"
        if self.state.done == 0.0:
            return None
        print(f"progress: {self.state.stage} {100 * self.state.done:.1f} %", flush=True)
        return 0.1

    def press_escape(self):
        self.press("ESC", self.area.x + 300, self.area.y + 300)
        return 0.1

    def see_nothing_changed(self):
        if self.state.running:
            return None
        print(f"ended {time.monotonic() - self.begun:.1f} s after Esc", flush=True)
        assert (bpy.data.images.keys(), bpy.data.materials.keys(), self.cube.data.attributes.keys()) == self.before
        return 0.1

    def begin_short(self):
        self.bake("LIGHT_MAP", 256)
        return 0.2

    def see_result(self):
        if self.state.running:
            return None
        assert "Prelight" in self.cube.data.uv_layers and "Prelight Light Map" in bpy.data.images, self.state.problem
        assert self.cube.material_slots[0].material.prelight_is_shown
        return 0.2

    def look(self):
        self.area.spaces[0].shading.type = "MATERIAL"
        bpy.ops.object.select_all(action="DESELECT")
        return 25.0 if SHOT else 0.5

    def take_picture(self):
        if SHOT:
            with self.context():
                bpy.ops.screen.screenshot(filepath=SHOT)
        return 0.1

    def undo(self):
        with self.context():
            bpy.ops.ed.undo()
        return 0.2

    def see_undone(self):
        assert "Prelight" not in bpy.data.objects["Cube"].data.uv_layers and "Prelight Light Map" not in bpy.data.images
        return 0.0


def main():
    bpy.context.preferences.view.show_splash = False
    prelight_blender.register()
    session = Session()
    bpy.app.timers.register(session.step, first_interval=1.0)


main()
