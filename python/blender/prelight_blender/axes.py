"""Blender's space, +Z up, and Prelight's, +Y up."""

import numpy as np

#: Takes (x, y, z) of Blender to (x, z, -y).
TO_PRELIGHT = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=np.float64)


def node_matrix(matrix_world):
    """What a glTF node has of an object's matrix, in columns."""
    return (TO_PRELIGHT @ np.array(matrix_world, dtype=np.float64)).T.reshape(-1).tolist()
