"""What the panel asks for, kept with the scene."""

import bpy

from .request import Request

_WHAT = (
    ("AO", "Ambient Occlusion", "How open each vertex is, 0 to 1, as a colour attribute"),
    ("LIGHT", "Light at Vertices", "Irradiance of lamps, glowing surfaces and the world, all bounces, as a colour attribute, W/m²"),
    ("LIGHT_MAP", "Light Map", "The same as a picture for all that is selected, with a UV map of its own"),
)
_DOMAINS = (
    ("CORNER", "Face Corner", "Hard edges stay hard"),
    ("POINT", "Vertex", "One value a vertex: the mean of its corners"),
)


class PrelightSettings(bpy.types.PropertyGroup):
    what: bpy.props.EnumProperty(name="Bake", items=_WHAT, description="What is baked, and where it goes")
    domain: bpy.props.EnumProperty(name="Domain", items=_DOMAINS, description="What the colour attribute belongs to")
    rays: bpy.props.IntProperty(name="Rays", default=256, min=1, soft_max=4096, description="A vertex or texel; four times as many halve the noise")
    distance: bpy.props.FloatProperty(
        name="Distance", default=0.0, min=0.0, subtype="DISTANCE", description="What is farther away occludes nothing; 0: all does"
    )
    texel_size: bpy.props.FloatProperty(
        name="Texel Size", default=0.0, min=0.0, precision=4, subtype="DISTANCE",
        description="Side of a texel; 0: such that all surfaces together get about 65,000",
    )
    denoise: bpy.props.BoolProperty(name="Denoise", default=False, description="By Open Image Denoise, which must be installed")
    seed: bpy.props.IntProperty(name="Seed", default=0, min=0, description="Another one gives other noise")
    world: bpy.props.BoolProperty(name="World", default=True, description="The world shines, too")
    only_selected: bpy.props.BoolProperty(
        name="Only Selected", default=False, description="Other objects neither occlude nor reflect light"
    )
    show: bpy.props.BoolProperty(
        name="Show Result", default=True, description="Give the objects materials that show it; their own stay with their meshes"
    )

    def request(self):
        return Request(**{name: getattr(self, name) for name in Request.__dataclass_fields__})


class PrelightState(bpy.types.PropertyGroup):
    """What the panel shows of the work; of the window, not of the scene."""

    running: bpy.props.BoolProperty()
    stop: bpy.props.BoolProperty()
    stage: bpy.props.StringProperty()
    done: bpy.props.FloatProperty()
    problem: bpy.props.StringProperty()
    fix: bpy.props.StringProperty()
    notes: bpy.props.StringProperty()  # one a line


def state(context):
    return context.window_manager.prelight_state
