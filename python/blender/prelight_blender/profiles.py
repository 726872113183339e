"""Photometric files that say how brightly lamps shine at each angle from their axis, as a factor for their intensity."""

import math

import numpy as np

_STEPS = 91
_NARROWEST_FADE = math.radians(0.01)  # files distinguish angles that differ by at least 0.0001 degrees


def lambertian():
    angles = np.linspace(0.0, 0.5 * math.pi, _STEPS)
    return _file(angles, np.maximum(np.cos(angles), 0.0))


def area(spread):
    """A surface whose light Cycles restricts to half of `spread` from its normal, as with a grid before it, without reducing its
    power."""
    half = 0.5 * min(spread, math.pi)
    if half > 0.5 * math.pi - 1e-3:
        return lambertian()
    angles = np.linspace(0.0, max(half, _NARROWEST_FADE), _STEPS)
    passed = np.maximum(math.tan(half) - np.tan(angles), 0.0) / max(math.tan(half) - half, 1e-9)
    return _file(angles, np.cos(angles) * passed)


def spot(size, blend):
    """A spot that fades by t^2 (3 - 2 t) of the cosine within its cone, over a share `blend` of it."""
    half = min(0.5 * size, 0.5 * math.pi)
    edge = math.cos(half)
    inner = min(math.acos(edge + blend * (1.0 - edge)), half - _NARROWEST_FADE)
    angles = np.linspace(inner, half, _STEPS if half - inner > _STEPS * 1e-5 else 2)
    t = np.clip((np.cos(angles) - edge) / (math.cos(inner) - edge), 0.0, 1.0)
    shares = t * t * (3.0 - 2.0 * t)
    if inner > _NARROWEST_FADE:
        angles, shares = np.append(0.0, angles), np.append(1.0, shares)
    return _file(angles, shares)


def _file(angles, shares):
    degrees = " ".join(f"{angle:.6f}" for angle in np.degrees(angles))
    values = " ".join(f"{share:.7g}" for share in shares)
    return f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(shares)} 1 1 2 0 0 0\n1 1 0\n{degrees}\n0\n{values}\n".encode()
