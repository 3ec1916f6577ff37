"""A sample of tests/reliability/whole.py: every command and format at 12 places, or FESTOON_PLACES.

tests: host/printed.c io/json_writer.c sweep/export.c cli/program.c cli/terminal.c
labels: long"""

import os
import subprocess
import sys

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability", "whole.py")
sys.exit(subprocess.run([sys.executable, "-B", SCRIPT, "--places", os.environ.get("FESTOON_PLACES", "12")], stdin=subprocess.DEVNULL).returncode)
