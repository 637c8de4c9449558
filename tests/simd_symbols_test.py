"""The objects that are compiled for wider registers must define nothing but their entry points.

An inline function that such an object defines, too, may be the copy that the linker keeps for the
whole program, which would then stop on a processor without those registers.

    simd_symbols_test.py NM FOLDER     FOLDER: where the engine's objects are
"""

import pathlib
import subprocess
import sys


WIDTHS = ("_avx2", "_avx512")  # in the names of sources and of what they define


def strays(nm, path, width):
    """The names in one object that others could link to and that are not entry points."""
    text = subprocess.run([nm, "--defined-only", "--extern-only", "-C", path], check=True,
                          capture_output=True, text=True).stdout
    names = [line.split(maxsplit=2)[2] for line in text.splitlines()]
    return [name for name in names if width not in name and not name.startswith("DW.ref.")]


def main(nm, folder):
    objects = {width: sorted(pathlib.Path(folder).rglob(f"*{width}.cpp.o")) for width in WIDTHS}
    for width, paths in objects.items():
        if not paths:
            sys.exit(f"no object *{width}.cpp.o below {folder}")
    # Whether that is the object of one file or of several compiled as one.
    wide = sum(objects.values(), [])
    plain = [path for path in pathlib.Path(folder).rglob("*.o") if path not in wide]
    for width in WIDTHS:
        if not any(strays(nm, path, width) for path in plain):
            sys.exit("the check finds nothing in an object that has other names")
    found = [f"{path.name} defines {name}"
             for width, paths in objects.items() for path in paths
             for name in strays(nm, path, width)]
    print(*found, f"{len(wide)} objects looked at", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
