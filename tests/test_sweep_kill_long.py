"""A sweep killed at a hundred random moments has, once finished, the bits of one that was left alone."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
os.environ["FESTOON_KILLS"] = "34"  # databases, each killed three times

from test_sweep import Resuming  # noqa: E402,F401

if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "Resuming.test_sigkill_and_resume"])
