"""One bead in a world in which it needs three dimensions."""

from typing import TYPE_CHECKING, Any, Mapping, Optional, Union

from ._errors import BadInput
from ._native import lib, text_of
from ._progress import Progress
from .bead import Bead, Path

if TYPE_CHECKING:
    from .beads_runs import WorldRun


class World(Bead):
    """One bead in three dimensions: in a bowl, in a fluid, without a plate, or in fields that do not turn with the magnet.

    Parameters are those of :class:`Bead`, one of which must ask for three dimensions; `cause` names it.

    >>> bowl = World(plate__shape="bowl", plate__bowl_radius="200 mm", frequency="10.7 Hz", run__periods=10)
    >>> bowl.cause, bowl.run().regime
    ('plate.shape', 'undecided')
    """

    def _set(self, keywords: Mapping[str, Any]) -> None:
        super()._set(keywords)
        if not lib.fst_key_of_world(self._params):
            raise BadInput(
                "World",
                "a flat plate in air under a magnet that turns steadily needs no third dimension: Bead() is for it; "
                'a world has, for instance, plate__shape="bowl" or medium__viscosity',
            )

    @property
    def cause(self) -> str:
        """The key that asks for three dimensions."""
        return text_of(lib.fst_key_of_world(self._params))

    def run(  # type: ignore[override]
        self,
        *,
        periods: Optional[float] = None,
        discard: Optional[float] = None,
        trajectory: Union[bool, Path] = False,
        fps: Optional[float] = None,
        start: Any = None,
        progress: Progress = None,
    ) -> "WorldRun":
        """Simulate the bead and describe its motion: a :class:`WorldRun`.

        Parameters
        ----------
        periods, discard
            Length in drive periods, and how many of them are left out of the means.
        trajectory
            True: the result has a `trajectory`; a path (.h5 or .csv): the samples go into that file.
        fps
            Samples a second, as a camera takes them, instead of run.samples in a drive period.
        start
            Twelve numbers instead of start.*, scaled.
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        WorldRun
            Its numbers are scaled, those of `festoon run --json`.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        StepUnderflow, NotFinite
            Where the integration fails; the sentence says when and where.
        Interrupted
            After Ctrl-C; `partial` is the trajectory until then, or None.
        """
        return super().run(  # type: ignore[return-value]
            periods=periods, discard=discard, trajectory=trajectory, fps=fps, start=start, progress=progress
        )
