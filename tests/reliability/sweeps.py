"""What the campaigns on sweeps share: running the program, a sweep stopped at work.

Environment: FESTOON is the program, SOURCE_DIR the source tree, BUILD_DIR the build tree.
"""

import os
import signal
import sqlite3
import subprocess
import sys
import time

FESTOON = os.environ["FESTOON"]
SHORT = ["--set", "run.periods=8", "--set", "run.discard=4", "--set", "run.rtol=1e-8"]


def festoon(*words, **options):
    done = subprocess.run([FESTOON, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          timeout=1200, **options)
    return done.returncode, done.stdout.decode(), done.stderr.decode(errors="replace")


def good(*words, **options):
    status, out, err = festoon(*words, **options)
    if status != 0:
        sys.exit(f"festoon {' '.join(words)}: status {status}: {err}")
    return out


def words_of(points):
    """The arguments of a sweep of this many short runs."""
    return ["sweep", *SHORT, "--over", f"drive.frequency=9Hz:20Hz:{points}", "--threads", "2", "-o"]


def rows_in(path):
    if not os.path.exists(path):
        return 0
    base = sqlite3.connect(path, timeout=60)
    try:
        return base.execute("SELECT count(*) FROM rows").fetchone()[0]
    finally:
        base.close()


def stopped_at_work(points, path, rows=1):
    """Starts a sweep and stops it by SIGSTOP when it has committed this many rows, and not all; returns it and its
    number of points, which is raised until the program is still at work when it is stopped."""
    while points < 2000000:
        process = subprocess.Popen([FESTOON, *words_of(points), path], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None:
            if rows_in(path) >= rows:
                os.kill(process.pid, signal.SIGSTOP)  # send_signal() would reap a program that is over
                os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
                if process.poll() is None and rows_in(path) < points:
                    return process, points
                process.send_signal(signal.SIGCONT)
                break
            time.sleep(0.005)
        process.wait()
        for ending in ("", "-wal", "-shm"):
            if os.path.exists(path + ending):
                os.remove(path + ending)
        points *= 4
    sys.exit("no sweep was slow enough to be stopped at work")
