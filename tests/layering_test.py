#!/usr/bin/env python3
"""Checks the rules that hold for every source file: layers, printing, length, characters.

usage: layering_test.py ROOT          check the tree, exit 1 if a rule is broken
       layering_test.py --self-test   break each rule in a small tree and see it fire
"""

import pathlib
import re
import sys
import tempfile

FOLDERS = ("engine", "bench", "tests", "tools")
CPP = {".h", ".cpp"}
TEXT = CPP | {".py", ".cmake", ".txt", ".sh", ".md", ".in", ""}
MAX_LINES = 400
MAX_COLUMNS = 100

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)

# What the engine never does, whatever the layer: (rule, pattern in code without comments, strings).
PRINTING = re.compile(
    r"\b(v?f?printf|f?puts|f?putc|putchar|perror|(std|fmt)::(print|println|cout|cerr|clog))\b")
ABORTING = re.compile(r"\b(abort|_?exit|_Exit|quick_exit|terminate)\s*\(|\bassert\s*\(")
THROWING = re.compile(r"\bthrow\b(?!\s+std::bad_alloc\b)")
# What a kernel leaves to the layers above it.
ALLOCATING = re.compile(
    r"\b(new|malloc|calloc|realloc|aligned_alloc|allocate_bytes)\b"
    r"|\bstd::(make_unique|make_shared|vector|string|map|unordered_\w+)\b|\bBuffer\s*<")
KERNEL_SYSTEM_BANNED = {
    "thread", "mutex", "shared_mutex", "condition_variable", "future", "vector", "string", "map",
    "unordered_map", "unordered_set", "set", "memory", "memory_resource", "iostream", "fstream",
    "cstdio", "sstream", "filesystem", "new",
}
TERMS = re.compile(r"\b(twin|dart|dedge|halfEdge|HalfEdge)s?\b")


def strip(text):
    """The text with comments and the contents of literals blanked out, line structure kept."""
    pattern = re.compile(
        r'R"([^()\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\''
        r"|//[^\n]*|/\*.*?\*/", re.DOTALL)
    return pattern.sub(lambda m: '""' + "\n" * m.group(0).count("\n"), text)


def layer_of(path):
    """The layer of a file of the engine, by its folder."""
    parts = path.split("/")
    if parts[:3] == ["engine", "src", "kernels"]:
        return "kernels"
    if parts[:3] == ["engine", "src", "parallel"]:
        return "parallel"
    if parts[:2] == ["engine", "src"]:
        return "policy"
    if parts[:2] == ["engine", "include"]:
        return "public"
    return parts[1]  # io, ray, capi, shapes: optional libraries on the public API


def target_layer(header):
    """The layer that a quoted include belongs to, seen from inside the engine."""
    for folder in ("kernels", "parallel"):
        if header.startswith(folder + "/"):
            return folder
    for library in ("io", "ray", "capi", "shapes"):
        if header.startswith(("hedgerow/" + library + "/", library + "/")):
            return library
        if header == "hedgerow/" + library + ".h":
            return library
    return "public" if header.startswith("hedgerow/") else "own"


# Which layers a layer may include, besides itself.
MAY_INCLUDE = {
    "public": set(),
    "kernels": {"public"},
    "parallel": {"public"},
    "policy": {"public", "kernels", "parallel", "own"},
    "io": {"public", "own"},
    "shapes": {"public", "own"},
    "ray": {"public", "own", "parallel"},
    "capi": {"public", "own"},
}
KERNEL_PUBLIC_BANNED = {"hedgerow/execution.h", "hedgerow/workspace.h"}


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def check_includes(path, text):
    layer = layer_of(path)
    for match in INCLUDE.finditer(text):
        bracket, header = match.groups()
        line = line_of(text, match.start())
        if header.startswith(("tbb/", "oneapi/tbb")) and layer != "parallel":
            yield line, "tbb", f"<{header}> outside engine/src/parallel"
        if header.startswith("embree") and layer != "ray":
            yield line, "embree", f"<{header}> outside engine/ray"
        if header == "iostream":
            yield line, "printing", "<iostream> in the engine"
        if header in ("cassert", "assert.h") and not path.endswith("hedgerow/assert.h"):
            yield line, "aborting", f"<{header}> outside assert.h"
        if bracket == "<":
            if layer == "kernels" and header in KERNEL_SYSTEM_BANNED:
                yield line, "kernel", f"<{header}> in a kernel"
            continue
        target = target_layer(header)
        if target != layer and target not in MAY_INCLUDE.get(layer, set()):
            yield line, "upward", f'"{header}" ({target}) from {layer}'
        if layer == "kernels" and header in KERNEL_PUBLIC_BANNED:
            yield line, "kernel", f'"{header}" in a kernel'


def check_code(path, code):
    rules = [("printing", PRINTING), ("throwing", THROWING), ("terms", TERMS)]
    if not path.endswith("hedgerow/assert.h"):
        rules.append(("aborting", ABORTING))
    if layer_of(path) == "kernels":
        rules.append(("kernel", ALLOCATING))
    for rule, pattern in rules:
        for match in pattern.finditer(code):
            yield line_of(code, match.start()), rule, f"`{match.group(0).strip()}` in the engine"


def check_outside(path, text):
    """Programs, benchmarks: anything public, nothing below it."""
    for match in INCLUDE.finditer(text):
        if match.group(1) == '"' and match.group(2).startswith(("kernels/", "parallel/")):
            yield line_of(text, match.start()), "upward", f'"{match.group(2)}" outside the engine'
        if match.group(2).startswith("embree"):
            yield line_of(text, match.start()), "embree", f"<{match.group(2)}> outside engine/ray"


def check_file(path, text):
    """All broken rules of one file as (line, rule, message)."""
    for number, line in enumerate(text.split("\n"), 1):
        if not line.isascii():
            yield number, "ascii", "a character outside ASCII"
    suffix = pathlib.PurePath(path).suffix
    if text.count("\n") > MAX_LINES and suffix != ".md":
        yield MAX_LINES, "length", f"{text.count(chr(10))} lines, at most {MAX_LINES}"
    if suffix not in CPP:
        return
    for number, line in enumerate(text.split("\n"), 1):
        if len(line) > MAX_COLUMNS and 'R"' not in line:
            yield number, "columns", f"{len(line)} columns, at most {MAX_COLUMNS}"
    code = strip(text)
    if suffix == ".h" and "#pragma once" not in code:
        yield 1, "pragma", "a header without #pragma once"
    if path.startswith("engine/"):
        yield from check_includes(path, text)
        yield from check_code(path, code)
    elif path.startswith(("tools/", "bench/")):
        yield from check_outside(path, text)


def check_tree(root):
    """All broken rules of a tree as (path, line, rule, message), and the number of files seen."""
    found = []
    count = 0
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*")):
            if not file.is_file() or file.suffix not in TEXT or "__pycache__" in file.parts:
                continue
            path = file.relative_to(root).as_posix()
            count += 1
            text = file.read_bytes().decode("utf-8", errors="replace")
            found += [(path, *broken) for broken in check_file(path, text)]
    return found, count


# One seeded violation per line: (path, contents, rule that must fire).
SEEDS = [
    ("engine/src/kernels/k.cpp", '#include "parallel/parallel.h"\n', "upward"),
    ("engine/src/parallel/p.cpp", '#include "kernels/k.h"\n', "upward"),
    ("engine/src/kernels/k.cpp", '#include "policy.h"\n', "upward"),
    ("engine/include/hedgerow/a.h", '#pragma once\n#include "kernels/k.h"\n', "upward"),
    ("engine/src/a.cpp", '#include "hedgerow/io/ply.h"\n', "upward"),
    ("engine/io/a.cpp", '#include "parallel/parallel.h"\n', "upward"),
    ("tools/src/a.cpp", '#include "kernels/k.h"\n', "upward"),
    ("bench/a.cpp", '#include "parallel/parallel.h"\n', "upward"),
    ("engine/ray/a.cpp", '#include "kernels/k.h"\n', "upward"),
    ("engine/src/a.cpp", '#include "hedgerow/ray/scene.h"\n', "upward"),
    ("engine/ray/a.cpp", "#include <tbb/task_arena.h>\n", "tbb"),
    ("engine/io/a.cpp", "#include <embree4/rtcore.h>\n", "embree"),
    ("tools/src/a.cpp", "#include <embree3/rtcore.h>\n", "embree"),
    ("bench/a.cpp", "#include <embree3/rtcore.h>\n", "embree"),
    ("engine/src/a.cpp", "#include <tbb/parallel_for.h>\n", "tbb"),
    ("engine/include/hedgerow/a.h", "#pragma once\n#include <oneapi/tbb.h>\n", "tbb"),
    ("engine/src/a.cpp", "#include <embree3/rtcore.h>\n", "embree"),
    ("engine/src/a.cpp", "#include <iostream>\n", "printing"),
    ("engine/io/a.cpp", 'void f() { std::printf("x"); }\n', "printing"),
    ("engine/shapes/a.cpp", 'void f() { std::cerr << "x"; }\n', "printing"),
    ("engine/src/a.cpp", 'void f() { fmt::print("x"); }\n', "printing"),
    ("engine/src/a.cpp", "void f() { std::abort(); }\n", "aborting"),
    ("engine/src/a.cpp", "void f() { exit(1); }\n", "aborting"),
    ("engine/src/a.cpp", "void f(int i) { assert(i > 0); }\n", "aborting"),
    ("engine/src/a.cpp", "#include <cassert>\n", "aborting"),
    ("engine/src/a.cpp", "void f() { throw 1; }\n", "throwing"),
    ("engine/src/kernels/k.cpp", "int* f() { return new int; }\n", "kernel"),
    ("engine/src/kernels/k.cpp", "Buffer<int> f();\n", "kernel"),
    ("engine/src/kernels/k.cpp", "#include <thread>\n", "kernel"),
    ("engine/src/kernels/k.cpp", '#include "hedgerow/execution.h"\n', "kernel"),
    ("engine/src/a.cpp", "int twin;\n", "terms"),
    ("engine/src/a.cpp", "// caf\u00e9\n", "ascii"),
    ("tools/run", "# \u2013\n", "ascii"),
    ("tests/a.cpp", "//\n" * (MAX_LINES + 1), "length"),
    ("tests/a.h", "int a;\n", "pragma"),
    ("engine/src/a.cpp", "// " + "x" * MAX_COLUMNS + "\n", "columns"),
]

# Nothing here breaks a rule, though each line resembles something that does.
CLEAN = [
    ("engine/src/parallel/p.cpp", "#include <tbb/parallel_for.h>\n"),
    ("engine/ray/r.cpp", '#include <embree3/rtcore.h>\n#include "hedgerow/build.h"\n'),
    ("engine/ray/r.cpp", '#include "embree_api.h"\n#include "parallel/parallel.h"\n'),
    ("engine/src/a.cpp", '#include "kernels/k.h"\n#include "parallel/parallel.h"\n'),
    ("engine/src/a.cpp", "// printf(), abort() and throw in a comment\n/* exit(1) */\n"),
    ("engine/src/a.cpp", 'const char* s = "std::cout << abort()";\nstatic_assert(true);\n'),
    ("engine/src/a.cpp", "void f() { throw std::bad_alloc(); }\n"),
    ("engine/src/a.cpp", "int n = snprintf(p, 4, q); bool exited(); constexpr int k = 1'000;\n"),
    ("engine/src/kernels/k.cpp", '#include "hedgerow/index.h"\nint renew(int news);\n'),
    ("engine/io/a.cpp", '#include "hedgerow/soup.h"\n#include "reader.h"\n'),
    ("engine/include/hedgerow/assert.h", "#pragma once\n#include <cassert>\n"),
    ("tests/a.cpp", '#include "kernels/k.h"\nint main() { abort(); }\n'),
    ("tools/src/a.cpp", "void f() { std::puts(s); }\n"),
    ("tests/a.cpp", 'auto s = R"(' + "x" * MAX_COLUMNS + ')";\n'),
    ("tests/a.h", "#pragma once\n" + "//\n" * (MAX_LINES - 1)),
]


def check_seed(path, contents):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, path)
        file.parent.mkdir(parents=True)
        file.write_text(contents, encoding="utf-8")
        found, count = check_tree(pathlib.Path(folder))
        assert count == 1
        return {rule for _, _, rule, _ in found}


def self_test():
    failures = 0
    for path, contents, rule in SEEDS:
        fired = check_seed(path, contents)
        if rule not in fired:
            failures += 1
            print(f"'{rule}' did not fire on {path}: {contents[:60]!r}, but {sorted(fired)}")
    for path, contents in CLEAN:
        fired = check_seed(path, contents)
        if fired:
            failures += 1
            print(f"{sorted(fired)} fired on {path}: {contents[:60]!r}")
    print(f"{len(SEEDS)} violations and {len(CLEAN)} clean files tried, {failures} wrong answers")
    return 1 if failures else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    found, count = check_tree(pathlib.Path(sys.argv[1]))
    for path, line, rule, message in found:
        print(f"{path}:{line}: {rule}: {message}")
    print(f"{count} files, {len(found)} broken rules")
    return 1 if found or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
