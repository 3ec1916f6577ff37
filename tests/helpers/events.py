"""What tests of kills and signals share: they wait for events, never for a time.

A program that is to be struck while it works has to work long enough, on a quick processor too, and not all day on a
slow one: so work is sized by measuring it (sized()), a blow follows an event (a committed row, an image of a run, a
file, a line of progress), and whether it struck is read from the status of the program.  One that was over before is
tried again with more work (struck()), and if that never helps the test is skipped with the words "not killed".
Limits of time only end what hangs.

Environment: FESTOON_SHORTER (1) is what times of work are divided by; tests must pass, or say that they skip, with any.
"""

import fcntl
import os
import pty
import resource
import select
import signal
import sqlite3
import subprocess
import termios
import time
import unittest

HANG = 3000  # seconds after which a program is taken to hang
POLL = 0.002


def sized(run, seconds, size, most=10**7):
    """The least of size, 3 size, 9 size, ... for which run(size) takes at least that long."""
    shorter = float(os.environ.get("FESTOON_SHORTER", "1"))
    seconds, size = seconds / shorter, max(min(size, 10), int(size / shorter))
    while True:
        began = time.monotonic()
        run(size)
        took = time.monotonic() - began
        if took >= seconds or size >= most:
            return size
        size *= 3 if took > seconds / 9 else 9


def ask(path, question):
    """The answer of a database that may be in use, damaged or absent; None if there is none. Nothing is written: the
    log of a killed program must stay for the program that goes on."""
    if not os.path.exists(path):
        return None
    try:
        base = sqlite3.connect(f"file:{path}?mode=ro", uri=True, timeout=1.0)
    except sqlite3.Error:
        return None
    try:
        return base.execute(question).fetchone()[0]
    except (sqlite3.Error, TypeError):
        return None
    finally:
        base.close()


def rows(path):
    """Number of committed rows of a sweep's database, 0 where there is none yet."""
    return ask(path, "SELECT count(*) FROM rows") or 0


def images(path):
    """Tells whether images of runs in flight were saved: a number that changes with them, 0 if there are none."""
    return ask(path, "SELECT sum((point + 1) * (checksum % 1000003 + 2000003)) FROM checkpoints") or 0


def wait_for(process, happened):
    """Waits until something has happened or the program is over; returns whether it happened first."""
    limit = time.monotonic() + HANG
    while not happened():
        if process.poll() is not None or time.monotonic() > limit:
            return False
        time.sleep(POLL)
    return True


def start(words, **options):
    for name in ("stdout", "stderr"):
        options.setdefault(name, subprocess.DEVNULL)
    return subprocess.Popen(words, stdin=subprocess.DEVNULL, **options)


def kill_when(words, happened, **options):
    """Starts a program and kills it as soon as something has happened; returns whether it was killed at work."""
    process = start(words, **options)
    wait_for(process, happened)
    process.kill()
    process.communicate()
    return process.returncode == -signal.SIGKILL


def signal_when(words, happened, number, **options):
    """The same with a signal that the program may answer: status, output, messages. The signal is repeated every
    second only because the program may miss the first one while it starts; after main() it must not need another."""
    process = start(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
    wait_for(process, happened)
    if process.poll() is None:
        process.send_signal(number)
    out, messages = process.communicate(timeout=HANG)
    return process.returncode, out, messages


def struck(blow, size, tries=6, factor=4):
    """blow(size) strikes and returns whether it struck; if not, it is tried again with more work."""
    for _ in range(tries):
        if blow(size):
            return size
        size *= factor
    raise unittest.SkipTest("not killed: the program was over before, however much it had to do")


def listens(process):
    """Whether a program catches SIGINT, and so has begun its work (Linux tells in /proc)."""
    try:
        with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
            caught = next(line.split()[1] for line in file if line.startswith("SigCgt"))
    except (OSError, StopIteration):
        return False
    return bool(int(caught, 16) >> (signal.SIGINT - 1) & 1)


def is_over(number):
    """Whether a process has ended, also where nobody has asked for its status yet (a zombie)."""
    try:
        with open(f"/proc/{number}/stat", encoding="ascii") as file:
            return file.read().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def children_of(process):
    """The process numbers of a program's children that are at work, as mpirun's ranks. process.had_children
    says whether there ever were any (Linux tells in /proc)."""
    try:
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
            found = [int(word) for word in file.read().split()]
    except OSError:
        return []
    process.had_children = getattr(process, "had_children", False) or bool(found)
    return [number for number in found if not is_over(number)]


def lost_its_children(process):
    """Whether a program had children and none is at work any more: an mpirun whose ranks were killed sometimes hangs
    then, before or after it has asked how they ended."""
    return not children_of(process) and getattr(process, "had_children", False)


def seems_noted(process, number):
    """Whether a signal that was sent is no longer pending."""
    try:
        with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
            pending = [int(line.split()[1], 16) for line in file if line.startswith(("SigPnd", "ShdPnd"))]
    except OSError:
        return True
    return not any(mask >> (number - 1) & 1 for mask in pending)


def children_time():
    """The processor time of the processes that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def on_a_terminal(words, until, number=signal.SIGINT, as_key=False, used=None):
    """Runs a program whose messages go to a terminal, and strikes when `until` holds for the text there; returns
    status, output and text. `as_key` strikes by Ctrl-C at the terminal, which reaches the whole group. The
    processor time from the strike on is added to the list `used`."""
    before, at_signal = children_time(), 0.0
    leader, follower = pty.openpty()
    own_terminal = (lambda: fcntl.ioctl(follower, termios.TIOCSCTTY, 0)) if as_key else None  # else no key is a signal
    process = subprocess.Popen(words, stdin=follower if as_key else subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=follower, start_new_session=as_key, preexec_fn=own_terminal)
    os.close(follower)
    shown, sent = "", False
    while True:
        if select.select([leader], [], [], 0.02)[0]:
            try:
                more = os.read(leader, 4096)
            except OSError:  # the other end is closed
                break
            if not more:
                break
            shown += more.decode(errors="replace")
        elif process.poll() is not None:
            break
        if not sent and until(shown):
            sent = True
            at_signal = time.clock_gettime((~process.pid << 3) | 2)  # the processor time of that process, Linux
            if as_key:
                os.write(leader, b"\x03")
            else:
                process.send_signal(number)
    out = process.stdout.read()
    process.stdout.close()
    process.wait()
    os.close(leader)
    if used is not None:
        used.append(children_time() - before - at_signal)
    return process.returncode, out, shown
