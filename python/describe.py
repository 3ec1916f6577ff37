"""Write the module _tables: `describe.py EXTENSION OUTPUT.py`.

The tables of parameters, results, measured numbers and columns are asked of the library itself, and become typed
classes with docstrings, so that editors complete names and mypy checks them.
"""

import importlib.util
import sys
import textwrap

SHORT = {
    "frequency": "drive.frequency",
    "omega": "drive.omega",
    "kappa": "model.kappa",
    "gamma": "friction.gamma",
    "mu": "friction.mu",
}


def load(path):
    spec = importlib.util.spec_from_file_location("_festoon", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.ffi, module.lib


class Tables:
    def __init__(self, path):
        self.ffi, self.lib = load(path)

    def text(self, pointer):
        return self.ffi.string(pointer).decode()

    def rows(self, what):
        count = getattr(self.lib, f"fst_{what}_count")()
        return [getattr(self.lib, f"fst_{what}_at")(i) for i in range(count)]

    def parameters(self):
        for row in self.rows("param"):
            key = self.text(row.key)
            if row.kind == self.lib.FST_KIND_CHOICE:
                unit, kind = self.text(row.names).replace("|", ", "), "str"
            elif row.kind == self.lib.FST_KIND_TEXT:
                unit, kind = "", "str"
            else:
                unit = self.text(self.lib.fst_unit_name(row.unit))
                kind = "int" if row.kind == self.lib.FST_KIND_INT else "float"
            yield key, kind, unit, self.text(row.doc)

    def numbers(self, what):
        for row in self.rows(what):
            yield self.text(row.name), self.text(row.unit), self.text(row.doc)


def docstring(text, indent):
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    lines = textwrap.wrap(text, 108 - indent) or [""]
    if len(lines) == 1:
        return f'{" " * indent}"""{lines[0]}"""\n'
    pad = " " * indent
    return f'{pad}"""{lines[0]}\n' + "".join(f"{pad}{line}\n" for line in lines[1:]) + f'{pad}"""\n'


def keyword_lines(tables):
    names = list(SHORT) + [key.replace(".", "__") for key, *_ in tables.parameters()]
    lines = [f"            {name}: Value = None,\n" for name in names]
    lines.append("            magnet__parts: Optional[Iterable[Mapping[str, Any]]] = None,\n")
    return "".join(lines)


def write_parameters(tables, out):
    keywords = keyword_lines(tables)
    out.write("class Parameters:\n")
    out.write('    """Every parameter as an attribute, in SI units; None where it was not given."""\n\n')
    out.write("    def _parameter(self, key: str) -> Any:\n        raise NotImplementedError\n\n")
    out.write("    if TYPE_CHECKING:\n\n")
    out.write(f"        def __init__(\n            self,\n            scene: Any = None,\n            *,\n{keywords}        ) -> None: ...\n\n")
    out.write(f"        def replace(\n            self: Self,\n            *,\n{keywords}        ) -> Self: ...\n\n")
    for key, kind, unit, doc in tables.parameters():
        out.write(f"    @property\n    def {key.replace('.', '__')}(self) -> Optional[{kind}]:\n")
        out.write(docstring(f"{doc} [{unit}]" if unit else doc, 8))
        out.write(f"        return self._parameter({key!r})  # type: ignore[no-any-return]\n\n")
    out.write("\n")


def write_numbers(tables, what, name, intro, out):
    out.write(f"class {name}:\n{docstring(intro, 4)}\n")
    out.write("    def _number(self, name: str) -> float:\n        raise NotImplementedError\n\n")
    for number, unit, doc in tables.numbers(what):
        out.write(f"    @property\n    def {number}(self) -> float:\n{docstring(f'{doc} [{unit}]', 8)}")
        out.write(f"        return self._number({number!r})\n\n")
    out.write("\n")


def write_arrays(tables, name, intro, extra, out):
    out.write(f"class {name}:\n{docstring(intro, 4)}\n")
    out.write("    def _array(self, name: str) -> Any:\n        raise NotImplementedError\n\n")
    for number, unit, doc in tables.numbers("result"):
        out.write(f"    @property\n    def {number}(self) -> Any:\n{docstring(f'{doc} [{unit}]', 8)}")
        out.write(f"        return self._array({number!r})\n\n")
    out.write("\n")


def write_columns(tables, out):
    out.write("class Columns:\n")
    out.write('    """The columns of a trajectory."""\n\n')
    out.write("    def _column(self, name: str) -> Any:\n        raise NotImplementedError\n\n")
    for name, unit, doc in tables.numbers("column"):
        out.write(f"    @property\n    def {name}(self) -> Any:\n{docstring(f'{doc} [{unit}]', 8)}")
        out.write(f"        return self._column({name!r})\n\n")
    out.write("\n")


def main():
    extension, output = sys.argv[1:]
    tables = Tables(extension)
    with open(output, "w", encoding="utf-8") as out:
        out.write('"""Parameters, results and columns; written by describe.py from the library\'s tables."""\n\n')
        out.write("from typing import TYPE_CHECKING, Any, Iterable, Mapping, Optional\n\n")
        out.write("if TYPE_CHECKING:\n    from typing import Self\n\n    from ._quantities import Value\n\n")
        for name, value in (
            ("SHORT", SHORT),
            ("PARAMETERS", {key: (kind, unit, doc) for key, kind, unit, doc in tables.parameters()}),
            ("RESULTS", {name: (unit, doc) for name, unit, doc in tables.numbers("result")}),
            ("MEASURED", {name: (unit, doc) for name, unit, doc in tables.numbers("measured")}),
            ("COLUMNS", {name: (unit, doc) for name, unit, doc in tables.numbers("column")}),
        ):
            out.write(f"{name} = {{\n")
            for key, row in value.items():
                out.write(f"    {key!r}: {row!r},\n")
            out.write("}\n\n")
        out.write("\n")
        write_parameters(tables, out)
        write_numbers(
            tables, "result", "RunNumbers", "The numbers that describe a run, scaled; NaN where undefined.", out
        )
        write_numbers(
            tables, "measured", "MeasuredNumbers", "The numbers measured of a track; NaN where unknown.", out
        )
        write_arrays(tables, "SweepNumbers", "The numbers of runs, an array of each.", (), out)
        write_columns(tables, out)


if __name__ == "__main__":
    main()
