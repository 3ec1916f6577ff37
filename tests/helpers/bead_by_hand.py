"""The bead's motion by hand: the paper's equations in the laboratory's frame, in plain Python, by the classical
Runge-Kutta method.  Nothing here comes from the program: neither its frame, nor its integrator, nor its means."""

import math

EPS, HEIGHT, SPACING, KAPPA = 2.5 / 23, 18.7 / 23, 40 / 92, 1.5
CHARGES = [(s, k * SPACING, s) for k in range(-2, 3) for s in (1, -1)]


def field(x, y, turn, height=HEIGHT, charges=CHARGES):
    """B and its gradient at (x, y) over the magnet turned by `turn`, in the laboratory."""
    c, s = math.cos(turn), math.sin(turn)
    b = [0.0, 0.0, 0.0]
    g = [[0.0, 0.0, 0.0] for _ in range(3)]
    for along, across, sign in charges:
        d = (x - along * c + across * s, y - along * s - across * c, height)
        square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
        cube = sign / (square * math.sqrt(square))
        for i in range(3):
            b[i] += cube * d[i]
            for j in range(3):
                g[i][j] += cube * ((i == j) - 3 * d[i] * d[j] / square)
    return b, g


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def rates(state, t, omega, printed):
    """d/dt of (x, y, vx, vy, n, W); `printed`: Eq. (7) as it is printed, without psi' n x n'."""
    x, y, vx, vy = state[:4]
    n, w = state[4:7], state[7:10]
    b, g = field(x, y, omega * t)
    slip = (vx - EPS * w[1], vy + EPS * w[0])
    pull = [sum(n[i] * g[i][j] for i in range(3)) for j in range(2)]
    turning, rubbing, dn = cross(n, b), (-slip[1], slip[0], 0.0), cross(w, n)
    dw = [2.5 * (KAPPA * turning[i] + rubbing[i] / EPS) for i in range(3)]
    if printed:  # Eq. (7) as printed lacks psi' n x n', which adds this to dW/dt
        spin, gyration = dot(w, n), cross(w, n)
        dw = [dw[i] + spin * gyration[i] for i in range(3)]
    return [vx, vy, KAPPA * EPS**2 * pull[0] - slip[0], KAPPA * EPS**2 * pull[1] - slip[1], *dn, *dw]


def step(state, t, h, omega, printed):
    def moved(k, part):
        return [a + part * h * b for a, b in zip(state, k)]
    k1 = rates(state, t, omega, printed)
    k2 = rates(moved(k1, 0.5), t + 0.5 * h, omega, printed)
    k3 = rates(moved(k2, 0.5), t + 0.5 * h, omega, printed)
    k4 = rates(moved(k3, 1.0), t + h, omega, printed)
    return [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(state, k1, k2, k3, k4)]


def wrapped(angle):
    return math.remainder(angle, 2 * math.pi)


def follow(state, omega, printed, duration, steps):
    """All states over `duration`, with their times and the unwrapped polar angle."""
    h, alpha = duration / steps, math.atan2(state[1], state[0])
    path = [(0.0, alpha, state)]
    for i in range(steps):
        state = step(state, i * h, h, omega, printed)
        alpha += wrapped(math.atan2(state[1], state[0]) - alpha)
        path.append(((i + 1) * h, alpha, state))
    return path


def one_return(turning_state, omega, printed, steps=1200):
    """Integrates from a state of the turning frame (the magnet along x) until the bead meets the magnet as before,
    once round. Returns what the motion is then, which on a closed orbit must agree with the program."""
    period = 2 * math.pi / (omega + 0.06)
    for _ in range(6):  # Newton's method on Phi finds the time of a whole return
        t, alpha, last = follow(turning_state, omega, printed, period, steps)[-1]
        met = alpha - omega * t - math.atan2(turning_state[1], turning_state[0]) + 2 * math.pi
        rate = (last[0] * last[3] - last[1] * last[2]) / (last[0]**2 + last[1]**2) - omega
        period -= met / rate
        if abs(met) < 1e-11:
            break
    path = follow(turning_state, omega, printed, period, steps)
    return Return(path, omega, period)


class Return:
    """Means over one return; on a closed orbit a plain mean over equal steps converges faster than any power of the
    step."""

    def __init__(self, path, omega, period):
        self.omega, self.period = omega, period
        values = [self.look(t, state) for t, _, state in path]
        mean = {key: sum(v[key] for v in values[:-1]) / (len(values) - 1) for key in values[0]}
        self.open = max(abs(values[0][key] - values[-1][key]) for key in ("r", "n_r", "n_z", "slip"))
        self.alpha_dot = (path[-1][1] - path[0][1]) / period
        self.mean = mean
        self.std_r = math.sqrt(mean["r2"] - mean["r"]**2)
        self.max_angle = max(v["angle"] for v in values)
        self.min_r, self.max_r = min(v["r"] for v in values), max(v["r"] for v in values)
        self.min_b, self.max_b = min(v["b"] for v in values), max(v["b"] for v in values)
        half = values[(len(values) - 1) // 2]
        self.s2 = abs(half["r"] - values[0]["r"]) < 1e-4 and abs(half["n_z"] + values[0]["n_z"]) < 1e-4
        self.festoons = (2 if self.s2 else 1) * (1 + omega / abs(self.alpha_dot))

    def look(self, t, state):
        x, y, vx, vy = state[:4]
        n, w, r = state[4:7], state[7:10], math.hypot(state[0], state[1])
        b, g = field(x, y, self.omega * t)
        e, size = (x / r, y / r), math.sqrt(dot(b, b))
        slip = (vx - EPS * w[1], vy + EPS * w[0])
        circling = (x * vy - y * vx) / r**2
        n_r, n_alpha = n[0] * e[0] + n[1] * e[1], n[1] * e[0] - n[0] * e[1]
        flat = math.hypot(n_alpha, n[2])  # Eq. (12) as printed leaves n_r out
        along = [g[i][0] * e[0] + g[i][1] * e[1] for i in range(3)]  # dB/dr
        printed = (n_alpha * (along[1] * e[0] - along[0] * e[1]) + n[2] * along[2]) / flat
        return {"r": r, "r2": r * r, "b": size, "n_z": n[2], "n_r": n_r,
                "slip": math.hypot(*slip), "power": dot(slip, slip),
                "angle": math.degrees(math.atan2(math.sqrt(dot(cross(n, b), cross(n, b))), dot(n, b))),
                "centrifugal": r * circling**2, "magnetic": KAPPA * EPS**2 * dot(n, along),
                "magnetic_printed": KAPPA * EPS**2 * printed,
                "friction": -(slip[0] * e[0] + slip[1] * e[1]),
                "v_alpha": slip[1] * e[0] - slip[0] * e[1]}
