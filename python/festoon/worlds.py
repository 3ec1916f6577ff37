"""One bead in a world in which it needs three dimensions."""

from typing import TYPE_CHECKING, Any, Mapping, Union

from ._errors import BadInput
from ._native import lib, text_of
from .bead import Bead

if TYPE_CHECKING:
    from .beads_orbits import BeadsBranch, BeadsLocked, BeadsOrbit, FloatingStates, WorldOrbit
    from .beads_runs import WorldRun
    from .branches import Branch


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

    if TYPE_CHECKING:  # Bead.run() and its neighbours make them

        def run(self, **keywords: Any) -> "WorldRun":  # type: ignore[override]
            ...

        def orbit(self, **keywords: Any) -> "Union[BeadsOrbit, WorldOrbit]":  # type: ignore[override]
            ...

        def locked(self, **keywords: Any) -> "Union[BeadsLocked, FloatingStates]":  # type: ignore[override]
            ...

        def branch(self, **keywords: Any) -> "Union[BeadsBranch, Branch]":  # type: ignore[override]
            ...
