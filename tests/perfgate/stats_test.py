#!/usr/bin/env python3
"""The statistics against published values, other algorithms and rules worked out by hand."""

import itertools
import math
import random
import unittest
from fractions import Fraction

import support  # noqa: F401  (the path)
from perfgate.stats import binomial, bounds, holm, margins, ranksum

LN102 = math.log(1.02)


class BinomialIndex(unittest.TestCase):
    def test_gives_the_published_ranks_of_the_95_percent_interval_of_a_median(self):
        published = {5: 0, 6: 1, 7: 1, 8: 1, 9: 2, 10: 2, 11: 2, 12: 3, 15: 4, 17: 5, 20: 6, 25: 8,
                     30: 10, 40: 14, 50: 18, 100: 40}
        for n, k in published.items():
            self.assertEqual(binomial.order_index(n, 0.025), k, n)

    def test_gives_the_published_ranks_of_the_99_percent_interval_of_a_median(self):
        published = {7: 0, 8: 1, 10: 1, 12: 2, 15: 3, 20: 4, 25: 6, 30: 8, 50: 16, 100: 37}
        for n, k in published.items():
            self.assertEqual(binomial.order_index(n, 0.005), k, n)

    def test_gives_the_ranks_of_the_looks(self):
        self.assertEqual([binomial.order_index(n, 5e-5) for n in (16, 24, 48, 96)], [1, 3, 11, 29])

    def test_agrees_with_pascals_triangle_from_2_to_1024(self):
        row = [1, 1]
        for n in range(2, 1025):
            row = [1] + [a + b for a, b in zip(row, row[1:])] + [1]
            for alpha in (0.05, 0.025, 0.005, 5e-5):
                k = binomial.order_index(n, alpha)
                below = sum(row[:k])
                numerator, denominator = alpha.as_integer_ratio()
                limit = numerator * 2**n
                self.assertLessEqual(below * denominator, limit, (n, alpha))
                self.assertGreater((below + row[k]) * denominator, limit, (n, alpha))

    def test_takes_a_chance_that_is_met_exactly(self):
        self.assertEqual(binomial.order_index(4, 1 / 16), 1)
        self.assertEqual(binomial.order_index(4, 1 / 16 - 1e-12), 0)
        self.assertEqual(binomial.order_index(4, 1.0), 4)

    def test_knows_the_least_number_of_values(self):
        self.assertEqual([binomial.smallest_n(a) for a in (0.025, 0.005, 0.0005, 5e-5)], [6, 8, 11, 15])

    def test_knows_how_many_tests_a_look_of_16_can_bear(self):
        most = binomial.most_tests(16, 0.01, 4)
        self.assertEqual(most, 163)
        self.assertEqual(binomial.order_index(16, 0.01 / 4 / most), 1)
        self.assertEqual(binomial.order_index(16, 0.01 / 4 / (most + 1)), 0)


class Tails(unittest.TestCase):
    def test_are_exact(self):
        self.assertEqual(binomial.lower_tail(4, 1), Fraction(5, 16))
        self.assertEqual(binomial.lower_tail(4, -1), 0)
        self.assertEqual(binomial.lower_tail(4, 9), 1)
        self.assertEqual(binomial.upper_tail(4, 3), Fraction(5, 16))
        self.assertEqual(binomial.upper_tail(4, 0), 1)
        self.assertEqual(binomial.upper_tail(4, 5), 0)

    def test_sum_up(self):
        for n, k in itertools.product(range(1, 20), range(-1, 21)):
            self.assertEqual(binomial.lower_tail(n, k) + binomial.upper_tail(n, k + 1), 1)


class Bounds(unittest.TestCase):
    def test_are_order_statistics(self):
        shuffled = [float(i) for i in range(1, 25)]
        random.Random(1).shuffle(shuffled)
        found = bounds.bounds_of(shuffled, 5e-5, 0.05)
        self.assertEqual((found.n, found.k, found.alpha), (24, 3, 5e-5))
        self.assertEqual((found.lower, found.estimate, found.upper), (3.0, 12.5, 22.0))
        # P(X <= 7) = 0.032, P(X <= 8) = 0.076
        self.assertEqual((found.pass_lower, found.pass_upper), (8.0, 17.0))

    def test_of_an_odd_number_have_the_middle_value_as_estimate(self):
        self.assertEqual(bounds.bounds_of([3.0, 1.0, 2.0], 0.2, 0.2).estimate, 2.0)

    def test_do_not_exist_for_too_few_values(self):
        found = bounds.bounds_of([1.0] * 14, 5e-5, 0.05)
        self.assertEqual((found.k, found.lower, found.upper), (0, None, None))
        self.assertEqual(bounds.bounds_of([1.0] * 4, 5e-5, 0.05).pass_upper, None)
        self.assertIsNone(bounds.bounds_of([], 5e-5, 0.05))

    def test_count_ties(self):
        self.assertEqual(bounds.bounds_of([0.0, 0.1, 0.0, -0.1], 0.5, 0.5).ties, 2)

    def test_hold_their_level(self):
        """The chance that the bound lies above the median, over all 2^n signs."""
        for n, alpha in ((6, 0.05), (9, 0.1), (11, 0.2)):
            wrong = 0
            for signs in itertools.product((-1.0, 1.0), repeat=n):
                wrong += bounds.bounds_of(list(signs), alpha, 0.05).lower > 0
            self.assertLessEqual(wrong / 2**n, alpha)
            self.assertEqual(Fraction(wrong, 2**n),
                             binomial.lower_tail(n, binomial.order_index(n, alpha) - 1))

    def test_exceed_a_threshold_exactly_when_the_p_value_is_small(self):
        rng = random.Random(7)
        for _ in range(300):
            n = rng.randint(5, 40)
            drawn = [round(rng.gauss(0.3, 1.0), 1) for _ in range(n)]
            found = bounds.bounds_of(drawn, 0.03, 0.05)
            p_value = bounds.sign_p_value(drawn, 0.0)
            self.assertEqual(found.lower is not None and found.lower > 0.0,
                             p_value <= Fraction(0.03), drawn)

    def test_drop_pairs_with_a_zero(self):
        self.assertIsNone(bounds.log_ratio(0.0, 1.0))
        self.assertIsNone(bounds.log_ratio(1.0, 0.0))
        self.assertEqual(bounds.log_ratio(2.0, 2.0), 0.0)
        self.assertAlmostEqual(bounds.log_ratio(1.0, 1.05), math.log(1.05))


class Spread(unittest.TestCase):
    def test_is_the_median_of_distances_to_the_median(self):
        self.assertEqual(bounds.mad([1.0, 2.0, 4.0, 8.0, 100.0]), 3.0)
        self.assertEqual(bounds.mad([1.0, 3.0]), 1.0)

    def test_of_normal_values_is_their_deviation(self):
        rng = random.Random(3)
        drawn = [rng.gauss(5.0, 2.0) for _ in range(20000)]
        self.assertAlmostEqual(bounds.robust_sd(drawn), 2.0, delta=0.06)


class Detectable(unittest.TestCase):
    def test_is_the_margin_and_the_way_from_bound_to_estimate(self):
        found = bounds.bounds_of([0.052] * 3 + [0.061] * 18 + [0.07] * 3, 5e-5, 0.05)
        self.assertEqual((found.lower, found.upper), (0.052, 0.07))
        self.assertAlmostEqual(bounds.detectable(found, 0.02), 0.029)

    def test_is_nothing_where_no_bound_is(self):
        self.assertIsNone(bounds.detectable(bounds.bounds_of([0.1] * 3, 5e-5, 0.05), 0.02))
        self.assertIsNone(bounds.detectable(None, 0.02))


class Margin(unittest.TestCase):
    def test_is_the_configured_one_by_default(self):
        self.assertEqual(margins.margin_of(0.02, None, 0.0, None), LN102)

    def test_follows_the_noise_of_the_benchmark(self):
        self.assertEqual(margins.margin_of(0.02, 0.01, 0.0, 10.0), 0.03)
        self.assertEqual(margins.margin_of(0.02, 0.001, 0.0, 10.0), LN102)

    def test_follows_the_least_time_of_interest(self):
        self.assertAlmostEqual(margins.margin_of(0.02, None, 1.0, 10.0), math.log(1.1))
        self.assertEqual(margins.margin_of(0.02, None, 1.0, 1000.0), LN102)
        self.assertEqual(margins.margin_of(0.02, 0.05, 1.0, 10.0), 3 * 0.05)
        self.assertEqual(margins.margin_of(0.02, None, 1.0, 0.0), LN102)


class Holm(unittest.TestCase):
    def rejected(self, p_values, alpha, family):
        exact = [Fraction(p) for p in p_values]
        levels = holm.holm_levels(exact, alpha, family)
        return [p <= Fraction(level) for p, level in zip(exact, levels)], levels

    def test_gives_the_textbook_example(self):
        found, _ = self.rejected([0.01, 0.04, 0.03, 0.005], 0.05, 4)
        self.assertEqual(found, [True, False, False, True])

    def test_is_bonferroni_when_nothing_is_rejected(self):
        found, levels = self.rejected([0.02, 0.9], 0.05, 5)
        self.assertEqual((found, levels), ([False, False], [0.01, 0.01]))

    def test_takes_each_rejection_out_of_the_family(self):
        _, levels = self.rejected([0.001, 0.9, 0.012], 0.05, 5)
        self.assertEqual(levels, [0.01, 0.05 / 3, 0.0125])

    def test_rejects_all_if_all_are_small(self):
        found, levels = self.rejected([0.001, 0.001], 0.05, 2)
        self.assertEqual(found, [True, True])
        self.assertEqual(sorted(levels), [0.025, 0.05])

    def test_agrees_with_adjusted_p_values(self):
        rng = random.Random(11)
        for _ in range(300):
            p_values = [rng.random() ** 3 for _ in range(rng.randint(1, 8))]
            found, _ = self.rejected(p_values, 0.05, len(p_values))
            adjusted, largest = {}, 0.0
            for rank, i in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
                largest = max(largest, (len(p_values) - rank) * p_values[i])
                adjusted[i] = largest
            self.assertEqual(found, [adjusted[i] <= 0.05 for i in range(len(p_values))])

    def test_rejects_what_meets_its_level_exactly(self):
        exact = [Fraction(1, 8), Fraction(1, 4)]
        self.assertEqual(holm.holm_levels(exact, 0.25, 2), [0.125, 0.25])
        self.assertEqual(holm.holm_levels(exact, 0.25, 3), [0.25 / 3, 0.25 / 3])

    def test_of_nothing_is_nothing(self):
        self.assertEqual(holm.holm_levels([], 0.05, 3), [])


class Unpaired(unittest.TestCase):
    def test_counts_all_orders(self):
        for m, n in ((1, 1), (3, 4), (5, 2), (6, 6)):
            by_hand = [0] * (m * n + 1)
            for chosen in itertools.combinations(range(m + n), m):
                by_hand[sum(place - rank for rank, place in enumerate(chosen))] += 1
            self.assertEqual(list(ranksum.rank_sum_counts(m, n)), by_hand)

    def test_gives_the_published_critical_values(self):
        published = {(4, 4): 0, (5, 5): 2, (7, 8): 10, (8, 8): 13, (10, 10): 23, (20, 20): 127}
        for (m, n), critical in published.items():
            self.assertEqual(ranksum.rank_sum_index(m, n, 0.025) - 1, critical, (m, n))

    def test_is_approximated_within_a_rank_for_large_samples(self):
        product = ranksum.EXACT_PRODUCT
        for m, n, alpha in ((50, 50, 0.025), (40, 60, 0.001), (50, 50, 1e-4)):
            try:
                ranksum.EXACT_PRODUCT = m * n
                exact = ranksum.rank_sum_index(m, n, alpha)
                ranksum.EXACT_PRODUCT = 0
                near = ranksum.rank_sum_index(m, n, alpha)
            finally:
                ranksum.EXACT_PRODUCT = product
            self.assertLessEqual(abs(near - exact), exact // 50, (m, n, alpha))

    def test_has_ranks_of_all_differences_as_bounds(self):
        base, head = [1.0, 1.01, 1.02, 1.03, 1.04], [1.1, 1.11, 1.12, 1.13, 1.14]
        found = ranksum.unpaired_bounds(base, head, 0.025, 0.05)
        shifts = sorted(math.log(h) - math.log(b) for b in base for h in head)
        self.assertEqual((found.n, found.k), (5, 3))
        self.assertEqual((found.lower, found.estimate, found.upper), (shifts[2], shifts[12], shifts[22]))
        # P(U <= 4) = 0.048, P(U <= 5) = 0.075
        self.assertEqual((found.pass_lower, found.pass_upper), (shifts[4], shifts[20]))

    def test_takes_a_chance_that_is_met_exactly(self):
        self.assertEqual(ranksum.rank_sum_index(1, 1, 0.5), 1)
        self.assertEqual(ranksum.rank_sum_index(1, 1, 0.49), 0)

    def test_takes_times_below_one_and_counts_the_smaller_sample(self):
        found = ranksum.unpaired_bounds([0.5] * 9, [0.25] * 4, 0.05, 0.05)
        self.assertEqual(found.n, 4)
        self.assertAlmostEqual(found.estimate, math.log(0.5))

    def test_drops_zeros_and_counts_ties(self):
        self.assertIsNone(ranksum.unpaired_bounds([0.0], [1.0], 0.05, 0.05))
        self.assertIsNone(ranksum.unpaired_bounds([1.0], [], 0.05, 0.05))
        found = ranksum.unpaired_bounds([1.0, 2.0], [2.0, 4.0], 0.05, 0.05)
        self.assertEqual((found.ties, found.k, found.lower), (1, 0, None))
        self.assertIsNone(found.pass_upper)

    def test_holds_its_level(self):
        """Over all orders of 4 and 5 values without a difference."""
        wrong = total = 0
        for chosen in itertools.combinations(range(9), 4):
            base = [math.exp(0.01 * place) for place in chosen]
            head = [math.exp(0.01 * place) for place in range(9) if place not in chosen]
            wrong += ranksum.unpaired_bounds(base, head, 0.1, 0.1).lower > 1e-12
            total += 1
        self.assertLessEqual(wrong / total, 0.1)
        self.assertGreater(wrong / total, 0.04)


if __name__ == "__main__":
    unittest.main()
