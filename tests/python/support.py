"""Helpers for several tests."""

import functools

import numpy as np

import prelight


@functools.cache
def device():
    return prelight.Device()


@functools.cache
def cornell():
    return prelight.builtin("cornell")


@functools.cache
def baked():
    """Cornell with one of every technique that is quick."""
    return prelight.bake(
        cornell(), ao=True, sh=3, ch=3, haar=4, light_groups=True, horizons=8, bounces=1, rays=64, device=device()
    )


def square(size=1.0):
    """Positions and triangles of a square on the ground, made of two triangles that look up."""
    positions = size * np.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], dtype=np.float32)
    return positions, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32)


def named(case, where, call, *parts):
    """Expects the call to fail with an error at `where` that contains all the parts, and returns it."""
    with case.assertRaises(prelight.Error) as caught:
        call()
    case.assertIn(where, caught.exception.where)
    for part in parts:
        case.assertIn(part, str(caught.exception))
    return caught.exception
