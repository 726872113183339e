"""Prints the mean FLIP of pairs of pictures, one number per line.

    flip.py FILE WIDTH HEIGHT

FILE holds 32-bit floats, [pair][reference, test][row][column][channel], sRGB-encoded in [0,1]. Needs flip-evaluator of
PyPI, the program of the authors of the measure (Andersson et al., "FLIP: A Difference Evaluator for Alternating Images",
2020).
"""

import sys

import flip_evaluator
import numpy

file, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
for reference, test in numpy.fromfile(file, numpy.float32).reshape(-1, 2, height, width, 3):
    print(float(flip_evaluator.evaluate(reference, test, "LDR")[1]))
