"""The memory of a sweep of two hundred thousand points that goes on, and of its exports: ten times as many as in
test_sweep_memory.py.

tests: sweep/point_set.c sweep/rows.c sweep/export.c
labels: long"""

import os
import sys
import unittest

import test_sweep_memory


class AtLength(test_sweep_memory.GoingOn):
    MANY = 200000


if __name__ == "__main__":
    if not os.path.exists(os.path.join(os.environ["BUILD_DIR"], "tests", "far_away.so")):
        print("skipped: sanitizers keep what is freed")
        sys.exit(77)
    unittest.main()
