"""Finds the Python package `prelight`, which does the work."""

import importlib
import sys

from .problems import Problem

VERSION = "0.1.0"  # version of the package that this add-on needs


def find():
    """The package. Raises a Problem that tells how to install it if it is missing or has another version."""
    try:
        found = importlib.import_module("prelight")
    except ImportError as error:
        raise Problem(f"The Python package prelight is not installed: {error}", how_to_install()) from None
    if found.__version__ != VERSION:
        raise Problem(f"The Python package prelight {found.__version__} is installed, but this add-on needs {VERSION}", how_to_install("restart Blender"))
    return found


def is_found():
    try:
        find()
    except Problem:
        return False
    return True


def how_to_install(then="Look Again"):
    python = f"{sys.version_info.major}{sys.version_info.minor}"
    return f'run "{sys.executable}" -m pip install prelight-{VERSION}-cp{python}-cp{python}-PLATFORM.whl, then {then}'
