"""Exceptions. Every message says what happened and where, what was got and expected, and what to do."""

import re

from . import _native

# Structures whose arguments are named after the whole structure.
_STRUCTURES = {"AnimationKeys": "animation", "BakeRequest": "bake"}
# Options of the command line in messages of shadings.
_OPTION = re.compile(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)")
_FIELD = re.compile(
    r"\b(?:[A-Z]\w*(?:Request|Options|Goal|Limits|Arrays|Light)|AnimationKeys|Effort|FileCompression|OccluderKind|Relighter)::\w+"
)


def in_python(text):
    """A message of the library with its fields replaced by the names of Python's arguments."""
    text = _FIELD.sub(lambda match: _native._argument_of(match.group(0)), text)
    for structure, argument in _STRUCTURES.items():
        text = text.replace(structure, argument)
    return _OPTION.sub(lambda match: match.group(1).replace("-", "_"), text)


class Error(Exception):
    """An error of prelight: `where` it happened, `what` it is, and the `fix`, which may be empty."""

    def __init__(self, where, what, fix=""):
        self.where, self.what, self.fix = where, what, fix
        super().__init__(f"{where}: {what}" + (f" ({fix})" if fix else ""))

    def __reduce__(self):
        return type(self), (self.where, self.what, self.fix)


class UsageError(Error, ValueError):
    """An argument that makes no sense."""


class InputError(Error, ValueError):
    """A file that is not what it claims to be, or a scene without the data that a call needs."""


class DeviceError(Error):
    """There is no device, or none with this name."""


class OutOfMemory(Error, MemoryError):
    """There is not enough memory."""


class Interrupted(Error):
    """A progress function returned False."""


class StaleBakeWarning(UserWarning):
    """A scene has changed since it was baked."""


_CLASSES = {2: UsageError, 3: InputError, 4: DeviceError, 5: OutOfMemory, 130: Interrupted}


def of_library(code, where, what, fix):
    return _CLASSES.get(code, Error)(in_python(where), in_python(what), in_python(fix))
