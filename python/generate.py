"""Write the C source of the extension module: `generate.py CC INCLUDE... OUTPUT.c`.

The declarations that cffi wants are the public headers themselves, after the C preprocessor: what is added to
params.def, run.def or a struct is in Python by itself.  The system's headers are replaced by empty ones, for cffi
knows size_t, uint32_t and FILE without them.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import cffi

EMPTY = ("math.h", "stddef.h", "stdint.h", "stdio.h")
HERE = pathlib.Path(__file__).resolve().parent


def declarations(compiler, folders):
    """The public headers and native.h as cdef() accepts them."""
    with tempfile.TemporaryDirectory() as empty:
        for name in EMPTY:
            (pathlib.Path(empty) / name).touch()
        command = [compiler, "-E", "-P", "-nostdinc", "-U__GNUC__", "-I", empty]
        for folder in [*folders, str(HERE)]:
            command += ["-I", folder]
        text = subprocess.run(
            [*command, str(HERE / "native.h")], check=True, stdout=subprocess.PIPE, text=True
        ).stdout
        macros = subprocess.run(
            [*command, "-dM", str(HERE / "native.h")], check=True, stdout=subprocess.PIPE, text=True
        ).stdout
    # Plain integers and strings among the macros are constants in Python too.
    numbers = re.findall(r"^#define (FST_[A-Z0-9_]+) \(?(\d+)\)?$", macros, re.MULTILINE)
    constants = "".join(f"#define {name} {value}\n" for name, value in sorted(numbers))
    return constants + text


def main():
    compiler, *folders, output = sys.argv[1:]
    ffi = cffi.FFI()
    ffi.cdef(declarations(compiler, folders))
    ffi.cdef(
        'extern "Python+C" fst_status pyf_tell_python(void *handle, double fraction, const char *what,'
        " fst_error *error);"
    )
    ffi.cdef("void free(void *memory); FILE *fopen(const char *path, const char *mode); int fclose(FILE *file);")
    ffi.set_source("festoon._festoon", '#include <stdio.h>\n#include <stdlib.h>\n#include "native.h"\n')
    ffi.emit_c_code(output)


if __name__ == "__main__":
    main()
