"""Finds the Python package `prelight`, which does the work."""

import importlib
import sys

from .problems import Problem


def find():
    """The package; a Problem that tells how to install it where there is none."""
    try:
        return importlib.import_module("prelight")
    except ImportError as error:
        raise Problem(f"The Python package prelight is not here: {error}", how_to_install()) from None


def is_found():
    try:
        find()
    except Problem:
        return False
    return True


def how_to_install():
    version = f"{sys.version_info.major}{sys.version_info.minor}"
    return f'run "{sys.executable}" -m pip install prelight-VERSION-cp{version}-cp{version}-PLATFORM.whl, then Look Again'
