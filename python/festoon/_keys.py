"""Keys of parameters, and the keywords that stand for them."""

from typing import Tuple

from ._errors import BadInput
from ._native import ffi, lib, text_of
from ._tables import PARAMETERS, SHORT


def row_of(key: str) -> Tuple[str, str, str]:
    """Kind (float, int or str), unit (or names of a choice) and doc of a key, of a magnet's part too."""
    if key in PARAMETERS:
        return PARAMETERS[key]
    row = lib.fst_param_at(lib.fst_param_find(key.encode()))
    if row.kind == lib.FST_KIND_CHOICE:
        return "str", text_of(row.names).replace("|", ", "), text_of(row.doc)
    return "int" if row.kind == lib.FST_KIND_INT else "float", text_of(lib.fst_unit_name(row.unit)), text_of(row.doc)


def key_of(keyword: str) -> str:
    """The key of a keyword: frequency is drive.frequency, friction__law is friction.law."""
    return SHORT.get(keyword, keyword.replace("__", "."))


def known_key(keyword: str) -> str:
    """The key of a keyword; one without a group is a short one, or wrong: the nearest keyword is named."""
    key = key_of(keyword)
    if "." in key or key == "coils":
        return key  # the library looks at it
    names = {of.split(".")[1]: keyword_of(of) for of in reversed(PARAMETERS)}
    names.update({keyword_of(of): keyword_of(of) for of in PARAMETERS})
    nearest = ffi.new("char[]", 64)
    edits = lib.fst_nearest_name(keyword.encode(), "|".join(names).encode(), nearest, 64)
    hint = "festoon.schema() lists them all"
    if edits <= max(2, len(keyword) // 2):
        hint = f"the nearest is {names[text_of(nearest)]} ({hint})"
    raise BadInput(keyword, f'unknown keyword "{keyword}"; {hint}')


def keyword_of(key: str) -> str:
    """The keyword of a key, the short one where there is one."""
    for short, of in SHORT.items():
        if of == key:
            return short
    return key.replace(".", "__")
