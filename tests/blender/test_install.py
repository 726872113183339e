"""The zip as Blender installs it, in a Blender of its own with empty user folders."""

import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest
import zipfile

import bpy

SOURCE = pathlib.Path(__file__).resolve().parents[2]
WHEEL = pathlib.Path(os.environ["PRELIGHT_WHEEL"])
BAKE = """
bpy.ops.mesh.primitive_monkey_add()
bpy.context.scene.prelight.rays = 16
assert bpy.ops.prelight.bake() == {"FINISHED"}
assert "Prelight AO" in bpy.context.object.data.attributes
"""
EXTENSION = """
import os, sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.extensions.package_install_files(filepath=sys.argv[1], repo="user_default", enable_on_install=True)
assert "bl_ext.user_default.prelight_blender" in bpy.context.preferences.addons
"""
ADDON = """
import os, sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_install(filepath=sys.argv[1])
bpy.ops.preferences.addon_enable(module="prelight_blender")
assert "prelight_blender" in bpy.context.preferences.addons
"""
FIND = "import importlib.util, sys; sys.exit(importlib.util.find_spec('prelight') is not None)"
HAS_ONE = subprocess.run([sys.executable, "-I", "-c", FIND], check=False).returncode != 0
END = "\nsys.stdout.flush(); print('done', flush=True); os._exit(0)\n"


class Zip(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def zip(self, *arguments):
        path = self.folder / "prelight_blender.zip"
        subprocess.run([SOURCE / "packaging/blender-addon", path, *arguments], check=True)
        return path

    def in_blender(self, code, path, package=None):
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        environment["BLENDER_USER_RESOURCES"] = str(self.folder / "resources")
        if package is not None:
            environment["PYTHONPATH"] = package
        done = subprocess.run([sys.executable, "-c", code + END, path], env=environment, capture_output=True, text=True)
        self.assertIn("done", done.stdout, done.stdout + done.stderr)
        return done.stdout

    def test_Zip_IsAValidExtension(self):
        checker = pathlib.Path(bpy.utils.system_resource("SCRIPTS"), "addons_core/bl_pkg/cli/blender_ext.py")
        for arguments in ((), ("--wheel", WHEEL)):
            done = subprocess.run([sys.executable, checker, "validate", self.zip(*arguments)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_Zip_IsTheSameEachTime(self):
        self.assertEqual(self.zip().read_bytes(), self.zip().read_bytes())

    def test_Manifest_NamesTheWheelAndItsPlatform(self):
        with zipfile.ZipFile(self.zip("--wheel", WHEEL)) as archive:
            manifest = tomllib.loads(archive.read("prelight_blender/blender_manifest.toml").decode())
            self.assertIn(f"prelight_blender/wheels/{WHEEL.name}", archive.namelist())
        self.assertEqual(manifest["wheels"], [f"./wheels/{WHEEL.name}"])
        self.assertEqual(len(manifest["platforms"]), 1)

    @unittest.skipIf(HAS_ONE, "this Python has a prelight of its own")
    def test_ExtensionWithWheel_Bakes(self):
        code = EXTENSION + "import prelight; assert prelight.__file__.startswith(os.environ['BLENDER_USER_RESOURCES'])\n" + BAKE
        self.in_blender(code, self.zip("--wheel", WHEEL))

    @unittest.skipIf(HAS_ONE, "this Python has a prelight of its own")
    def test_ExtensionWithoutWheel_SaysWhatIsMissing(self):
        code = EXTENSION + """
bpy.ops.mesh.primitive_monkey_add()
try:
    bpy.ops.prelight.bake()
except RuntimeError as error:
    print(error)
"""
        self.assertIn("The Python package prelight is not installed", self.in_blender(code, self.zip()))

    def test_AddOn_Bakes(self):
        self.in_blender(ADDON + BAKE, self.zip(), os.environ["PYTHONPATH"].split(os.pathsep)[0])
