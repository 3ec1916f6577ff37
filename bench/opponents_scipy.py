"""SciPy's DOP853 on a few of the job's trajectories, with the same compiled right-hand side, called through ctypes.

    opponents_scipy.py LIBRARY REFERENCE.csv WORK-PRECISION.csv

Appends lines "solver,tolerance,error,ms" to the last file.
"""

import csv
import ctypes
import sys
import time

import numpy
from scipy.integrate import solve_ivp

NAME, TOLERANCES, POINTS = "SciPy DOP853", (1e-4, 1e-6, 1e-8, 1e-10, 1e-12), 2


def main():
    job = ctypes.CDLL(sys.argv[1])
    pointer = ctypes.c_void_p
    job.job_trajectory_new.restype = pointer
    job.job_trajectory_new.argtypes = ctypes.c_int, ctypes.c_int
    job.job_end_time.restype = ctypes.c_double
    job.job_end_time.argtypes = (pointer,)
    job.job_start.argtypes = pointer, pointer
    job.job_rhs.argtypes = pointer, pointer, pointer
    with open(sys.argv[2], encoding="ascii") as file:
        references = [row for row in csv.reader(file)][1:]
    # Of the references, which lie along the whole range, those a quarter and three quarters on the way.
    chosen = [references[len(references) // 4], references[3 * len(references) // 4]][:POINTS]
    for tolerance in TOLERANCES:
        worst, begin = 0.0, time.process_time()
        for index, count, *end in chosen:
            trajectory = job.job_trajectory_new(int(index), int(count))
            start = numpy.empty(10)
            job.job_start(trajectory, start.ctypes.data)

            def rhs(_, state):
                derivative = numpy.empty(10)
                job.job_rhs(trajectory, state.ctypes.data, derivative.ctypes.data)
                return derivative

            solution = solve_ivp(rhs, (0.0, job.job_end_time(trajectory)), start, method="DOP853", rtol=tolerance,
                                 atol=tolerance, t_eval=[job.job_end_time(trajectory)])
            worst = max(worst, numpy.abs(solution.y[:, -1] - numpy.array(end, dtype=float)).max())
        ms = 1e3 * (time.process_time() - begin) / len(chosen)
        print(f"{NAME:<34} {tolerance:9.1e} {worst:9.1e} {ms:9.3f}  ({len(chosen)} trajectories)", flush=True)
        with open(sys.argv[3], "a", encoding="ascii") as file:
            file.write(f"{NAME},{tolerance:.1e},{worst:.3e},{ms:.4f}\n")


main()
