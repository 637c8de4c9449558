#!/usr/bin/env python3
"""Makes the engine worse in twelve known ways, one after the other, and sees that each is noticed.

  run.py [--only NAME]... [--ref REF] [--judge perfgate|counts] [--work FOLDER]
  run.py --list | --check

Each patch beside this file says what it does to the engine, which arm of the gate must notice (time,
instructions, memory or result) and on which rows. This builds the benchmarks of REF (default: HEAD)
in a copy of the tree, then with each patch applied, has both programs judged by tools/perfgate (or by
bench/count.py, counters and pairs of processes alone), and prints a table. A patch that no longer
applies is an error, like one that goes unnoticed. Takes half an hour.

Exit status: 0 all noticed, 1 one was missed, or did not apply or build, 2 usage.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent
sys.path.insert(0, str(FOLDER))
sys.path.insert(0, str(FOLDER.parent))

import gate  # noqa: E402  (the path comes first)
import judge  # noqa: E402
from perf_format import markdown  # noqa: E402

CONFIGURE = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DHEDGEROW_BUILD_BENCH=ON",
             "-DHEDGEROW_BUILD_TESTS=OFF", "-DHEDGEROW_BUILD_TOOLS=OFF", "-DHEDGEROW_BUILD_IO=OFF"]
# Only the engine is compared.
CONFIGURE += [f"-DCMAKE_DISABLE_FIND_PACKAGE_{peer}=ON" for peer in ("CGAL", "OpenMesh", "meshoptimizer")]


class Regression:
    """One patch: lines "What:", "Arm:" and "Rows:" before the first difference."""

    def __init__(self, path):
        self.path = path
        self.name = path.stem
        text = path.read_text(encoding="utf-8")
        head = text[:text.index("diff --git ")]
        fields = dict(re.findall(r"^(\w+): (.+)$", head, re.M))
        if set(fields) != {"What", "Arm", "Rows"} or fields["Arm"] not in judge.ARMS:
            raise ValueError(f"{path.name}: What, Arm ({', '.join(judge.ARMS)}) and Rows are wanted")
        self.what, self.arm, self.rows = fields["What"], fields["Arm"], fields["Rows"]


def regressions():
    return [Regression(path) for path in sorted(FOLDER.glob("*.patch"))]


def applies(regression, tree):
    """Empty, or what git says."""
    ran = subprocess.run(["git", "apply", "--check", str(regression.path)], cwd=tree, check=False,
                         stderr=subprocess.PIPE, env=outside_git(tree))
    return "" if ran.returncode == 0 else ran.stderr.decode().strip()


def outside_git(tree):
    """`git apply` leaves out files of a folder that a repository further up does not know."""
    return {**os.environ, "GIT_CEILING_DIRECTORIES": str(pathlib.Path(tree).parent)}


def apply(regression, tree, *options):
    subprocess.run(["git", "apply", *options, str(regression.path)], cwd=tree, check=True,
                   env=outside_git(tree))


def copy_tree(ref, tree):
    tree.mkdir(parents=True)
    archive = subprocess.Popen(["git", "archive", ref], cwd=ROOT, stdout=subprocess.PIPE)
    subprocess.run(["tar", "x", "-C", str(tree)], stdin=archive.stdout, check=True)
    if archive.wait() != 0:
        raise SystemExit(2)


def build(tree, build_folder, to):
    """The program, copied to `to`; empty, or what the build says."""
    log = build_folder.with_suffix(".log")
    with log.open("w", encoding="utf-8") as out:
        for command in (["cmake", "-S", str(tree), "-B", str(build_folder), *CONFIGURE],
                        ["cmake", "--build", str(build_folder), "--target", "hedgerow_bench"]):
            if subprocess.run(command, check=False, stdout=out, stderr=subprocess.STDOUT).returncode != 0:
                return f"does not build: {log.read_text(encoding='utf-8')[-2000:]}"
    to.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy2(build_folder / "bench" / "hedgerow_bench", to)
    return ""


def examine(regression, arms, tree, build_folder, base, work):
    """(finding, whether it was noticed)."""
    refused = applies(regression, tree)
    if refused:
        return f"no longer applies: {refused}", False
    head = work / regression.name / "hedgerow_bench"
    apply(regression, tree)
    try:
        broken = build(tree, build_folder, head)
    finally:
        apply(regression, tree, "--reverse")
    if broken:
        return broken, False
    try:
        return arms[regression.arm](base, head, regression.rows)
    except (judge.RowsError, subprocess.CalledProcessError) as error:
        return f"cannot be judged: {error}", False


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", help="one of the names of --list; may be repeated")
    parser.add_argument("--ref", default="HEAD")
    parser.add_argument("--judge", choices=("perfgate", "counts"),
                        default="perfgate" if gate.is_there() else "counts")
    parser.add_argument("--work", type=pathlib.Path, help="an empty folder that is kept")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true", help="only whether they apply to this tree")
    options = parser.parse_args(arguments)
    chosen = regressions()
    if options.only:
        unknown = set(options.only) - {regression.name for regression in chosen}
        if unknown:
            parser.error(f"no such regression: {', '.join(sorted(unknown))}")
        chosen = [regression for regression in chosen if regression.name in options.only]
    if options.list:
        for regression in chosen:
            print(f"{regression.name:24} {regression.arm:13} {regression.what}")
        return 0
    if options.check:
        refused = {regression.name: applies(regression, ROOT) for regression in chosen}
        for name, said in refused.items():
            print(f"{name}: {said or 'applies'}")
        return 1 if any(refused.values()) else 0
    # Wide ids compile everything anew: last.
    chosen.sort(key=lambda regression: regression.name == "wide-ids")
    with tempfile.TemporaryDirectory() as folder:
        return run(chosen, options, options.work or pathlib.Path(folder) / "work")


def run(chosen, options, work):
    tree, build_folder, base = work / "tree", work / "build", work / "base" / "hedgerow_bench"
    arms = (gate if options.judge == "perfgate" else judge).ARMS
    copy_tree(options.ref, tree)
    broken = build(tree, build_folder, base)
    if broken:
        print(f"{options.ref} {broken}", file=sys.stderr)
        return 1
    table = []
    for regression in chosen:
        finding, is_noticed = examine(regression, arms, tree, build_folder, base, work)
        table.append([regression.name, regression.arm, finding, "caught" if is_noticed else "MISSED"])
        print(f"{table[-1][3]}: {regression.name}: {finding}", file=sys.stderr)
    print(markdown(["regression", "arm", "finding", "verdict"], table, left=4))
    caught = sum(row[3] == "caught" for row in table)
    print(f"\n{caught} of {len(table)} caught")
    return 0 if caught == len(table) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
