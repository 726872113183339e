"""Places that represent a lamp with a size. No two of them coincide as seen along any direction, so that its shadows fade in as
many steps as there are places."""

import math

import numpy as np

_PLACES, _STEP = 55, 34  # neighbours in Fibonacci's series, which give a lattice


def in_square():
    """Places [place, xy] spread evenly over -1..1 in x and y."""
    i = np.arange(_PLACES)
    return np.stack([(i + 0.5) / _PLACES, (i * _STEP / _PLACES + 0.5 / _PLACES) % 1.0], axis=1) * 2.0 - 1.0


def in_disk():
    """Places [place, xy] spread evenly over a disk of radius 1, along a golden spiral."""
    i = np.arange(_PLACES)
    radius, angle = np.sqrt((i + 0.5) / _PLACES), i * math.pi * (3.0 - math.sqrt(5.0))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


def in_ball():
    """Places [place, xyz] within a ball of radius 1 that look like an even disk from every side, as a shining ball does. Their
    density is 1 / sqrt(1 - r^2), whose integral along each line through the ball is the same. The integral of r^2 times this
    density is (asin r - r sqrt(1 - r^2)) / 2."""
    i = np.arange(_PLACES)
    z, angle = 1.0 - (2.0 * i + 1.0) / _PLACES, i * math.pi * (3.0 - math.sqrt(5.0))
    across = np.sqrt(1.0 - z * z)
    r = np.sin(np.linspace(0.0, 0.5 * math.pi, 1001))
    within = np.arcsin(r) - r * np.sqrt(1.0 - r * r)
    radius = np.interp(((i * _STEP + 0.5) / _PLACES) % 1.0 * 0.5 * math.pi, within, r)
    return radius[:, None] * np.stack([across * np.cos(angle), across * np.sin(angle), z], axis=1)


def moved(x, y, z):
    frame = np.eye(4)
    frame[:3, 3] = x, y, z
    return frame


def aimed(x, y, z):
    """A frame whose -Z points along a direction."""
    back = -np.array([x, y, z]) / math.sqrt(x * x + y * y + z * z)
    side = np.cross((0.0, 1.0, 0.0) if abs(back[1]) < 0.9 else (1.0, 0.0, 0.0), back)
    side /= np.linalg.norm(side)
    frame = np.eye(4)
    frame[:3, :3] = np.stack([side, np.cross(back, side), back], axis=1)
    return frame
