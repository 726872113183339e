"""Conversion from Blender's space, where +Z is up, to Prelight's, where +Y is up."""

import numpy as np

# : Maps Blender's (x, y, z) to (x, z, -y).
TO_PRELIGHT = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=np.float64)


def node_matrix(matrix_world):
    """The matrix of a glTF node, column by column, for an object's matrix."""
    return (TO_PRELIGHT @ np.array(matrix_world, dtype=np.float64)).T.reshape(-1).tolist()
