"""The lab's library in WebAssembly against the program, and the texts that the page reads: what needs node alone.

Environment: FESTOON the program, SOURCE_DIR, BUILD_DIR.  Status 77 where node is missing or `make lab` built no page.
"""

import os
import pathlib
import shutil
import subprocess
import sys

NODE = shutil.which("node") or shutil.which("nodejs")
BUILT = pathlib.Path(os.environ["BUILD_DIR"], "lab", "festoon.wasm")

if not NODE or not BUILT.exists():
    print("skipped: it needs node and the page of make lab")
    sys.exit(77)
sys.exit(subprocess.run([NODE, pathlib.Path(os.environ["SOURCE_DIR"], "lab", "tests", "node.mjs")], check=False).returncode)
