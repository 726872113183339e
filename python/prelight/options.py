"""Options of the package's functions, as the library's tables describe them."""

from dataclasses import dataclass
from typing import Any, Literal

from . import _native
from .errors import UsageError


@dataclass(frozen=True)
class Option:
    """An option: the `name` of its argument, its `kind`, `help` and `unit`, its `default`, the `expected` values in words,
    and the `choices` of kind "choice". Options of kind "own" are of types that their function describes."""

    name: str
    kind: Literal["flag", "number", "choice", "own"]
    help: str
    unit: str
    default: Any
    expected: str
    choices: tuple[str, ...]


# : The native structures that the arguments of a function fill.
_STRUCTURES = {
    "bake": (_native._BakeRequest, _native._AnimationKeys),
    "load": (_native._LoadOptions,),
    "photons": (_native._PhotonOptions,),
    "reference": (_native._RenderOptions, _native._ReferenceGoal),
    "render": (_native._RenderOptions,),
}


def options(function: str) -> list[Option]:
    """The options of a function of the package: "bake", "draw", "load", "photons", "reference" or "render"."""
    if function == "draw":
        from .drawing import renderer  # which loads OpenGL

        return [Option(*row) for row in renderer().DrawRequest._options]
    if function not in _STRUCTURES:
        raise UsageError("function", f"got {function!r}, expected one of draw, {', '.join(_STRUCTURES)}")
    return [Option(*row) for structure in _STRUCTURES[function] for row in structure._options]
