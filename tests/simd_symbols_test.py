"""The objects that are compiled for wider registers must define nothing but their entry points.

An inline function that such an object defines, too, may be the copy that the linker keeps for the
whole program, which would then stop on a processor without those registers.

    simd_symbols_test.py NM FOLDER     FOLDER: where the engine's objects are
"""

import pathlib
import subprocess
import sys


def strays(nm, path):
    """The names in one object that others could link to and that are not entry points."""
    text = subprocess.run([nm, "--defined-only", "--extern-only", "-C", path], check=True,
                          capture_output=True, text=True).stdout
    names = [line.split(maxsplit=2)[2] for line in text.splitlines()]
    return [name for name in names if "_avx2" not in name and not name.startswith("DW.ref.")]


def main(nm, folder):
    objects = sorted(pathlib.Path(folder).rglob("*_avx2.cpp.o"))
    if not objects:
        sys.exit(f"no object *_avx2.cpp.o below {folder}")
    # Whether that is the object of one file or of several compiled as one.
    plain = (path for path in pathlib.Path(folder).rglob("*.o") if path not in objects)
    if not any(strays(nm, path) for path in plain):
        sys.exit("the check finds nothing in an object that has other names")
    failed = False
    for path in objects:
        for name in strays(nm, path):
            print(f"{path.name} defines {name}")
            failed = True
    print(f"{len(objects)} objects looked at")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
