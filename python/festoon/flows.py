"""A trajectory that is advanced step by step."""

from typing import Any, Tuple, Union

import numpy as np

from ._errors import BadInput
from ._native import Watch, call, ffi, lib, options_of
from ._progress import Progress
from .bead import Bead

STOPS = {
    "time": lib.FST_STOP_TIME,
    "section": lib.FST_STOP_SECTION,
    "edge": lib.FST_STOP_EDGE,
    "lift-off": lib.FST_STOP_LIFT_OFF,
}
CONTROLLERS = {"plain": lib.FST_CONTROLLER_PLAIN, "damped": lib.FST_CONTROLLER_DAMPED}
NAMES = {number: name for name, number in STOPS.items()}


class Flow:
    """A trajectory from a state at t = 0 (that of start.*, unless given), in the turning frame.

    Options are those of the integration: rtol and atol (one number or ten), first_step, greatest_step, ramp,
    and controller, "plain" or "damped" (run.controller);
    `progress` is told of each advance().

    >>> flow = Bead().flow()
    >>> t, y = flow.advance(until="section")
    >>> flow.stop, abs(y[0]) < 1e-12
    ('section', True)
    """

    #: Why the last advance() returned: time, section, edge or lift-off; "" before the first.
    stop: str

    def __init__(self, bead: Bead, state: Any = None, *, progress: Progress = None, **options: Any) -> None:
        self.bead = bead
        self.stop = ""
        chosen = options_of(lib.fst_default_flow_options())
        for name, value in options.items():
            if name not in ("rtol", "atol", "first_step", "greatest_step", "ramp", "controller"):
                raise BadInput(
                    "flow", f'unknown option "{name}": rtol, atol, first_step, greatest_step, ramp, controller'
                )
            if name == "controller":
                if value not in CONTROLLERS:
                    raise BadInput("flow", f'unknown controller "{value}": plain or damped')
                value = CONTROLLERS[value]
            if name == "atol":
                value = list(np.broadcast_to(np.asarray(value, float), lib.FST_STATE_SIZE))
            setattr(chosen, name, value)
        start = bead.start_state() if state is None else np.asarray(state, float)
        if start.shape != (lib.FST_STATE_SIZE,):
            raise BadInput("flow", f"a state has {lib.FST_STATE_SIZE} numbers")
        self._watch = Watch(progress)  # its address is the flow's for good
        chosen.progress = self._watch.told
        made = ffi.new("fst_flow **")
        call(lib.fst_flow_new, bead._model, chosen, ffi.new("double[]", list(start)), made)
        self._flow = ffi.gc(made[0], lib.fst_flow_free)

    def advance(
        self, t: Any = None, until: Union[None, str, Tuple[str, ...]] = None, turns: float = 100.0
    ) -> Tuple[float, Any]:
        """Go on to the time `t`, or to the first of the events `until`; returns (t, state).

        Events are "section" (Phi = pi/2 or -pi/2), "edge" (of the plate) and "lift-off".  Without `t` an event
        is awaited for so many `turns` of the magnet; `stop` says whether it came.  After Ctrl-C the flow stands
        where it was last, and goes on with the same bits.
        """
        events = 0
        for name in (until,) if isinstance(until, str) else until or ():
            if name not in STOPS or name == "time":
                raise BadInput("flow.advance", f'unknown event "{name}": section, edge or lift-off')
            events |= 1 << STOPS[name]
        if t is None:
            if not events:
                raise BadInput("flow.advance", "say to which time t, or until which event")
            t = self.t + turns * 2 * np.pi / self.omega
        stop = ffi.new("fst_stop *")
        with self._watch as watch:
            watch.call(lib.fst_flow_advance, self._flow, float(t), events, stop)
        self.stop = NAMES[int(stop[0])]
        info = lib.fst_flow_get(self._flow)
        return float(info.t), np.array(list(info.state))

    @property
    def t(self) -> float:
        """The time, 1/gamma."""
        return float(lib.fst_flow_get(self._flow).t)

    @property
    def state(self) -> Any:
        """X Y vX vY nX nY nZ WX WY WZ."""
        return np.array(list(lib.fst_flow_get(self._flow).state))

    @property
    def omega(self) -> float:
        """The drive now."""
        return float(lib.fst_flow_get(self._flow).omega)

    @property
    def bead_angle(self) -> float:
        """Phi, unwrapped."""
        return float(lib.fst_flow_get(self._flow).bead_angle)

    @property
    def alpha(self) -> float:
        """The bead's polar angle in the laboratory, unwrapped."""
        return float(lib.fst_flow_get(self._flow).alpha)

    @property
    def drive_turns(self) -> float:
        """Turns of the magnet since t = 0."""
        return float(lib.fst_flow_get(self._flow).drive_turns)

    @property
    def rhs_calls(self) -> int:
        """Evaluations of the equations of motion."""
        return int(lib.fst_flow_get(self._flow).rhs_calls)

    def __reduce__(self) -> Any:
        raise TypeError(
            "a Flow cannot be copied or pickled, for it stands within a step: keep its bead and its state, and go on "
            "with another one, bead.flow(state)"
        )

    def __repr__(self) -> str:
        return f"Flow(t={self.t:.9g}, drive_turns={self.drive_turns:.6g}, stop={self.stop!r})"
