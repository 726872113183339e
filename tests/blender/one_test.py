"""Runs one module of tests and ends before Python shuts down, when bpy may crash."""

import os
import sys
import unittest

if __name__ == "__main__":
    done = unittest.main(module=None, argv=["one_test.py", *sys.argv[1:]], exit=False, verbosity=2).result
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0 if done.wasSuccessful() and done.testsRun > 0 else 1)
