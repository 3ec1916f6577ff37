"""Memory that runs out: each call gives what it gives undisturbed, or raises a MemoryError."""

import os
import subprocess
import sys

import pytest

from conftest import BUILD

PRELOADED = BUILD / "tests" / "faults.so"

# Each place is tried in a process of its own, for numpy crashes at some, and then HDF5 works no more at others.
WALK = """
import ctypes, faulthandler, os
import numpy as np
import festoon as fs

arm = ctypes.CDLL(None).faults_arm
arm.argtypes, arm.restype = [ctypes.c_long], ctypes.c_long
bead = fs.Bead(run__periods=8, run__discard=4, run__samples=8)
points = {{"frequency [Hz]": [10.0, 11, 12], "mean_r [mm]": [16.4, 18.1, 19.1], "mean_r_error [mm]": [.1, .1, .1]}}
t = np.arange(200) / 100
track = np.column_stack([t, 20 * np.cos(20 * t), 20 * np.sin(20 * t)])

def state(number=0):
    arm(number)
    try:
        result = {call}
        spent = arm(0)
        return repr(({shown})), spent
    except MemoryError:
        return "no memory", arm(0)
    except RuntimeError as said:  # so Python says it of locks and threads
        assert str(said) in ("can't allocate lock", "can't allocate read lock"), said
        return "no memory", arm(0)

def alone(number):
    there, here = os.pipe()
    child = os.fork()
    if child == 0:
        os.dup2(here, 2)
        faulthandler.enable(2)
        told = state(number)[0]
        assert state()[0] == whole[0]  # and the next call is whole again
        os.write(here, told.encode())
        os._exit(0)
    os.close(here)
    with os.fdopen(there) as pipe:
        told = pipe.read()
    status = os.waitpid(child, 0)[1]
    if status == 0:
        return told
    frames = [line for line in told.splitlines() if line.startswith("  File")]
    assert "for thread-local data: ABORT" in told or "/numpy/" in frames[0], told  # glibc, of _cffi_backend; numpy
    return "no memory"

for again in range(4):  # what is made once, at the first call, is there then
    whole = state()
told = {{alone(number) for number in {{1 + whole[1] * i // {places} for i in range({places})}}}}
assert "no memory" in told and told <= {{whole[0], "no memory"}}, told - {{whole[0]}}
print("walked")
"""

CALLS = {
    "a bead": ("fs.Bead(frequency=9, friction__law='coulomb')", "result", 6),
    "a run": ("bead.run()", "result.mean_r, result.regime", 6),
    "a trajectory": ("bead.run(trajectory=True)", "result.trajectory.r.sum(), result.mean_r", 6),
    "a dictionary": ("bead.run().to_dict()", "result", 4),
    "a flow": ("bead.flow().advance(t=20.0)", "result[0], list(result[1])", 6),
    "a sweep": ("fs.sweep(bead, frequency=[9, 10, 11], threads=2)", "list(result.mean_r), list(result.regime), result.errors", 12),
    "an orbit": ("bead.orbit()", "result.mean_r, list(result.multipliers)", 4),
    "locked states": ("bead.locked()", "str(result)", 2),
    "a measurement": ("fs.measure(track)", "result.to_dict()", 8),
    "a fit": ("fs.fit(points, free='model.kappa', bead=bead)", "result.to_dict()", 4),
}


def walk(name, folder, times):
    """Lets allocations fail at so many times the places of CALLS."""
    if not PRELOADED.exists():
        pytest.skip("a build with sanitizers has nothing to preload")
    call, shown, places = CALLS[name]
    env = {**os.environ, "PYTHONPATH": str(BUILD / "python"), "LD_PRELOAD": str(PRELOADED),
           "FESTOON_FAULT": os.path.basename(sys.executable) + ":memory:0:0", "FESTOON_FAULT_UNDER": str(folder)}
    script = WALK.format(call=call, shown=shown, places=places * times)
    done = subprocess.run([sys.executable, "-B", "-c", script], env=env, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "walked\n"), done.stderr[-2000:]


@pytest.mark.parametrize("name", CALLS)
def test_some_places(name, tmp_path):
    walk(name, tmp_path, 1)
