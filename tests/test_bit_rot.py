"""A few of the bits that tests/reliability/rot.py turns over: none is exported as a result.

Environment: FESTOON is the program, SOURCE_DIR the source tree, BUILD_DIR the build tree.
"""

import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability"))

import rot  # noqa: E402


class Rot(unittest.TestCase):
    def test_a_handful(self):
        counts, wrong = rot.campaign(16, 5, 24)
        self.assertEqual(wrong, [])
        self.assertGreater(sum(entry["detected"] for entry in counts.values()), 0)


if __name__ == "__main__":
    unittest.main()
