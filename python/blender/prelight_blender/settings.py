"""The settings of the panel, which are kept with the scene."""

import bpy

from .request import Request

_WHAT = (
    ("AO", "Ambient Occlusion", "How open each vertex is, 0 to 1, as a colour attribute"),
    ("LIGHT", "Light at Vertices", "Irradiance of lamps, glowing surfaces and the world, all bounces, as a colour attribute, W/m²"),
    ("LIGHT_MAP", "Light Map", "This irradiance as a picture for all selected objects, with a UV map of its own"),
)
_DOMAINS = (
    ("CORNER", "Face Corner", "Hard edges stay hard"),
    ("POINT", "Vertex", "One value per vertex: the mean of its corners"),
)


class PrelightSettings(bpy.types.PropertyGroup):
    what: bpy.props.EnumProperty(name="Bake", items=_WHAT, description="The kind of result, and where it is stored")
    domain: bpy.props.EnumProperty(name="Domain", items=_DOMAINS, description="The elements that get the colour attribute's values")
    rays: bpy.props.IntProperty(name="Rays", default=256, min=1, soft_max=4096, description="Rays per vertex or texel; four times as many halve the noise")
    distance: bpy.props.FloatProperty(
        name="Distance", default=0.0, min=0.0, subtype="DISTANCE", description="Surfaces farther away than this occlude nothing; 0: all surfaces occlude"
    )
    texel_size: bpy.props.FloatProperty(
        name="Texel Size", default=0.0, min=0.0, precision=4, subtype="DISTANCE",
        description="Side of a texel; 0: such that all surfaces together get about 65,000",
    )
    denoise: bpy.props.BoolProperty(name="Denoise", default=False, description="Remove noise with Open Image Denoise, which must be installed")
    seed: bpy.props.IntProperty(name="Seed", default=0, min=0, description="Another seed gives other noise")
    world: bpy.props.BoolProperty(name="World", default=True, description="The world lights the objects, too")
    only_selected: bpy.props.BoolProperty(
        name="Only Selected", default=False, description="Other objects neither occlude nor reflect light"
    )
    show: bpy.props.BoolProperty(
        name="Show Result", default=True, description="Give the objects materials that show it; their own stay with their meshes"
    )

    def request(self):
        return Request(**{name: getattr(self, name) for name in Request.__dataclass_fields__})


class PrelightState(bpy.types.PropertyGroup):
    """The state of the work that the panel shows. It belongs to the window, not to the scene."""

    running: bpy.props.BoolProperty()
    stop: bpy.props.BoolProperty()
    stage: bpy.props.StringProperty()
    done: bpy.props.FloatProperty()
    problem: bpy.props.StringProperty()
    fix: bpy.props.StringProperty()
    notes: bpy.props.StringProperty()  # one per line


def state(context):
    return context.window_manager.prelight_state
