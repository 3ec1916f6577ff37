"""The scaled groups of a bead."""

from typing import Any, Dict, Iterator, List, Tuple

from ._native import ffi
from ._tables import PARAMETERS


class Groups:
    """The scaled groups on which the motion depends, and the units behind them (``lambda`` is ``lambda_``)."""

    def __init__(self, groups: Any) -> None:
        names = {
            "shape": [text.strip() for text in PARAMETERS["magnet.shape"][1].split(",")],
            "material": [text.strip() for text in PARAMETERS["bead.material"][1].split(",")],
            "friction": [text.strip() for text in PARAMETERS["friction.law"][1].split(",")],
            "dynamics": [text.strip() for text in PARAMETERS["model.dynamics"][1].split(",")],
        }
        self._values: Dict[str, Any] = {}
        for name, field in ffi.typeof("fst_groups").fields:
            value = getattr(groups, name)
            if name in names:
                value = names[name][int(value)]
            self._values["lambda_" if name == "lambda" else name] = value

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name not in self.__dict__.get("_values", {}):
            raise AttributeError(name)
        return self._values[name]

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._values]

    def __iter__(self) -> Iterator[Tuple[str, Any]]:
        return iter(self._values.items())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Groups) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))

    def __repr__(self) -> str:
        return "Groups(" + ", ".join(f"{name}={value!r}" for name, value in self) + ")"
