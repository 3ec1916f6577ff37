"""Ctrl-C ends every call, and what was done is in the exception.

The work would take hours: a call that does not obey runs into the time limit of the test.  The signal is sent when
the call has told its progress for the first time.
"""

import os
import signal
import subprocess
import sys
import textwrap

import pytest

from conftest import BUILD

HEAD = """
import numpy as np
import festoon as fs

said = []

def tell(fraction, what):
    if not said:
        said.append(1)
        print("going", flush=True)

bead = fs.Bead(run__periods=1e8)
try:
    {call}
except fs.Interrupted as stopped:
    partial = stopped.partial
    assert isinstance(stopped, KeyboardInterrupt)
    {check}
    print("stopped", flush=True)
else:
    print("ended", flush=True)
"""

SHORT = "fs.sweep(bead.replace(run__periods=200), frequency=np.linspace(8, 20, 10**6), {more}progress=tell)"
CALLS = {
    "run": (
        "bead.run(trajectory=True, progress=tell)",
        "assert not partial.complete and len(partial.trajectory) > 0 and partial.trajectory.complete is False",
    ),
    "file": (
        "bead.run(trajectory='run.csv', progress=tell)",
        "assert not partial.complete and not fs.read('run.csv').complete",
    ),
    "sweep": (
        SHORT.format(more=""),
        "assert not partial.complete and not partial.failed.any() and np.isnan(partial.mean_r[~partial.done]).all()",
    ),
    "one-sweep": ("fs.sweep(bead, kappa=[1.5], progress=tell)", "assert not partial.done.any()"),
    "sweep-file": (
        SHORT.format(more="file='sweep.db', ").replace("10**6", "10**4"),
        "assert not partial.complete and fs.read('sweep.db').size == 10**4",
    ),
    "branch": (
        "bead.branch(omega=(1e-3, 50), kind='all', step=2e-5, progress=tell)",
        "assert not partial.complete",
    ),
    "flow": (
        "flow = bead.flow(progress=tell); flow.advance(t=1e9)",
        "assert 0 < flow.t < 1e9 and flow.stop == ''",
    ),
    "critical": ("bead.critical(over='drive.omega=0.1:0.5:1000', progress=tell)", "assert partial is None"),
    "lyapunov": ("bead.lyapunov(progress=tell)", "assert partial is None"),
}


@pytest.mark.parametrize("name", CALLS)
def test_interrupt(name, tmp_path):
    call, check = CALLS[name]
    code = textwrap.dedent(HEAD).format(call=call, check=check)
    child = subprocess.Popen(
        [sys.executable, "-B", "-c", code],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(BUILD / "python")},
        # A shell that starts tests in the background has them ignore the signal.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        assert child.stdout.readline() == "going\n"
        child.send_signal(signal.SIGINT)
        assert child.communicate()[0] == "stopped\n" and child.returncode == 0
    finally:
        child.kill()
        child.wait()
