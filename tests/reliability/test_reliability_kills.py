"""A sample of tests/reliability/kills.py: kills at all moments, of all kinds of sweeps.

Environment: FESTOON is the program, SOURCE_DIR the source tree; FESTOON_COUNT how many kills (60).

tests: sweep/checkpoints.c sweep/journal.c
labels: long"""

import os
import subprocess
import sys

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability", "kills.py")

if __name__ == "__main__":
    sys.exit(subprocess.run([sys.executable, "-B", SCRIPT, "--count", os.environ.get("FESTOON_COUNT", "60")],
                            check=False).returncode)
