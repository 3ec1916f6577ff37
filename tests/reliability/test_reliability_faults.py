"""A larger sample of tests/reliability/faults.py: every command at many places, and all special cases.

tests: host/whole_file.c
labels: long"""

import os
import subprocess
import sys

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability", "faults.py")
sys.exit(subprocess.run([sys.executable, "-B", SCRIPT, "--count", os.environ.get("FESTOON_FAULT_COUNT", "400")],
                        stdin=subprocess.DEVNULL).returncode)
