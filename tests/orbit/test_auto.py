#!/usr/bin/env python3
"""AUTO-07p (Doedel et al.) finds the same branches and special points from equations that are written here
independently.

AUTO gets the ten equations in Fortran, by collocation over the full turn of Phi, and one orbit to begin with; it knows
nothing of the symmetry.  |n| = 1 is made attracting, which leaves the motion on the sphere as it is.  Skipped with a
word where AUTO-07p or gfortran is not installed.

tests: orbit/branch.c orbit/tracer.c
labels: numbers"""
import glob
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time

FESTOON = os.environ["FESTOON"]
AUTO = os.environ.get("AUTO_DIR", "/usr/lib/auto-07p")
EPS, H, LAMBDA, KAPPA = 2.5 / 23, 18.7 / 23, 40 / 92, 1.5

EQUATIONS = f"""
subroutine func(ndim,u,icp,par,ijac,f,dfdu,dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim,*), dfdp(ndim,*)
  double precision, parameter :: eps={EPS!r}d0, h={H!r}d0, lam={LAMBDA!r}d0, kappa={KAPPA!r}d0
  double precision :: w, b(3), g(3,3), d(3), r, s, n(3), v(2), om(3), force(2), slip(2)
  integer :: k, i, j, e
  w = par(1)
  n = u(5:7)
  v = u(3:4)
  om = u(8:10)
  b = 0
  g = 0
  do k = -2, 2
     do e = -1, 1, 2
        s = dble(e)
        d = (/ u(1)-s, u(2)-k*lam, h /)
        r = sqrt(sum(d*d))
        b = b + s*d/r**3
        do i = 1, 3
           g(i,i) = g(i,i) + s/r**3
           do j = 1, 3
              g(i,j) = g(i,j) - 3*s*d(i)*d(j)/r**5
           end do
        end do
     end do
  end do
  do i = 1, 2
     force(i) = kappa*eps**2*sum(g(i,:)*n)
  end do
  slip = (/ v(1)-eps*om(2), v(2)+eps*om(1) /)
  f(1) = v(1)+w*u(2)
  f(2) = v(2)-w*u(1)
  f(3) = force(1)-slip(1)+w*v(2)
  f(4) = force(2)-slip(2)-w*v(1)
  f(5) = om(2)*n(3)-(om(3)-w)*n(2)
  f(6) = (om(3)-w)*n(1)-om(1)*n(3)
  f(7) = om(1)*n(2)-om(2)*n(1)
  f(5:7) = f(5:7) - 0.5d0*(sum(n*n)-1)*n
  f(8) = 2.5d0*(kappa*(n(2)*b(3)-n(3)*b(2))-slip(2)/eps)+w*om(2)
  f(9) = 2.5d0*(kappa*(n(3)*b(1)-n(1)*b(3))+slip(1)/eps)-w*om(1)
  f(10) = 2.5d0*kappa*(n(1)*b(2)-n(2)*b(1))
end subroutine func
subroutine stpnt(ndim,u,par,t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  par(1) = START
end subroutine stpnt
subroutine bcnd
end subroutine bcnd
subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt
subroutine pvls
end subroutine pvls
"""

CONSTANTS = """
dat='{dat}'
NDIM=10, IPS=2, IRS={irs}, ILP=1
ICP=[1, 11]
NTST=100, NCOL=4, IAD=3, ISP=2, ISW={isw}, IPLT=0, NBC=0, NINT=0
NMX={nmx}, NPR=100000, MXBF=0, IID=0, ITMX=9, ITNW=7, NWTN=3, JAC=0
EPSL=1e-8, EPSU=1e-8, EPSS=1e-6
DS={ds}, DSMIN=1e-6, DSMAX={dsmax}, IADS=1
THL={{11: 0.0}}
UZR={{1: {uzr}}}
UZSTOP={{1: {stop}}}
SP={sp}
"""


def festoon(*words):
    done = subprocess.run([FESTOON, *words, "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def rhs(y, w):
    """The equations in Python, from which AUTO gets an orbit to start from."""
    x, yy, vx, vy, n, om = y[0], y[1], y[2], y[3], y[4:7], y[7:10]
    b, g = [0.0] * 3, [[0.0] * 3 for _ in range(3)]
    for k in range(-2, 3):
        for s in (-1.0, 1.0):
            d = (x - s, yy - k * LAMBDA, H)
            r = math.sqrt(sum(c * c for c in d))
            for i in range(3):
                b[i] += s * d[i] / r**3
                g[i][i] += s / r**3
                for j in range(3):
                    g[i][j] -= 3 * s * d[i] * d[j] / r**5
    force = [KAPPA * EPS**2 * sum(g[i][j] * n[j] for j in range(3)) for i in range(2)]
    slip = (vx - EPS * om[1], vy + EPS * om[0])
    wz = om[2] - w
    return [
        vx + w * yy, vy - w * x, force[0] - slip[0] + w * vy, force[1] - slip[1] - w * vx,
        om[1] * n[2] - wz * n[1], wz * n[0] - om[0] * n[2], om[0] * n[1] - om[1] * n[0],
        2.5 * (KAPPA * (n[1] * b[2] - n[2] * b[1]) - slip[1] / EPS) + w * om[1],
        2.5 * (KAPPA * (n[2] * b[0] - n[0] * b[2]) + slip[0] / EPS) - w * om[0],
        2.5 * KAPPA * (n[0] * b[1] - n[1] * b[0]),
    ]


def sampled_orbit(state, period, w, pieces=400):
    rows, y, h = [], list(state), period / pieces
    for i in range(pieces + 1):
        rows.append((i * h, list(y)))
        k1 = rhs(y, w)
        k2 = rhs([a + 0.5 * h * b for a, b in zip(y, k1)], w)
        k3 = rhs([a + 0.5 * h * b for a, b in zip(y, k2)], w)
        k4 = rhs([a + h * b for a, b in zip(y, k3)], w)
        y = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(y, k1, k2, k3, k4)]
    return rows


def run_auto(directory, **constants):
    """Runs the built AUTO program; returns the rows of its bifurcation diagram: (type, label, omega, period)."""
    for name in ("fort.7", "fort.8", "fort.9"):
        if os.path.exists(os.path.join(directory, name)):
            os.remove(os.path.join(directory, name))
    began = time.monotonic()
    done = subprocess.run([os.path.join(directory, "bead.exe")], cwd=directory, input=CONSTANTS.format(**constants),
                          capture_output=True, text=True, timeout=1000,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})
    took = time.monotonic() - began
    rows = []
    with open(os.path.join(directory, "fort.7"), encoding="ascii") as table:
        for line in table:
            words = line.split()
            if len(words) > 6 and words[0] not in ("0", "PT") and words[0].lstrip("-").isdigit():
                rows.append((int(words[2]) % 10 if int(words[2]) >= 0 else -(-int(words[2]) % 10), int(words[3]),
                             float(words[4]), float(words[-1])))
    if not rows:
        raise SystemExit("AUTO gave no points:\n" + done.stdout[-2000:] + done.stderr[-2000:])
    return rows, took


def check(name, ours, its, digits=1e-6):
    off = abs(ours / its - 1)
    print(f"  {name}: festoon {ours:.12g}, AUTO {its:.12g}, relative difference {off:.2g}")
    if not off < digits:
        raise SystemExit(f"{name} differs by {off:.2g}")


def check_period(name, rows, omega):
    """Compared at the omega that AUTO reports, which is near the one asked for."""
    omega, period = next((r[2], r[3]) for r in rows if r[0] == -4 and abs(r[2] - omega) < 1e-4)
    check(name, festoon("orbit", "--set", f"drive.omega={omega}")["period"], period)


def special(kind, near, specials):
    return min((s["value"] for s in specials if s["type"] == kind), key=lambda v: abs(v - near))


def main():
    if not os.path.isdir(os.path.join(AUTO, "lib")) or not shutil.which("gfortran"):
        print("skipped: AUTO-07p or gfortran is not installed (Debian: auto-07p)")
        return 77
    start = festoon("orbit", "--set", "drive.omega=0.352")
    began = time.monotonic()
    branch = festoon("branch", "--kind", "counter", "--over", "drive.omega=0.2:3.6")
    ours = time.monotonic() - began
    with tempfile.TemporaryDirectory() as directory:
        with open(os.path.join(directory, "bead.f90"), "w", encoding="ascii") as source:
            source.write(EQUATIONS.replace("START", "0.352d0"))
        with open(os.path.join(directory, "bead.dat"), "w", encoding="ascii") as data:
            for t, y in sampled_orbit(start["state"], start["period"], 0.352):
                data.write(" ".join(f"{v:.17g}" for v in (t, *y)) + "\n")
        subprocess.run(["gfortran", "-O2", "-fopenmp", "-std=legacy", "bead.f90", "-o", "bead.exe",
                        *glob.glob(os.path.join(AUTO, "lib", "*.o"))], cwd=directory, check=True,
                       capture_output=True)
        down, took_down = run_auto(directory, dat="bead", irs=0, isw=1, nmx=300, ds=-0.002, dsmax=0.01, uzr="[0.3]",
                                   stop="[0.262]", sp="[]")
        shutil.copy(os.path.join(directory, "fort.8"), os.path.join(directory, "fort.3"))
        fork = [r for r in down if r[0] == 6]
        if not fork:
            raise SystemExit(f"AUTO labelled no branch point: {down}")
        check("pitchfork", special("pitchfork", 0.2688, branch["specials"]), fork[0][2])
        check_period("period on the S2 branch", down, 0.3)
        aside, took_aside = run_auto(directory, dat="", irs=fork[0][1], isw=-1, nmx=200, ds=0.002, dsmax=0.1,
                                     uzr="[0.25]", stop="[0.24, 0.3]", sp="[]")
        check_period("period on the S1 branch", aside, 0.25)
        up, took_up = run_auto(directory, dat="bead", irs=0, isw=1, nmx=400, ds=0.002, dsmax=0.2, uzr="[1.0]",
                               stop="[3.6]", sp="['LP1']")
        fold = [r for r in up if r[0] == 5 and abs(r[2] - 3.3895) < 0.01]
        if not fold:
            raise SystemExit(f"AUTO labelled no fold: {[r for r in up if r[0]]}")
        check("upper fold", special("fold", 3.3895, branch["specials"]), fold[0][2])
        its = took_down + took_aside + took_up
        print(f"  time, both branches: festoon {ours:.2f} s, {len(branch['points'])} points from the scene's start;"
              f" AUTO {its:.2f} s, {len(down)} + {len(aside)} + {len(up)} points from a given orbit,"
              f" {its / ours:.0f} times as long")
    return 0


if __name__ == "__main__":
    sys.exit(main())
