"""One bead in a world in which it needs three dimensions."""

from typing import TYPE_CHECKING, Any, Mapping

from ._errors import BadInput
from ._native import lib, text_of
from .bead import Bead

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

    def orbit(self, **keywords: Any) -> None:  # type: ignore[override]
        """The program's: `festoon orbit SCENE --json` finds orbits of a bead in a world.

        Parameters
        ----------
        **keywords
            Those of `Bead.orbit`, of which none is used.

        Raises
        ------
        BadInput
            Always.
        """
        raise BadInput("World.orbit", "orbits of a bead in a world are found by the program: festoon orbit SCENE --json")

    def branch(self, **keywords: Any) -> None:  # type: ignore[override]
        """The program's: `festoon branch SCENE -o FILE.json` follows families of orbits in a world; read() reads the file.

        Parameters
        ----------
        **keywords
            Those of `Bead.branch`, of which none is used.

        Raises
        ------
        BadInput
            Always.
        """
        raise BadInput(
            "World.branch", "branches of a bead in a world are followed by the program: festoon branch SCENE -o FILE.json"
        )

    if TYPE_CHECKING:  # Bead.run() makes it

        def run(self, **keywords: Any) -> "WorldRun":  # type: ignore[override]
            ...
