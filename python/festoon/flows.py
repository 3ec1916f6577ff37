"""A trajectory that is advanced step by step."""

import contextlib
import threading
from typing import Any, Iterator, Tuple, Union

import numpy as np

from ._errors import BadInput
from ._given import of_class
from ._native import Watch, call, ffi, lib, options_of, places_of
from ._progress import Progress
from .bead import Bead

#: Why a flow stops, and the flag of each: "time", "section", "edge", "lift-off", "leave", "touch", "stick", "slip", "rest", "roll".
STOPS = {name: 1 << place for name, place in places_of(lib.pyf_stops).items()}
NAMES = {flag: name for name, flag in STOPS.items()}
EVENTS = [name for name in STOPS if name != "time"]


class Flow:
    """A trajectory from a state at t = 0 (that of start.*, unless given), in the turning frame.

    Parameters
    ----------
    bead
        Whose trajectory it is.
    state
        Ten numbers, scaled: X Y vX vY nX nY nZ WX WY WZ.
    progress
        True: a bar; or a function of (fraction, what), told of each advance().
    **options
        Of the integration: rtol and atol (one number or ten), first_step, greatest_step (1/gamma) and ramp (gamma^2).

    Raises
    ------
    BadInput
        Where the state or an option is wrong.
    RuntimeError
        Of every use while another thread uses it.

    Examples
    --------
    >>> flow = Bead().flow()
    >>> t, y = flow.advance(until="section")
    >>> flow.stop, abs(y[0]) < 1e-12
    ('section', True)
    """

    #: Why the last advance() returned: "time" or one of the events that it was to await; "" before the first.
    stop: str

    def __init__(self, bead: Bead, state: Any = None, *, progress: Progress = None, **options: Any) -> None:
        self.bead = of_class(bead, "Bead", "bead")
        self.stop = ""
        chosen = options_of(lib.fst_default_flow_options())
        for name, value in options.items():
            if name not in ("rtol", "atol", "first_step", "greatest_step", "ramp"):
                raise BadInput("flow", f'unknown option "{name}": rtol, atol, first_step, greatest_step, ramp')
            if name == "atol":
                value = list(np.broadcast_to(np.asarray(value, float), lib.FST_STATE_SIZE))
            setattr(chosen, name, value)
        start = bead.start_state() if state is None else np.asarray(state, float)
        if start.shape != (lib.FST_STATE_SIZE,):
            raise BadInput("flow", f"a state has {lib.FST_STATE_SIZE} numbers")
        self._watch = Watch(progress)  # its address is the flow's for good
        chosen.progress = self._watch.told
        made = ffi.new("fst_flow **")
        call(lib.fst_flow_new, bead._flat_model, chosen, ffi.new("double[]", list(start)), made)
        self._flow = ffi.gc(made[0], lib.fst_flow_free)
        self._lock, self._advances = threading.RLock(), False

    @contextlib.contextmanager
    def _held(self, advances: bool) -> Iterator[None]:
        """The flow for one thread and one advance(): another one would see numbers of two moments at once."""
        held = self._lock.acquire(blocking=False)
        try:
            if not held or (advances and self._advances):
                raise RuntimeError(
                    "this Flow is being advanced already: one thread at a time may use it; take a Flow of its own "
                    "for each, bead.flow(state)"
                )
            before, self._advances = self._advances, self._advances or advances
            try:
                yield
            finally:
                self._advances = before
        finally:
            if held:
                self._lock.release()

    def _info(self) -> Any:
        with self._held(advances=False):
            return lib.fst_flow_get(self._flow)

    def advance(
        self, t: Any = None, until: Union[None, str, Tuple[str, ...]] = None, turns: float = 100.0
    ) -> Tuple[float, Any]:
        """Go on to the time `t`, or to the first of the events `until`; returns (t, state).

        Events are "section" (Phi = pi/2 or -pi/2), "edge" (of the plate) and "lift-off" (the load reaches 0); under
        dry friction "stick" and "slip" (the contact begins to), "leave" and "touch" (of a bead that flies and comes
        down), and "rest" and "roll" on a plate that resists rolling.  Events do not disturb the trajectory; of
        several at one time each is told by a call of its own.  Without `t` an event is awaited for so many `turns`
        of the magnet; `stop` says whether it came.  After Ctrl-C the flow stands where it was last, and goes on
        with the same bits.

        Parameters
        ----------
        t
            The time to go to, 1/gamma.
        until
            An event, or a tuple of events.
        turns
            Of the magnet, after which an event is no longer awaited.

        Returns
        -------
        tuple
            The time, 1/gamma, and the state there, ten numbers.

        Raises
        ------
        BadInput
            Where an event is unknown, or neither a time nor an event is given.
        RuntimeError
            Where another call, or another thread, is advancing this flow.
        StepUnderflow, NotFinite
            Where the integration fails.
        Interrupted
            After Ctrl-C.
        """
        events = 0
        for name in (until,) if isinstance(until, str) else until or ():
            if name not in EVENTS:
                raise BadInput("flow.advance", f'unknown event "{name}": {", ".join(EVENTS)}')
            events |= STOPS[name]
        if t is None:
            if not events:
                raise BadInput("flow.advance", "say to which time t, or until which event")
            t = self.t + turns * 2 * np.pi / self.omega
        stop = ffi.new("fst_stop *")
        with self._held(advances=True):
            with self._watch as watch:
                watch.call(lib.fst_flow_next, self._flow, float(t), events, stop)
            self.stop = NAMES[int(stop[0])]
            info = lib.fst_flow_get(self._flow)
        return float(info.t), np.array(list(info.state))

    @property
    def t(self) -> float:
        """The time [1/gamma]."""
        return float(self._info().t)

    @property
    def state(self) -> Any:
        """X Y vX vY nX nY nZ WX WY WZ."""
        return np.array(list(self._info().state))

    @property
    def omega(self) -> float:
        """The drive now [gamma]."""
        return float(self._info().omega)

    @property
    def bead_angle(self) -> float:
        """Phi, unwrapped [rad]."""
        return float(self._info().bead_angle)

    @property
    def alpha(self) -> float:
        """The bead's polar angle in the laboratory, unwrapped [rad]."""
        return float(self._info().alpha)

    @property
    def drive_turns(self) -> float:
        """Turns of the magnet since t = 0 [1]."""
        return float(self._info().drive_turns)

    @property
    def sticks(self) -> bool:
        """Whether the contact rolls without slipping."""
        return bool(self._info().sticks)

    @property
    def flies(self) -> bool:
        """Whether the bead is in the air."""
        return bool(self._info().flies)

    @property
    def rests(self) -> bool:
        """Whether the bead does not roll, on a plate that resists it."""
        return bool(self._info().rests)

    @property
    def rhs_calls(self) -> int:
        """Evaluations of the equations of motion."""
        return int(self._info().rhs_calls)

    def __reduce__(self) -> Any:
        raise TypeError(
            "a Flow cannot be copied or pickled, for it stands within a step: keep its bead and its state, and go on "
            "with another one, bead.flow(state)"
        )

    def __repr__(self) -> str:
        try:
            info = self._info()
        except RuntimeError:
            return "Flow, which another thread advances"
        return f"Flow(t={info.t:.9g}, drive_turns={info.drive_turns:.6g}, stop={self.stop!r})"
