"""What the Python module costs beside the program: `PYTHONPATH=build/python python3 bench/python_module.py`.

Processor times, medians of runs that take turns, so that a busy machine hits both alike:

- a sweep of 1024 runs of 200 periods, by festoon.sweep() and by `festoon sweep`;
- a call of the library from Python;
- 10^6 samples of a trajectory beside the same run without samples, and the memory that they take.
"""

import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import timeit

import festoon as fs
from festoon._native import ffi, lib

PROGRAM = pathlib.Path(fs.__file__).parents[2] / "festoon"
ROUNDS = int(sys.argv[1]) if len(sys.argv) > 1 else 5
AXES = {"drive.frequency": "8:20:64", "model.kappa": "1.2:1.8:16"}


def processor(who):
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def sweeps():
    bead, ours, theirs = fs.Bead(run__periods=200), [], []
    over = [word for key, text in AXES.items() for word in ("--over", f"{key}={text}")]
    for _ in range(ROUNDS):
        begin = processor(resource.RUSAGE_SELF)
        fs.sweep(bead, **AXES)
        ours.append(processor(resource.RUSAGE_SELF) - begin)
        with tempfile.TemporaryDirectory() as folder:
            begin = processor(resource.RUSAGE_CHILDREN)
            subprocess.run([PROGRAM, "sweep", "--set", "run.periods=200", *over, "-o", f"{folder}/sweep.db"],
                           check=True, capture_output=True)
            theirs.append(processor(resource.RUSAGE_CHILDREN) - begin)
    python, program = statistics.median(ours), statistics.median(theirs)
    print(f"sweep of 1024 x 200 periods: Python {python:.3f} s, program {program:.3f} s, ratio {python / program:.3f}")


def calls():
    bead = fs.Bead()
    b, grad = ffi.new("double[3]"), ffi.new("double[3][3]")
    for name, call in (
        ("fst_param_count()", lib.fst_param_count),
        ("fst_field(), with its work", lambda: lib.fst_field(bead._model, 0.1, 0.2, b, grad)),
        ("Bead.field() at a point", lambda: bead.field(0.1, 0.2)),
        ("Bead.replace()", lambda: bead.replace(kappa=1.2)),
    ):
        count = 20000
        seconds = statistics.median(timeit.repeat(call, number=count, repeat=ROUNDS))
        print(f"{name}: {1e6 * seconds / count:.2f} us")


def samples():
    bead = fs.Bead(run__periods=400, run__samples=2500)
    begin = processor(resource.RUSAGE_SELF)
    bead.run()
    alone = processor(resource.RUSAGE_SELF) - begin
    begin = processor(resource.RUSAGE_SELF)
    trajectory = bead.run(trajectory=True).trajectory
    both = processor(resource.RUSAGE_SELF) - begin
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{len(trajectory)} samples: {both:.3f} s, the run alone {alone:.3f} s; they are "
          f"{trajectory.nbytes / 2**20:.0f} MiB, the process never had more than {memory:.0f} MiB")


if __name__ == "__main__":
    samples()
    calls()
    sweeps()
