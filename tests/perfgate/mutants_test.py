#!/usr/bin/env python3
"""Breaks the statistics on purpose, one line at a time, and sees that its tests notice.

A mutant is a line of the core with one mistake in it. Each runs against stats_test.py and
sequential_test.py in a copy of the package; the tests kill it if they fail. Nine of ten must die.
Those that cannot change any answer are not in the list.
"""

import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import TOOLS

FOLDER = pathlib.Path(__file__).resolve().parent
SUITES = ("stats_test.py", "sequential_test.py")
LEAST_KILLED = 0.9

MUTANTS = [
    # file below stats/, what stands there, what is put in its place
    ("binomial.py", "if k < 0:", "if k <= 0:"),
    ("binomial.py", "range(min(k, n) + 1)", "range(min(k, n))"),
    ("binomial.py", "return lower_tail(n, n - k)", "return lower_tail(n, n - k - 1)"),
    ("binomial.py", "limit = numerator * 2**n", "limit = numerator * 2**(n - 1)"),
    ("binomial.py", "cumulated <= limit", "cumulated < limit"),
    ("binomial.py", "choices = choices * (n - k) // (k + 1)", "choices = choices * (n - k) // (k + 2)"),
    ("binomial.py", "        cumulated += choices\n        k += 1", "        k += 1\n        cumulated += choices + 1"),
    ("binomial.py", "while k < n and", "while k < n - 1 and"),
    ("binomial.py", "while order_index(n, alpha) == 0:", "while order_index(n, alpha) <= 1:"),
    ("binomial.py", "Fraction(alpha_run) * 2**n / looks", "Fraction(alpha_run) * 2**n"),
    ("bounds.py", "ordered[middle] if n % 2 else", "ordered[middle] if n % 2 == 0 else"),
    ("bounds.py", "ordered[middle - 1] + ordered[middle]", "ordered[middle] + ordered[middle]"),
    ("bounds.py", "abs(value - center)", "(value - center)"),
    ("bounds.py", "NORMAL_MAD = 1.4826", "NORMAL_MAD = 1.0"),
    ("bounds.py", "math.log(head / base)", "math.log(base / head)"),
    ("bounds.py", "if base > 0 and head > 0 else None", "if base > 0 else None"),
    ("bounds.py", "loose = order_index(n, pass_alpha)", "loose = order_index(n, alpha)"),
    ("bounds.py", "if value == 0.0),", "if value <= 0.0),"),
    ("bounds.py", "lower=ordered[k - 1] if k", "lower=ordered[k] if k"),
    ("bounds.py", "upper=ordered[n - k] if k", "upper=ordered[n - k - 1] if k"),
    ("bounds.py", "pass_lower=ordered[loose - 1]", "pass_lower=ordered[loose]"),
    ("bounds.py", "pass_upper=ordered[n - loose]", "pass_upper=ordered[n - loose - 1]"),
    ("bounds.py", "if value > threshold))", "if value >= threshold))"),
    ("bounds.py", "return margin + bounds.estimate - bounds.lower", "return margin + bounds.lower - bounds.estimate"),
    ("bounds.py", "if bounds is None or bounds.lower is None:", "if bounds is None:"),
    ("holm.py", "levels = [alpha / family]", "levels = [alpha]"),
    ("holm.py", "min(p_values) > Fraction(alpha / family)", "min(p_values) >= Fraction(alpha / family)"),
    ("holm.py", "key=lambda i: p_values[i]", "key=lambda i: -p_values[i]"),
    ("holm.py", "level = alpha / (family - rejected)", "level = alpha / family"),
    ("holm.py", "        rejected += 1", "        rejected += 2"),
    ("holm.py", "resting = alpha / max(1, family - rejected)", "resting = alpha / family"),
    ("holm.py", "if p_values[position] > Fraction(level):", "if p_values[position] >= Fraction(level):"),
    ("margins.py", "NOISE_FACTOR = 3.0", "NOISE_FACTOR = 2.0"),
    ("margins.py", "math.log(1.0 + configured)", "configured"),
    ("margins.py", "math.log(1.0 + configured)", "math.log1p(configured) - 1e-15"),
    ("margins.py", "margin = max(margin, NOISE_FACTOR * own_mad)", "margin = min(margin, NOISE_FACTOR * own_mad)"),
    ("margins.py", "math.log1p(min_effect_ns / base_ns)", "math.log1p(base_ns / min_effect_ns)"),
    ("ranksum.py", "range(1, m + 1)", "range(1, m)"),
    ("ranksum.py", "counts[u] -= counts[u - n - i]", "counts[u] += counts[u - n - i]"),
    ("ranksum.py", "(m + n + 1) / 12.0", "(m + n) / 6.0"),
    ("ranksum.py", "if cumulated > limit:", "if cumulated >= limit:"),
    ("ranksum.py", "for value in base if value > 0]", "for value in base if value >= 1]"),
    ("ranksum.py", "sorted(h - b for", "sorted(b - h for"),
    ("ranksum.py", "n=min(m, n), k=k", "n=max(m, n), k=k"),
    ("ranksum.py", "lower=shifts[k - 1] if k", "lower=shifts[k] if k"),
    ("ranksum.py", "upper=shifts[len(shifts) - k] if k", "upper=shifts[len(shifts) - k - 1] if k"),
    ("sequential.py", "return self.alpha_run / len(self.looks)", "return self.alpha_run"),
    ("sequential.py", "if bounds.lower > margin:", "if bounds.lower >= margin:"),
    ("sequential.py", "if bounds.lower > margin:", "if bounds.estimate > margin:"),
    ("sequential.py", "if bounds.upper < -margin:", "if bounds.upper < margin:"),
    ("sequential.py", "if bounds.lower > 0:", "if bounds.lower >= 0:"),
    ("sequential.py", "if bounds.pass_upper < margin:", "if bounds.pass_upper <= margin:"),
    ("sequential.py", "EQUIVALENT if bounds.pass_lower > -margin else PASS", "EQUIVALENT if bounds.pass_lower < -margin else PASS"),
    ("sequential.py", "> UNSTABLE_FACTOR * margin:", "< UNSTABLE_FACTOR * margin:"),
    ("sequential.py", "is_red = bounds.lower is not None and bounds.lower > margin", "is_red = False"),
    ("sequential.py", "return is_red or is_passed", "return is_red"),
    ("sequential.py", "ratios[name][:look] if v", "ratios[name] if v"),
    ("sequential.py", "max(tests - reds, len(active), 1)", "1"),
    ("sequential.py", "max(tests - reds, len(active), 1)", "max(tests, len(active), 1)"),
    ("sequential.py", "is_last and len(ratios[name]) >= look", "is_last"),
    ("sequential.py", "not decided and not is_last)", "not decided)"),
    ("sequential.py", "if not decided and len(ratios[name]) > look:", "if len(ratios[name]) > look:"),
    ("suite.py", "sum(values) / len(values)", "max(values)"),
    ("suite.py", "if not any(value is None for value in values)]", "if not all(value is None for value in values)]"),
]


def killed_by(number, mutant, work):
    """The suite that fails on a mutant; None: it lives."""
    name, old, new = mutant
    tools = pathlib.Path(work) / str(number)
    shutil.copytree(TOOLS / "perfgate", tools / "perfgate",
                    ignore=shutil.ignore_patterns("__pycache__"))
    file = tools / "perfgate" / "stats" / name
    text = file.read_text(encoding="utf-8")
    if text.count(old) < 1:
        raise AssertionError(f"{name} has no {old!r} any more: bring the list of mutants up to date")
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    environment = {**os.environ, "PERFGATE_TOOLS": str(tools), "PYTHONDONTWRITEBYTECODE": "1"}
    for suite in SUITES:
        ran = subprocess.run([sys.executable, str(FOLDER / suite), "--failfast"], check=False,
                             env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                             timeout=300)
        if ran.returncode != 0:
            return suite
    return None


class Mutants(unittest.TestCase):
    def test_nine_of_ten_are_killed(self):
        with tempfile.TemporaryDirectory(prefix="perfgate_mutants_") as work, \
                concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            found = list(pool.map(lambda item: killed_by(item[0], item[1], work), enumerate(MUTANTS)))
        alive = [" -> ".join(mutant[1:]) for mutant, suite in zip(MUTANTS, found) if suite is None]
        print(f"{len(found) - len(alive)} of {len(found)} mutants killed"
              + "".join(f"\n  lives: {text}" for text in alive))
        self.assertGreaterEqual(len(found) - len(alive), LEAST_KILLED * len(found))

    def test_the_tests_pass_on_what_is_not_changed(self):
        with tempfile.TemporaryDirectory(prefix="perfgate_mutants_") as work:
            same = ("bounds.py", "NORMAL_MAD = 1.4826", "NORMAL_MAD = 1.4826")
            self.assertIsNone(killed_by(0, same, work))


if __name__ == "__main__":
    unittest.main()
