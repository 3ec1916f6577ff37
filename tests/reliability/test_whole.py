"""A sample of tests/reliability/whole.py: 60 allocations over all commands, and a write and a read of each
(test_whole_long.py: each command at 12 places).

tests: host/printed.c io/json_writer.c sweep/export.c cli/program.c cli/terminal.c
labels: slow"""

import os
import subprocess
import sys

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability", "whole.py")
sys.exit(subprocess.run([sys.executable, "-B", SCRIPT, "--few", "60"], stdin=subprocess.DEVNULL).returncode)
