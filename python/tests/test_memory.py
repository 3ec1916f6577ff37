"""Memory that runs out: each call gives what it gives undisturbed, or raises a MemoryError."""

import os
import subprocess
import sys

import pytest

from conftest import BUILD

PRELOADED = BUILD / "tests" / "faults.so"

WALK = """
import ctypes
import festoon as fs

arm = ctypes.CDLL(None).faults_arm
arm.argtypes, arm.restype = [ctypes.c_long], ctypes.c_long
bead = fs.Bead(run__periods=8, run__discard=4, run__samples=8)

def state(number=0):
    arm(number)
    try:
        result = {call}
        spent = arm(0)
        return repr(({shown})), spent
    except MemoryError:
        return "no memory", arm(0)
    except RuntimeError as said:  # so Python says it of locks and threads
        assert str(said) in ("can't allocate lock", "can't start new thread"), said
        return "no memory", arm(0)

whole = state()
for again in range(3):  # what is made once, at the first call, is there then
    whole = state()
places = sorted({{1 + whole[1] * i // 40 for i in range(40)}})
told = [state(number)[0] for number in places]
assert "no memory" in told, whole
assert set(told) <= {{whole[0], "no memory"}}, set(told) - {{whole[0]}}
assert state()[0] == whole[0]
print("walked")
"""

CALLS = {
    "run": ("bead.run()", "result.mean_r, result.regime"),
    "trajectory": ("bead.run(trajectory=True)", "result.trajectory.r.sum(), result.mean_r"),
    "locked": ("bead.locked()", "str(result)"),
}


@pytest.mark.skipif(not PRELOADED.exists(), reason="a build with sanitizers has nothing to preload")
@pytest.mark.parametrize("name", CALLS)
def test_every_place(name, tmp_path):
    call, shown = CALLS[name]
    env = {**os.environ, "PYTHONPATH": str(BUILD / "python"), "LD_PRELOAD": str(PRELOADED),
           "FESTOON_FAULT": os.path.basename(sys.executable) + ":memory:0:0", "FESTOON_FAULT_UNDER": str(tmp_path)}
    done = subprocess.run([sys.executable, "-B", "-c", WALK.format(call=call, shown=shown)], env=env, capture_output=True,
                          text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "walked\n"), done.stderr[-2000:]
