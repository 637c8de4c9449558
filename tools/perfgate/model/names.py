"""Names of benchmarks as regular expressions."""

from __future__ import annotations

import re

# What has a meaning both in ECMAScript's and in POSIX's regular expressions; no more is escaped,
# since a backslash before another character is an error in some libraries.
SPECIAL = re.compile(r"([.\[\]{}()*+?^$|\\])")


def exact_pattern(name: str) -> str:
    """What --benchmark_filter matches with this name and no other."""
    return "^" + SPECIAL.sub(r"\\\1", name) + "$"
