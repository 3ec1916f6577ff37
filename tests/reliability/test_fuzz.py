"""A sample of tests/reliability/fuzz.py: inputs that libFuzzer makes, for every reader, under the sanitizers.

Skipped where clang has no libFuzzer.  Environment: FESTOON_FUZZ_COUNT: how many inputs in all.

labels: long slow"""

import os
import subprocess
import sys
import tempfile

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability", "fuzz.py")
with tempfile.TemporaryDirectory(prefix="festoon-fuzz-") as folder:
    sys.exit(subprocess.run([sys.executable, "-B", SCRIPT, "--work", folder, "--count",
                             os.environ.get("FESTOON_FUZZ_COUNT", "300000")], stdin=subprocess.DEVNULL).returncode)
