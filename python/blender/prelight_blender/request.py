"""The options of a bake."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Request:
    what: str = "AO"  # AO, LIGHT or LIGHT_MAP
    domain: str = "CORNER"
    rays: int = 256
    distance: float = 0.0  # greatest distance of occluders; 0: any
    texel_size: float = 0.0  # 0: the usual number of texels
    denoise: bool = False
    seed: int = 0
    world: bool = True
    only_selected: bool = False
    show: bool = True

    def options(self):
        """The arguments for prelight.bake()."""
        if self.what == "AO":
            return {"ao": True, "rays": self.rays, "farthest": self.distance, "seed": self.seed}
        options = {"light_map": True, "rays": self.rays, "texel_size": self.texel_size, "seed": self.seed}
        return {**options, "denoise": True} if self.denoise else options
