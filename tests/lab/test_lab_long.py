"""The page of the lab in Chromium without a head, opened from its file, at the sizes of a laptop and of a phone.

Status 77 where Chromium, node or what `make lab` leaves is missing.

labels: long slow"""

import os
import pathlib
import shutil
import subprocess
import sys

NODE = shutil.which("node") or shutil.which("nodejs")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
LAB = pathlib.Path(os.environ["SOURCE_DIR"], "lab")
PAGE = pathlib.Path(os.environ["BUILD_DIR"], "festoon-lab.html")

if not NODE or not CHROMIUM or not PAGE.exists() or not (LAB / "node_modules" / "puppeteer-core").exists():
    print("skipped: it needs Chromium, node and the page of make lab")
    sys.exit(77)
sys.exit(subprocess.run([NODE, LAB / "tests" / "browser.mjs"], env={**os.environ, "CHROMIUM": CHROMIUM}, check=False).returncode)
