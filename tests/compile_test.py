#!/usr/bin/env python3
"""Compiles, without linking, what has to compile on its own and what must not compile.

usage: compile_test.py headers COMMAND... -- FOLDER...   each header of each folder alone, twice
       compile_test.py cases COMMAND... -- FOLDER        each wrong line of FOLDER/*.cpp

COMMAND is the compiler with its flags. A case holds `#ifdef HEDGEROW_WRONG`, lines that must be
refused, `#else`, the corrected twin, `#endif`: the twin must compile, and the first error of the
wrong lines must lie among them, so that nothing is refused for another reason.
"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys


def compile_text(command, text):
    """Compiles a source given as text. Returns whether it was accepted, and the first errors."""
    result = subprocess.run(
        [*command, "-fsyntax-only", "-x", "c++", "-"], input=text, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    errors = [line for line in result.stdout.split("\n") if "error:" in line]
    return result.returncode == 0, "\n".join(errors[:5])


def check_header(command, root, header):
    name = header.relative_to(root).as_posix()
    accepted, messages = compile_text(command, f'#include "{name}"\n#include "{name}"\n')
    return None if accepted else f"{name} does not compile alone:\n{messages}"


def check_case(command, case):
    text = case.read_text(encoding="ascii")
    lines = text.split("\n")
    begin, end = lines.index("#ifdef HEDGEROW_WRONG") + 1, lines.index("#else") + 1
    accepted, messages = compile_text(command, text)
    if not accepted:
        return f"{case.name}: the corrected twin does not compile:\n{messages}"
    accepted, messages = compile_text([*command, "-DHEDGEROW_WRONG"], text)
    if accepted:
        return f"{case.name}: the wrong lines compile"
    error = re.search(r"^<stdin>:(\d+):\d+: error:", messages, re.MULTILINE)
    if error is None or not begin < int(error.group(1)) < end:
        return f"{case.name}: refused, but not for its wrong lines:\n{messages}"
    return None


def main():
    if len(sys.argv) < 5 or sys.argv[1] not in ("headers", "cases") or "--" not in sys.argv:
        print(__doc__)
        return 2
    split = sys.argv.index("--")
    command, folders = sys.argv[2:split], [pathlib.Path(f) for f in sys.argv[split + 1:]]
    if sys.argv[1] == "headers":
        jobs = [(check_header, command, root, header)
                for root in folders for header in sorted(root.rglob("*.h"))]
    else:
        jobs = [(check_case, command, case)
                for folder in folders for case in sorted(folder.glob("*.cpp"))]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failures = [f for f in pool.map(lambda job: job[0](*job[1:]), jobs) if f]
    for failure in failures:
        print(failure)
    print(f"{len(jobs)} {sys.argv[1]}, {len(failures)} failed")
    return 1 if failures or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())
