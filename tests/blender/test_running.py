"""The add-on in Blender: registering, running in a thread, cancelling, undoing."""

import time
import types
from unittest import mock

import bpy
import numpy as np
from support import AddonTest, add, lamp, picture

import prelight_blender
from prelight_blender import operators, package, panel
from prelight_blender.request import Request
from prelight_blender.run import Run


def contents():
    """The names of the file's data and of the data in its meshes."""
    kinds = [kind for kind in dir(bpy.data) if isinstance(getattr(bpy.data, kind), bpy.types.bpy_prop_collection)]
    found = {kind: sorted(item.name for item in getattr(bpy.data, kind)) for kind in kinds}
    for mesh in bpy.data.meshes:
        found[mesh.name] = sorted(attribute.name for attribute in mesh.attributes), [m and m.name for m in mesh.materials], list(mesh.keys())
    for item in bpy.data.objects:
        found["object " + item.name] = [(slot.link, slot.material and slot.material.name) for slot in item.material_slots]
    return found


class Layout:
    """A stand-in for Blender's layout that records what a panel shows."""

    def __init__(self, shown=None):
        self.shown = [] if shown is None else shown

    def column(self):
        return Layout(self.shown)

    box = column

    def label(self, text="", icon="NONE"):
        self.shown.append(text)

    def prop(self, settings, name):
        self.shown.append(settings.bl_rna.properties[name].name)

    def operator(self, name, icon="NONE"):
        self.shown.append(name)

    def progress(self, factor, text):
        self.shown.append(f"{text} of {factor:.2f}")


def drawn():
    layout = Layout()
    panel.PRELIGHT_PT_bake.draw(types.SimpleNamespace(layout=layout), bpy.context)
    return layout.shown


class Registering(AddonTest):
    def test_Unregistered_NothingIsLeft(self):
        prelight_blender.unregister()
        self.assertFalse(hasattr(bpy.types.Scene, "prelight"))
        self.assertFalse(hasattr(bpy.types, "PRELIGHT_PT_bake"))
        self.assertFalse(hasattr(bpy.types.Material, "prelight_original"))
        prelight_blender.register()
        self.assertTrue(hasattr(bpy.types, "PRELIGHT_PT_bake"))

    def test_Panel_ShowsWhatConcernsTheChoice(self):
        self.settings.what = "AO"
        self.assertIn("Distance", drawn())
        self.assertNotIn("World", drawn())
        self.settings.what = "LIGHT_MAP"
        self.assertIn("Texel Size", drawn())
        self.assertNotIn("Domain", drawn())
        self.assertIn("prelight.bake", drawn())

    def test_Panel_ShowsProgressAndCancel(self):
        state = bpy.context.window_manager.prelight_state
        state.running, state.stage, state.done = True, "rays", 0.25
        self.assertIn("rays 25 % of 0.25", drawn())
        self.assertIn("prelight.stop", drawn())
        self.assertNotIn("prelight.bake", drawn())
        state.running = False

    def test_MissingPackage_PanelAndBakeSayHowToInstallIt(self):
        add("plane")
        with mock.patch.object(package.importlib, "import_module", side_effect=ImportError("No module named 'prelight'")):
            text = " ".join(drawn())
            self.assertIn("is not installed", text)
            self.assertIn("pip install", text)
            self.assertIn("prelight.look_again", text)
            what, fix = self.problem()
        self.assertIn("No module named 'prelight'", what)
        self.assertIn("-m pip install", fix)


    def test_PackageOfAnotherVersion_IsNamed(self):
        add("plane")
        with mock.patch.object(package.importlib, "import_module", return_value=types.SimpleNamespace(__version__="9.9.9")):
            what, fix = self.problem()
        self.assertIn("prelight 9.9.9 is installed, but this add-on needs 0.1.0", what)
        self.assertIn("-m pip install", fix)


class Running(AddonTest):
    def scene_to_bake(self):
        head = add("monkey", size=1)
        add("plane", size=4)
        lamp("POINT", energy=100)
        return head

    def test_Run_TellsProgress_AndLeavesNoFile(self):
        head = self.scene_to_bake()
        run = Run(bpy.context, Request(what="LIGHT_MAP", rays=512))
        folder = run._folder
        self.assertTrue((folder / "scene.glb").exists())
        stages = set()
        while not run.is_done():
            stages.add(run.progress()[0])
            time.sleep(0.02)
        self.assertNotIn("Prelight", head.data.uv_layers)  # The thread does not touch Blender's data.
        self.assertTrue(run.finish())
        self.assertGreater(len(stages - {""}), 1)
        self.assertFalse(folder.exists())
        self.assertIn("Prelight", head.data.uv_layers)

    def test_Cancelled_SceneIsAsItWas(self):
        self.scene_to_bake()
        for what in ("AO", "LIGHT_MAP"):
            with self.subTest(what=what):
                before = contents()
                run = Run(bpy.context, Request(what=what, rays=1_000_000))
                while run.progress()[1] == 0.0 and not run.is_done():
                    time.sleep(0.01)
                run.cancel()
                begun = time.monotonic()
                self.assertFalse(run.finish())
                self.assertLess(time.monotonic() - begun, 5.0)
                self.assertEqual(contents(), before)
                self.assertFalse(run._folder.exists())

    def test_Refused_SceneIsAsItWas(self):
        head = self.scene_to_bake()
        head.modifiers.new("Smooth", "SUBSURF")
        before = contents()
        self.problem()
        self.assertEqual(contents(), before)

    def test_MeshChangedMeanwhile_NothingIsWritten(self):
        head = self.scene_to_bake()
        run = Run(bpy.context, Request(what="AO", rays=64))
        head.data.vertices.add(1)
        before = contents()
        with self.assertRaisesRegex(Exception, 'faces of "Suzanne" were changed'):
            run.finish()
        self.assertEqual(contents(), before)

    def test_ObjectRemovedMeanwhile_NothingIsWritten(self):
        head = self.scene_to_bake()
        run = Run(bpy.context, Request(what="AO", rays=64))
        bpy.data.objects.remove(head)
        before = contents()
        with self.assertRaisesRegex(Exception, '"Suzanne" was removed'):
            run.finish()
        self.assertEqual(contents(), before)

    def test_Undo_TakesAllOfItBack_AndRedoBringsIt(self):
        self.scene_to_bake()
        self.settings.what, self.settings.rays = "LIGHT_MAP", 16
        bpy.ops.ed.undo_push(message="before")
        before = contents()
        bpy.ops.prelight.bake("EXEC_DEFAULT", True)
        after, light = contents(), picture(bpy.data.images["Prelight Light Map"])
        self.assertNotEqual(after, before)
        bpy.ops.ed.undo()
        self.assertEqual(contents(), before)
        bpy.ops.ed.redo()
        self.assertEqual(contents(), after)
        np.testing.assert_array_equal(picture(bpy.data.images["Prelight Light Map"]), light)


class Event:
    def __init__(self, kind, value="PRESS"):
        self.type, self.value = kind, value


class Window:
    """A stand-in for the context of a window, which Blender lacks in the background."""

    def __init__(self):
        self.told, self.progress = [], []
        self.scene, self.window, self.screen, self.mode = bpy.context.scene, None, None, "OBJECT"
        self.state = bpy.context.window_manager.prelight_state
        self.window_manager = types.SimpleNamespace(
            prelight_state=self.state, event_timer_add=lambda *a, **k: "timer", event_timer_remove=lambda timer: None,
            progress_begin=lambda *a: None, progress_update=self.progress.append, progress_end=lambda: self.progress.append("end"),
            modal_handler_add=lambda operator: None)
        self.workspace = types.SimpleNamespace(status_text_set=self.told.append)

    def __getattr__(self, name):
        return getattr(bpy.context, name)


class Modal(AddonTest):
    """Calls the operator as a window does, through its methods, with stand-ins for the window."""

    def setUp(self):
        super().setUp()
        self.head = add("monkey", size=1)
        self.window = Window()
        kind = operators.PRELIGHT_OT_bake
        self.reports = []
        self.operator = types.SimpleNamespace(_run=None, _timer=None, report=lambda level, text: self.reports.append(text))
        for name in ("execute", "invoke", "modal", "cancel", "_begin", "_finish", "_tell_progress", "_leave_modal"):
            setattr(self.operator, name, types.MethodType(getattr(kind, name), self.operator))

    def begin(self, rays):
        self.settings.rays = rays
        with mock.patch.object(operators, "bpy", types.SimpleNamespace(app=types.SimpleNamespace(background=False))):
            return self.operator.invoke(self.window, Event("LEFTMOUSE"))

    def until_done(self):
        for _ in range(2000):
            said = self.operator.modal(self.window, Event("TIMER"))
            if said != {"PASS_THROUGH"}:
                return said
            time.sleep(0.01)
        self.fail("it does not end")

    def test_Bake_TellsProgressAndFinishes(self):
        self.assertEqual(self.begin(20_000), {"RUNNING_MODAL"})
        self.assertTrue(self.window.state.running)
        self.assertEqual(self.operator.modal(self.window, Event("MOUSEMOVE")), {"PASS_THROUGH"})
        self.assertEqual(self.until_done(), {"FINISHED"})
        self.assertFalse(self.window.state.running)
        self.assertIn("Prelight AO", self.head.data.attributes)
        self.assertTrue(any(isinstance(text, str) and "Esc" in text for text in self.window.told))
        self.assertIsNone(self.window.told[-1])
        self.assertEqual(self.window.progress[-1], "end")

    def test_EscapeAndTheButton_LeaveTheSceneAsItWas(self):
        def escape():
            self.assertEqual(self.operator.modal(self.window, Event("ESC")), {"RUNNING_MODAL"})

        for stop in (escape, bpy.ops.prelight.stop):
            before = contents()
            self.assertEqual(self.begin(10_000_000), {"RUNNING_MODAL"})
            stop()
            self.assertEqual(self.until_done(), {"CANCELLED"})
            self.assertEqual(contents(), before)
            self.assertIn("nothing was changed", self.reports[-1])

    def test_BlenderEnds_TheThreadEndsToo(self):
        self.begin(10_000_000)
        self.operator.cancel(self.window)
        self.assertTrue(self.operator._run.is_done())
        self.assertNotIn("Prelight AO", self.head.data.attributes)

    def test_Refused_PanelSaysWhy(self):
        bpy.ops.object.select_all(action="DESELECT")
        self.assertEqual(self.begin(16), {"CANCELLED"})
        self.assertFalse(self.window.state.running)
        self.assertIn("Nothing is selected", " ".join(drawn()))
