"""Checks of arguments for the functions of the package."""

import difflib
import functools
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeAlias

from . import _native
from .errors import UsageError
from .options import Option

# : Gets the name of a stage and the finished share of it, 0 to 1. Returning False or raising an exception ends the work.
Progress: TypeAlias = Callable[[str, float], bool | None]


@functools.cache
def _options_of(kind: type) -> dict[str, Option]:
    """The options of a native structure that a table describes, by the names of their arguments."""
    described = (Option(*row) for row in getattr(kind, "_options", ()))
    return {option.name: option for option in described if option.kind != "own"}


def _expectation(target: Any, name: str) -> str:
    """The values that a field without a row in a table can have, in words."""
    words = {bool: "True or False", str: "a text", int: "a whole number", float: "a number", list: "a list"}
    return words.get(type(getattr(target, name)), "another type")


def fill(target: Any, /, **values: Any) -> Any:
    """Sets the fields of a native structure. Raises UsageError for a value of a wrong type, naming the right one."""
    options = _options_of(type(target))
    for name, value in values.items():
        if name in options:
            target._set(name, value)
            continue
        try:
            setattr(target, name, value)
        except (TypeError, OverflowError):
            raise UsageError(
                name, f"got {value!r} of type {type(value).__name__}, expected {_expectation(target, name)}"
            ) from None
    return target


# : How to get an object of a class, for callers who passed something else.
_MADE_BY = {
    _native.Scene: "prelight.load(PATH), prelight.builtin(NAME) or prelight.make_scene(...)",
    _native.Bake: "prelight.bake(scene, ...) or prelight.carried_bake(scene)",
    _native.Device: "prelight.Device(NAME_OR_INDEX)",
    _native.Sky: "prelight.read_sky(PATH), prelight.constant_sky(...) or prelight.studio_sky()",
    _native.Camera: "prelight.look_at(...)",
}


def require(kind: Any, name: str, value: Any, *, optional: bool = True) -> None:
    """Refuses an argument that is not of a class of the package; None is allowed if the argument is optional."""
    if isinstance(value, kind) or (optional and value is None):
        return
    raise UsageError(
        name, f"got {value!r} of type {type(value).__name__}, expected a prelight.{kind.__name__}", _MADE_BY[kind]
    )


def require_run(scene: Any, device: Any, progress: Any = None) -> None:
    """Refuses a `scene`, `device` or `progress` that a call cannot work with."""
    require(_native.Scene, "scene", scene, optional=False)
    require(_native.Device, "device", device)
    if progress is not None and not callable(progress):
        raise UsageError("progress", f"got {progress!r}, expected a function that takes a stage's name and a fraction")


def known_name(call: str, given: Iterable[str], names: Sequence[str]) -> None:
    """Refuses an argument that `call` does not have, with the name that was probably meant."""
    for name in given:
        if name in names:
            continue
        near = difflib.get_close_matches(name, names, n=1)
        fix = f"did you mean {near[0]}?" if near else f"it has {', '.join(sorted(names))}"
        raise UsageError(name, f"{call} has no such argument", fix)


def exclusive(**values: Any) -> None:
    """Refuses a second argument where only one of several may be given."""
    given = [name for name, value in values.items() if value is not None]
    if len(given) > 1:
        raise UsageError(given[0], f"it excludes {given[1]}", "give one of the two")
