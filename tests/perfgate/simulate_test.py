#!/usr/bin/env python3
"""False reds and detection under simulated noise: a seeded sample of what `perfgate simulate` runs
10,000 times, and what can be computed without drawing anything."""

import math
import random
import statistics
import unittest
from fractions import Fraction
from itertools import islice

import support  # noqa: F401  (the path)
from perfgate.simulate.command import DETECTION, detection_rows, false_red_rows
from perfgate.simulate.noise import MODELS, places
from perfgate.simulate.trials import MARGIN, Setting, simulate_run, tallies
from perfgate.stats.binomial import order_index
from perfgate.stats.sequential import REGRESSION, Plan

RUNS = 60
SYMMETRIC = ("gaussian", "spikes", "bimodal", "log-normal", "ar1")


def exact_chance_of_red(plan, tests):
    """The chance that a benchmark whose median lies exactly at the margin is ever red, by counting
    the pairs above the margin: one fair coin a pair. Bonferroni's levels."""
    counts, before, red = {0: Fraction(1)}, 0, Fraction(0)
    for look in plan.looks:
        for _ in range(look - before):
            grown = {}
            for above, chance in counts.items():
                for step in (0, 1):
                    grown[above + step] = grown.get(above + step, 0) + chance / 2
            counts = grown
        before = look
        k = order_index(look, plan.look_alpha / tests)
        loose = order_index(look, plan.pass_alpha)
        red += sum(c for above, c in counts.items() if k and above > look - k)
        counts = {above: c for above, c in counts.items() if loose <= above <= look - k}
    return red


class Chance(unittest.TestCase):
    def test_of_a_red_run_at_the_margin_is_below_1_percent_however_many_benchmarks(self):
        for tests in (1, 2, 10, 51, 164, 1000):
            chance = float(tests * exact_chance_of_red(Plan(), tests))
            self.assertLessEqual(chance, 0.01, tests)
            self.assertGreater(chance, 0.001, tests)

    def test_agrees_with_runs_drawn_at_the_margin(self):
        """With 1 test in the family reds are frequent enough to be counted."""
        exact = float(exact_chance_of_red(Plan(alpha_run=0.5), 2))
        setting = Setting("gaussian", 0.02, 0.02, benchmarks=1, slow=1, plan=Plan(alpha_run=0.5))
        runs = 3000
        part = tallies([(setting, runs)], 1)[0]
        share = part.reds_by_look[-1] / runs
        self.assertAlmostEqual(share, exact, delta=4 * math.sqrt(exact * (1 - exact) / runs))


class NoiseModels(unittest.TestCase):
    def test_have_no_median_of_their_own(self):
        for name in SYMMETRIC:
            drawn = list(islice(MODELS[name](random.Random(1), 0.02, 0.0), 20000))
            self.assertAlmostEqual(statistics.median(drawn), 0.0, delta=0.001, msg=name)

    def test_add_the_effect(self):
        for name, model in MODELS.items():
            plain = list(islice(model(random.Random(4), 0.01, 0.0), 400))
            slower = list(islice(model(random.Random(4), 0.01, 0.05), 400))
            shift = statistics.median(slower) - statistics.median(plain)
            self.assertAlmostEqual(shift, 0.05, delta=0.006, msg=name)

    def test_tie_where_the_clock_is_coarse(self):
        drawn = list(islice(MODELS["ticks"](random.Random(1), 0.01, 0.0), 1000))
        self.assertGreater(drawn.count(0.0), 200)

    def test_place_processes_in_blocks_of_abba(self):
        order = list(islice(places(random.Random(3)), 40))
        self.assertEqual(sorted(place for pair in order for place in pair), list(range(80)))
        for first, second in zip(order[::2], order[1::2]):
            signs = [head - base for base, head in (first, second)]
            self.assertEqual(sorted(signs), [-1, 1])

    def test_remember_their_errors_where_they_say_so(self):
        drawn = list(islice(MODELS["ar1"](random.Random(2), 1.0, 0.0), 20000))
        products = statistics.fmean(a * b for a, b in zip(drawn, drawn[1:]))
        self.assertAlmostEqual(products / statistics.pvariance(drawn), 0.3, delta=0.03)


class FalseReds(unittest.TestCase):
    def test_do_not_occur_without_a_change(self):
        for model, part in false_red_rows(RUNS, 0.0, 1):
            self.assertEqual((part.runs, part.red_runs), (RUNS, 0), model)

    def test_do_not_occur_for_improvements(self):
        """100,000 benchmarks that became faster, and none red."""
        settings = [(Setting("gaussian", sd, -0.05), 1000) for sd in (0.01, 0.05)]
        calm, noisy = tallies(settings, 1)
        for part in (calm, noisy):
            self.assertEqual((part.benchmarks, part.red_runs, part.reds_by_look[-1]), (50000, 0, 0))
        self.assertGreater(calm.improvements, 25000)


class Detection(unittest.TestCase):
    def test_reaches_its_goals(self):
        for (sd, effect, pairs, goal), share in detection_rows(150, 1):
            # Three deviations of a share measured in 150 runs.
            slack = 3 * math.sqrt(goal * (1 - goal) / 150)
            self.assertGreater(share, goal - slack, (sd, effect, pairs))

    def test_covers_the_table(self):
        self.assertEqual(len(DETECTION), 5)


class Runs(unittest.TestCase):
    def test_are_the_same_for_the_same_seed_and_any_number_of_processes(self):
        settings = [(Setting("spikes", 0.02, 0.03, benchmarks=4, slow=2), 300)]
        self.assertEqual(tallies(settings, 1), tallies(settings, 2))

    def test_are_red_for_the_mean_when_all_are_slower(self):
        run = simulate_run(Setting("gaussian", 0.02, 0.04), random.Random(1))
        self.assertTrue(run.is_suite_red)
        self.assertGreater(MARGIN, 0.0198)

    def test_count_only_the_benchmarks_with_the_effect(self):
        part = tallies([(Setting("gaussian", 0.01, 0.2, benchmarks=5, slow=2), 10)], 1)[0]
        self.assertEqual((part.benchmarks, part.reds_by_look[-1], part.red_runs), (20, 20, 10))
        self.assertEqual(part.reds_by_look[0], 20)
        run = simulate_run(Setting("gaussian", 0.01, 0.2, benchmarks=5, slow=2), random.Random(1))
        self.assertEqual([run.outcomes[str(i)].verdict == REGRESSION for i in range(5)],
                         [True, True, False, False, False])


if __name__ == "__main__":
    unittest.main()
