"""The scripts of the lab's page, with the program; and, where `make lab` has made them, its library in WebAssembly
against the program, and the page.  Status 77 where node is missing.

labels: numbers"""

import os
import pathlib
import shutil
import subprocess
import sys

NODE = shutil.which("node") or shutil.which("nodejs")

if not NODE:
    print("skipped: it needs node")
    sys.exit(77)
sys.exit(subprocess.run([NODE, pathlib.Path(os.environ["SOURCE_DIR"], "lab", "tests", "node.mjs")], check=False).returncode)
