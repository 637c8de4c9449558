#!/usr/bin/env python3
"""Verdicts, looks and the mean of a suite, on pairs made by hand."""

import math
import random
import unittest

import support  # noqa: F401  (the path)
from perfgate.stats import bounds, suite
from perfgate.stats.sequential import (EQUIVALENT, IMPROVEMENT, INCONCLUSIVE, PASS, REGRESSION,
                                       SMALL_SLOWDOWN, UNSTABLE, Plan, is_decided, replay, verdict_of)

LN102 = math.log(1.02)


def values(n, low, high):
    """n values, evenly from low to high."""
    return [low + (high - low) * i / (n - 1) for i in range(n)]


class Verdict(unittest.TestCase):
    def verdict(self, low, high, n=24, is_exhausted=False):
        return verdict_of(bounds.bounds_of(values(n, low, high), 5e-5, 0.05), LN102, is_exhausted)

    def test_is_a_regression_beyond_the_margin_only(self):
        self.assertEqual(self.verdict(0.03, 0.05), REGRESSION)
        exactly = bounds.bounds_of([LN102] * 24, 5e-5, 0.05)
        self.assertEqual(verdict_of(exactly, LN102, False), SMALL_SLOWDOWN)

    def test_is_an_improvement_beyond_the_margin_only(self):
        self.assertEqual(self.verdict(-0.05, -0.03), IMPROVEMENT)
        exactly = bounds.bounds_of([-LN102] * 24, 5e-5, 0.05)
        self.assertEqual(verdict_of(exactly, LN102, False), PASS)

    def test_is_a_small_slowdown_below_the_margin(self):
        self.assertEqual(self.verdict(0.001, 0.015), SMALL_SLOWDOWN)

    def test_of_zero_is_no_slowdown(self):
        self.assertEqual(verdict_of(bounds.bounds_of([0.0] * 24, 5e-5, 0.05), LN102, False), EQUIVALENT)

    def test_is_equivalent_within_the_margin_on_both_sides(self):
        self.assertEqual(self.verdict(-0.015, 0.015), EQUIVALENT)

    def test_is_a_pass_when_only_a_slowdown_is_excluded(self):
        self.assertEqual(self.verdict(-0.06, 0.01), PASS)
        at_margin = bounds.bounds_of([-0.06] * 12 + [LN102] * 12, 5e-5, 0.05)
        self.assertEqual(verdict_of(at_margin, LN102, False), INCONCLUSIVE)

    def test_is_inconclusive_otherwise(self):
        self.assertEqual(self.verdict(-0.02, 0.06), INCONCLUSIVE)
        self.assertEqual(self.verdict(0.03, 0.05, n=14), INCONCLUSIVE)

    def test_is_unstable_at_the_last_look_if_three_margins_would_hide(self):
        self.assertEqual(self.verdict(-0.2, 0.3, is_exhausted=True), UNSTABLE)
        self.assertEqual(self.verdict(-0.2, 0.3), INCONCLUSIVE)
        self.assertEqual(self.verdict(-0.02, 0.06, is_exhausted=True), INCONCLUSIVE)

    def test_never_turns_an_improvement_into_a_regression(self):
        rng = random.Random(5)
        for _ in range(2000):
            n = rng.randint(1, 100)
            drawn = [rng.gauss(-0.05, rng.choice((0.001, 0.05, 0.5))) for _ in range(n)]
            found = bounds.bounds_of(drawn, 5e-5, 0.05)
            mirrored = bounds.bounds_of([-d for d in drawn], 5e-5, 0.05)
            there, back = (verdict_of(b, LN102, False) for b in (found, mirrored))
            self.assertEqual(there == IMPROVEMENT, back == REGRESSION)
            self.assertEqual(there == REGRESSION, back == IMPROVEMENT)


class Decision(unittest.TestCase):
    def test_stops_for_red_and_for_pass(self):
        for low, high, decided in ((0.03, 0.05, True), (-0.01, 0.01, True), (-0.02, 0.06, False)):
            found = bounds.bounds_of(values(24, low, high), 5e-5, 0.05)
            self.assertEqual(is_decided(found, LN102), decided)

    def test_needs_more_than_the_margin_itself(self):
        self.assertFalse(is_decided(bounds.bounds_of([LN102] * 24, 5e-5, 0.05), LN102))

    def test_never_stops_without_bounds(self):
        self.assertFalse(is_decided(bounds.bounds_of([0.5] * 4, 5e-5, 0.05), LN102))


class Replay(unittest.TestCase):
    PLAN = Plan()

    def test_stops_each_benchmark_at_its_own_look(self):
        calm = [0.0] * 96
        red = [0.10] * 96
        # Beyond the margin in half of the pairs: nothing is ever excluded or proven.
        torn = [0.10, -0.10] * 48
        found = replay({"calm": calm, "red": red, "torn": torn},
                       {"calm": LN102, "red": LN102, "torn": LN102}, self.PLAN, 4)
        self.assertEqual([found[n].bounds.n for n in ("calm", "red", "torn")], [16, 16, 96])
        self.assertEqual([found[n].verdict for n in ("calm", "red", "torn")],
                         [EQUIVALENT, REGRESSION, UNSTABLE])
        self.assertFalse(any(outcome.is_open for outcome in found.values()))

    def test_is_not_called_unstable_before_the_last_look_is_whole(self):
        torn = [0.10, -0.10] * 48
        for n, verdict in ((94, INCONCLUSIVE), (96, UNSTABLE)):
            found = replay({"torn": torn[:n]}, {"torn": LN102}, self.PLAN, 2)["torn"]
            self.assertEqual(found.verdict, verdict, n)

    def test_wants_more_while_a_look_is_left(self):
        torn = [0.10, -0.10] * 48
        for n, is_open in ((4, True), (16, True), (48, True), (50, False), (96, False)):
            found = replay({"torn": torn[:n]}, {"torn": LN102}, self.PLAN, 2)["torn"]
            self.assertEqual((found.bounds.n, found.is_open), (n, is_open))

    def test_does_not_look_at_what_came_after_the_decision(self):
        found = replay({"a": [0.0] * 16 + [0.2] * 80}, {"a": LN102}, self.PLAN, 2)["a"]
        self.assertEqual((found.verdict, found.bounds.n), (EQUIVALENT, 16))

    def test_counts_dropped_pairs_as_measured(self):
        found = replay({"a": [None] + [0.0] * 15 + [0.2] * 8}, {"a": LN102}, self.PLAN, 2)["a"]
        self.assertEqual((found.verdict, found.bounds.n), (EQUIVALENT, 15))

    def test_has_no_outcome_for_nothing(self):
        self.assertEqual(replay({"a": [], "b": [None, None]}, {"a": 1.0, "b": 1.0}, self.PLAN, 3), {})

    def test_goes_on_after_a_look_of_dropped_pairs(self):
        found = replay({"a": [None] * 16 + [0.0] * 8}, {"a": LN102}, self.PLAN, 2)["a"]
        self.assertEqual((found.bounds.n, found.verdict), (8, EQUIVALENT))

    def test_shares_the_chance_of_error_over_looks_and_tests(self):
        found = replay({"a": [0.10, -0.10] * 8}, {"a": LN102}, self.PLAN, 50)["a"]
        self.assertEqual(found.bounds.alpha, 0.01 / 4 / 50)

    def test_gives_what_a_red_leaves_to_the_others(self):
        # 16 pairs of which one is below the margin: p = 17 / 65536 = 2.6e-4.
        near = [0.10] * 15 + [0.0]
        names = [f"red{i}" for i in range(40)]
        ratios = {name: [0.10] * 16 for name in names}
        alone = replay({"near": near}, {"near": LN102}, self.PLAN, 41)["near"]
        self.assertEqual(alone.verdict, SMALL_SLOWDOWN if alone.bounds.lower > 0 else INCONCLUSIVE)
        ratios["near"] = near
        found = replay(ratios, dict.fromkeys(ratios, LN102), self.PLAN, 41)
        self.assertEqual(found["near"].bounds.alpha, 0.01 / 4)
        self.assertEqual(found["near"].verdict, REGRESSION)

    def test_remembers_the_reds_of_earlier_looks(self):
        torn = [0.10, -0.10] * 12
        found = replay({"red": [0.10] * 16, "torn": torn}, {"red": LN102, "torn": LN102}, self.PLAN, 10)
        self.assertEqual(found["torn"].bounds.alpha, 0.01 / 4 / 9)

    def test_asks_too_much_of_16_pairs_from_164_tests_on(self):
        for tests, verdict in ((163, REGRESSION), (164, INCONCLUSIVE)):
            found = replay({"a": [0.5] * 16}, {"a": LN102}, self.PLAN, tests)["a"]
            self.assertEqual(found.verdict, verdict)

    def test_is_the_same_whenever_it_is_asked(self):
        rng = random.Random(9)
        ratios = {str(i): [rng.gauss(0.01, 0.03) for _ in range(96)] for i in range(20)}
        given = dict.fromkeys(ratios, LN102)
        whole = replay(ratios, given, self.PLAN, 21)
        seen = {name: [] for name in ratios}
        open_names = list(ratios)
        for look in self.PLAN.looks:
            for name in open_names:
                seen[name] = ratios[name][:look]
            found = replay(seen, given, self.PLAN, 21)
            open_names = [name for name in ratios if found[name].is_open]
        self.assertEqual(found, whole)


class Suite(unittest.TestCase):
    def test_averages_each_round_over_the_benchmarks(self):
        self.assertEqual(suite.round_means({"a": [1.0, 3.0], "b": [2.0, 5.0]}), [1.5, 4.0])

    def test_ends_with_the_benchmark_that_stopped_first(self):
        self.assertEqual(suite.round_means({"a": [1.0, 3.0, 9.0], "b": [2.0]}), [1.5])

    def test_leaves_out_rounds_with_a_dropped_pair(self):
        self.assertEqual(suite.round_means({"a": [1.0, None, 5.0], "b": [2.0, 3.0, 6.0]}), [1.5, 5.5])

    def test_of_nothing_is_nothing(self):
        self.assertEqual(suite.round_means({}), [])
        self.assertIsNone(suite.suite_bounds({}, 0.01, 0.05))

    def test_proves_what_no_benchmark_proves_alone(self):
        rng = random.Random(2)
        rounds = {str(i): [rng.gauss(0.03, 0.03) for _ in range(16)] for i in range(50)}
        found = suite.suite_bounds(rounds, 5e-5, 0.05)
        self.assertGreater(found.lower, LN102)
        alone = replay(rounds, dict.fromkeys(rounds, LN102), Plan(), 51)
        self.assertFalse([o for o in alone.values() if o.verdict == REGRESSION])


if __name__ == "__main__":
    unittest.main()
