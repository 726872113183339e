"""Bakes ambient occlusion, light and light maps of Blender's scenes with Prelight. docs/blender.md is a tutorial."""

import bpy

from . import operators, panel, settings

bl_info = {
    "name": "Prelight",
    "description": "Bakes light into vertices and light maps",
    "author": "Prelight maintainers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Prelight",
    "category": "Render",
}

_CLASSES = (settings.PrelightSettings, settings.PrelightState, *operators.CLASSES, panel.PRELIGHT_PT_bake)


def register():
    for kind in _CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.prelight = bpy.props.PointerProperty(type=settings.PrelightSettings)
    bpy.types.WindowManager.prelight_state = bpy.props.PointerProperty(type=settings.PrelightState, options={"SKIP_SAVE"})
    bpy.types.Material.prelight_original = bpy.props.PointerProperty(type=bpy.types.Material)
    bpy.types.Material.prelight_is_shown = bpy.props.BoolProperty()


def unregister():
    del bpy.types.Material.prelight_is_shown
    del bpy.types.Material.prelight_original
    del bpy.types.WindowManager.prelight_state
    del bpy.types.Scene.prelight
    for kind in reversed(_CLASSES):
        bpy.utils.unregister_class(kind)
