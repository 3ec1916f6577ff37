"""examples/period-halving.py: the critical exponents, and relaxation times from multipliers and from transients,
which agree.

tests: orbit/spectrum.c"""

import os
import re
import subprocess
import sys
import unittest

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "examples", "period-halving.py")


class PeriodHalving(unittest.TestCase):
    def test_exponents(self):
        said = subprocess.run([sys.executable, "-B", SCRIPT], capture_output=True, text=True, check=True, timeout=600).stdout

        def number(pattern):
            return float(re.search(pattern + r" (-?[0-9.]+)", said).group(1))

        self.assertIn("supercritical", said)
        self.assertAlmostEqual(number("halving at omega ="), 0.26885303399, 9)
        self.assertAlmostEqual(number("exponent of <n_z>"), 0.5, 2)
        self.assertAlmostEqual(number(r"of p/\(p \+ 2\)"), 0.5, 2)
        for side in ("below", "above"):
            self.assertAlmostEqual(number(f"exponent of the relaxation time {side}"), -1, 2)
        below, above = (float(a) for a in re.findall(r"time times distance ([0-9.]+)", said))
        self.assertAlmostEqual(above / below, 2, 2)  # the law of any supercritical pitchfork
        pairs = re.findall(r"by a transient ([0-9.]+), by the multiplier ([0-9.]+)", said)
        self.assertEqual(len(pairs), 2)
        for transient, multiplier in pairs:
            self.assertAlmostEqual(float(transient) / float(multiplier), 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
