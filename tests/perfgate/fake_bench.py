"""Stands in for a Google Benchmark program: its names, times and mishaps come from a file beside it.

The file PROGRAM.json has
    names        {name: {ns: time or list of times, one a process in turn, and what follows}}
                 digest, counters: on its rows; error: the message of an error row;
                 then (after `calls` processes): die (a signal), status, hang, garbage, rename
    way          fixed, times or time: which option for iterations it understands
    context      besides the usual
    log          a file to which each call is appended as one JSON line
"""

import json
import os
import re
import signal
import sys
import time


def option(name, default=None):
    for i, text in enumerate(sys.argv[1:], 1):
        if text == name and i + 1 < len(sys.argv):
            return sys.argv[i + 1]
        if text.startswith(name + "="):
            return text.partition("=")[2]
    return default


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(1)


def iterations_of(way):
    """The number that is asked for, in the one way that this program understands."""
    fixed, least = option("--fixed-iterations"), option("--benchmark_min_time")
    if fixed is not None:
        return int(fixed) if way == "fixed" else fail("unrecognized flag: --fixed-iterations")
    if least is not None and least.endswith("x"):
        return int(least[:-1]) if way == "times" else fail("min_time is expected to be a double")
    return None


def calls_so_far(path, name):
    """How many processes of this program have run this benchmark before."""
    count = 0
    if os.path.exists(path + ".calls"):
        with open(path + ".calls", encoding="utf-8") as file:
            count = sum(1 for line in file if line == name + "\n")
    with open(path + ".calls", "a", encoding="utf-8") as file:
        file.write(name + "\n")
    return count


def misbehave(row, count):
    if count < row.get("calls", 0):
        return
    if "die" in row:
        os.kill(os.getpid(), getattr(signal, row["die"]))
    if "hang" in row:
        time.sleep(row["hang"])
    if "status" in row:
        fail(row.get("says", "something went wrong"))
    if "garbage" in row:
        sys.stdout.write(row["garbage"])
        sys.exit(0)


def rows_of(name, row, count, iterations, repetitions):
    if "error" in row:
        return [{"name": name, "run_type": "iteration", "error_occurred": True,
                 "error_message": row["error"]}]
    ns = row["ns"]
    if isinstance(ns, list):
        ns = ns[count % len(ns)]
    made = []
    for repetition in range(repetitions):
        made.append({"name": row.get("rename", name), "run_type": "iteration",
                     "repetition_index": repetition, "iterations": iterations,
                     # The first of a process is cold.
                     "real_time": ns * (3 if repetition == 0 and repetitions > 1 else 1),
                     "cpu_time": ns / 2, "time_unit": row.get("unit", "ns"),
                     **row.get("counters", {}), **row.get("changing", {}).get(str(count), {})})
        if "digest" in row:
            made[-1].update(digest_hi=row["digest"] >> 32, digest_lo=row["digest"] & 0xFFFFFFFF)
    return made


def main():
    path = os.path.abspath(sys.argv[0])
    with open(path + ".json", encoding="utf-8") as file:
        scenario = json.load(file)
    names = scenario["names"]
    asked = iterations_of(scenario.get("way", "fixed"))
    if option("--benchmark_list_tests"):
        print("\n".join(names))
        return
    pattern = re.compile(option("--benchmark_filter", ""))
    repetitions = int(option("--benchmark_repetitions", "1"))
    iterations = asked or 1000
    found = [name for name in names if pattern.search(name)]
    rows = []
    for name in found:
        count = calls_so_far(path, name)
        if "log" in scenario:
            with open(scenario["log"], "a", encoding="utf-8") as log:
                log.write(json.dumps([os.path.basename(path), name, asked, repetitions,
                                      len(os.environ.get("PERFGATE_PAD", "")), os.getpid()]) + "\n")
        misbehave(names[name], count)
        rows += rows_of(name, names[name], count, iterations, repetitions)
    json.dump({"context": {"library_build_type": "release", "compiler": "gcc 12",
                           "flags": "Release: -O3", **scenario.get("context", {})},
               "benchmarks": rows}, sys.stdout)


if __name__ == "__main__":
    main()
