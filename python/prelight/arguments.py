"""What the functions of the package have in common."""

from collections.abc import Callable
from typing import Any, TypeAlias

from .errors import UsageError

#: Gets the name of a stage and how much of it is done, 0 to 1; False ends the work, and so does what it raises.
Progress: TypeAlias = Callable[[str, float], bool | None]


def fill(target: Any, /, **values: Any) -> Any:
    """Sets the fields of a native structure; a value of a wrong type is named."""
    for name, value in values.items():
        try:
            setattr(target, name, value)
        except TypeError:
            raise UsageError(name, f"got {value!r} of type {type(value).__name__}, which it cannot be") from None
        except OverflowError:
            raise UsageError(name, f"got {value!r}, which is out of its range") from None
    return target


def choice(kind: Any, name: str, value: str) -> Any:
    """The member of an enumeration that is called so."""
    known = [member for member in dir(kind) if not member.startswith("_") and isinstance(getattr(kind, member), kind)]
    if value not in known:
        raise UsageError(name, f"got {value!r}, expected one of {', '.join(known)}")
    return getattr(kind, value)
