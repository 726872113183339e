"""The panel in the 3D view's sidebar."""

import textwrap

import bpy

from . import package
from .settings import state

_LINE = 46  # characters per line of the sidebar


def _text(layout, text, icon="NONE"):
    for line in textwrap.wrap(text, _LINE, break_on_hyphens=False):
        layout.label(text=line, icon=icon)
        icon = "BLANK1" if icon != "NONE" else icon


def _draw_missing(layout):
    _text(layout, "The Python package prelight is not installed or has another version. Install the zip of the add-on that contains it, or", "ERROR")
    _text(layout, package.how_to_install())
    layout.operator("prelight.look_again", icon="FILE_REFRESH")


def _draw_options(layout, settings):
    layout.prop(settings, "what")
    if settings.what == "LIGHT_MAP":
        layout.prop(settings, "texel_size")
    else:
        layout.prop(settings, "domain")
    layout.prop(settings, "rays")
    if settings.what == "AO":
        layout.prop(settings, "distance")
    else:
        layout.prop(settings, "denoise")
        layout.prop(settings, "world")
    layout.prop(settings, "only_selected")
    layout.prop(settings, "show")
    layout.prop(settings, "seed")


def _draw_progress(layout, told):
    text = f"{told.stage} {100.0 * told.done:.0f} %"
    if hasattr(layout, "progress"):  # since Blender 4.0
        layout.progress(factor=told.done, text=text)
    else:
        layout.label(text=text)
    layout.operator("prelight.stop", icon="CANCEL")


def _draw_messages(layout, told):
    if told.problem:
        box = layout.box()
        _text(box, told.problem, "ERROR")
        if told.fix:
            _text(box, told.fix, "FORWARD")
    for note in told.notes.splitlines():
        _text(layout.box(), note, "INFO")


class PRELIGHT_PT_bake(bpy.types.Panel):
    bl_idname = "PRELIGHT_PT_bake"
    bl_label = "Prelight"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Prelight"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        if not package.is_found():
            _draw_missing(layout)
            return
        told = state(context)
        options = layout.column()
        options.enabled = not told.running
        _draw_options(options, context.scene.prelight)
        if told.running:
            _draw_progress(layout, told)
        else:
            layout.operator("prelight.bake", icon="RENDER_STILL")
            layout.operator("prelight.show", icon="HIDE_OFF")
        _draw_messages(layout, told)
