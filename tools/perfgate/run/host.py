"""Say what this host is and how noisy it is, with nothing of yours: three fixed kernels.

Exit: 0 fit, 3 unfit (a paired deviation is above the limit).
"""

from __future__ import annotations

import argparse

from ..errors import OK, UNFIT
from ..model.config import Config
from ..model.jsonio import dumps
from .fingerprint import cpu_ticks, host_class, host_facts, steal_percent
from .lock import HostLock
from .probe import probe


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--limit", type=float, default=Config().noise_limit,
                        help="paired deviation, as a share (0.05)")
    parser.add_argument("--json", action="store_true")


def main(options: argparse.Namespace) -> int:
    with HostLock():
        facts = host_facts()
        before = cpu_ticks()
        facts["probe"] = probe(options.seconds)
        facts["steal_pct"] = steal_percent(before, cpu_ticks())
    facts["class"] = host_class(facts)
    worst = max(facts["probe"].values())
    facts["is_fit"] = worst <= options.limit
    if options.json:
        print(dumps(facts), end="")
    else:
        for key, value in facts.items():
            if key == "probe":
                for kernel, sd in value.items():
                    print(f"{kernel:<14} {sd:.2%}")
            elif key != "is_fit":
                print(f"{key:<14} {value}")
        print(f"{'fit' if facts['is_fit'] else 'unfit'}: the largest paired deviation is {worst:.2%}, "
              f"the limit {options.limit:.2%}")
    return OK if facts["is_fit"] else UNFIT
