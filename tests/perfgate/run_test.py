#!/usr/bin/env python3
"""Who is called when, how many pairs there are, how a run ends, and what it says."""

import random
import re
import sys
import unittest

import support  # noqa: F401  (puts the package on the path)
from runner import GateTest

def wild(seed):
    """Times all over the place, so that no number of pairs here decides anything."""
    draw = random.Random(seed)
    return [draw.uniform(60, 140) for _ in range(300)]


FAST = {"sample_ms": 0.001, "epochs": 5}


class Protocol(GateTest):
    def test_pairs_come_in_blocks_that_cancel_drift(self):
        ran = self.run_gate(*self.programs({"a": 100, "b": 200}, {"a": 100, "b": 200}),
                            *self.config(**FAST))
        self.assert_ends(ran, 0)
        orders = {"a": [], "b": []}
        calls = self.pair_calls()
        for first, second in zip(calls[::2], calls[1::2]):
            self.assertEqual(first[1], second[1], "a pair is of one benchmark")
            orders[first[1]].append(first[0][0] + second[0][0])
        for name, found in orders.items():
            self.assertEqual(len(found), 16, name)
            for one, two in zip(found[::2], found[1::2]):
                self.assertEqual({one, two}, {"bh", "hb"}, "each block has both orders")
            self.assertEqual(set(found[::2]), {"bh", "hb"}, "which comes first is drawn")
            pairs = self.row(name)["pairs"]
            self.assertEqual([{"AB": "bh", "BA": "hb"}[pair[0]] for pair in pairs], found)

    def test_every_sample_is_a_process_of_its_own_with_the_same_iterations(self):
        ran = self.run_gate(*self.programs({"a": 100}, {"a": 100}),
                            *self.config(sample_ms=0.05, epochs=5))
        self.assert_ends(ran, 0)
        calls = self.pair_calls()
        self.assertEqual(len(calls), 32)
        self.assertEqual(len({call[5] for call in calls}), 32, "one process each")
        self.assertEqual({call[3] for call in calls}, {6}, "a warm-up and five epochs")
        # Calibrated on the base: 50 us are 500 iterations of 100 ns.
        self.assertEqual({call[2] for call in calls}, {500})
        self.assertGreater(len({call[4] for call in calls}), 16, "the stack is moved about")
        self.assertTrue(all(0 <= call[4] <= 4096 for call in calls))

    def test_the_same_seed_gives_the_same_order_and_another_does_not(self):
        def schedule(seed):
            self.log.unlink(missing_ok=True)
            arguments = self.programs({"a": 1, "b": 2, "c": 3}, {"a": 1, "b": 2, "c": 3})
            for side in ("base", "head"):
                (self.folder / f"{side}.calls").unlink(missing_ok=True)
            # Eight pairs of each of three: no two of so many orders are the same by chance.
            ran = self.gate("run", "--out", self.out, "--no-probe", "--seed", seed, *arguments,
                            *self.config(looks=[8], **FAST))
            self.assert_ends(ran, 0)
            return [call[:2] + [call[4]] for call in self.pair_calls()]
        self.assertEqual(schedule(11), schedule(11))
        self.assertNotEqual(schedule(11), schedule(12))

    def test_what_is_decided_stops_and_the_rest_goes_on(self):
        # Spread over 60 %: nothing can be said of it, while "calm" is proven equal at the first look.
        ran = self.run_gate(*self.programs({"calm": 100, "wild": wild(1)}, {"calm": 100, "wild": wild(2)}),
                            *self.config(**FAST))
        self.assert_ends(ran, 0)
        self.assertEqual(self.row("calm")["n"], 16)
        self.assertEqual(self.row("wild")["n"], 96)
        self.assertIn(self.row("wild")["verdict"], ("INCONCLUSIVE", "UNSTABLE"))

    def test_looks_are_those_of_the_configuration(self):
        ran = self.run_gate(*self.programs({"a": wild(1)}, {"a": wild(2)}),
                            *self.config(looks=[8, 12], **FAST))
        self.assert_ends(ran, 0)
        self.assertEqual(len(self.row("a")["pairs"]), 12)

    def test_other_ways_to_ask_for_iterations(self):
        for way, note in (("times", "iterations are set by --benchmark_min_time=Nx"),
                          ("time", "weaker: the programs take no number of iterations")):
            ran = self.run_gate(*self.programs({"a": 100}, {"a": 100}, way=way), *self.config(**FAST))
            self.assert_ends(ran, 0, note)
        self.assertEqual({call[2] for call in self.pair_calls()[-32:]}, {None})

    def test_the_budget_ends_the_sampling_and_says_so(self):
        # Sixty benchmarks cannot have sixteen pairs each in a second.
        names = {f"n{i}": 100 for i in range(60)}
        ran = self.run_gate(*self.programs(names, names), *self.config(budget_s=1, **FAST))
        self.assert_ends(ran, 0, "benchmarks were left out by chance")
        left_out = [row for row in self.report()["benchmarks"] if row["state"] == "skipped"]
        self.assertGreater(len(left_out), 30)
        self.assertEqual(left_out[0]["verdict"], "INCONCLUSIVE")

    def test_quick_takes_one_look_and_says_what_it_is(self):
        ran = self.run_gate("--quick", *self.programs({"a": wild(1)}, {"a": wild(2)}),
                            *self.config(**FAST))
        self.assert_ends(ran, 0, "screening only")
        self.assertEqual(len(self.row("a")["pairs"]), 16)


class Verdicts(GateTest):
    def test_a_slowdown_is_red_confirmed_and_told(self):
        ran = self.run_gate(*self.programs({"a/b/1M": 100, "c": 50}, {"a/b/1M": 110, "c": 50}),
                            *self.config(**FAST))
        self.assert_ends(ran, 1, "REGRESSION: 1 benchmark of 2 regressed")
        line = next(x for x in ran.stdout.splitlines() if x.startswith("REGRESSION a/b/1M"))
        self.assertRegex(line, r"\+10\.0% \[\+10\.0%,\+10\.0%\]  p<\S+  n=16  base 100 ns")
        self.assertRegex(line, r"\(margin 2\.0%, could detect \+\d\.\d%\)")
        self.assertRegex(ran.stdout, r"again: perfgate run .*--filter '\^a/b/1M\$' --seed 7")
        self.assertEqual(len(self.row("a/b/1M")["fresh"]), 30)
        self.assertEqual(self.row("a/b/1M")["confirmation"], "confirmed")
        self.assertEqual(self.row("c")["verdict"], "EQUIVALENT")

    def test_a_slowdown_that_does_not_come_again_is_no_regression(self):
        # Two processes list and detect, one calibrates; then 16 pairs are slow and the rest are not.
        slow = [100] * 3 + [110] * 16 + [100] * 60
        ran = self.run_gate(*self.programs({"a": 100}, {"a": slow}), *self.config(looks=[16], **FAST))
        self.assert_ends(ran, 0, "30 fresh pairs do not show it again")
        self.assertEqual(self.row("a")["verdict"], "INCONCLUSIVE")
        self.assertEqual(self.row("a")["confirmation"], "not reproduced")

    def test_a_slowdown_of_one_layout_only_is_a_warning(self):
        arguments = self.programs({"a": 100}, {"a": 110})
        layouts = [{"name": "other", "base": self.program("base2", {"a": 100}),
                    "head": self.program("head2", {"a": 100})}]
        ran = self.run_gate(*arguments, *self.config(layouts=layouts, **FAST))
        self.assert_ends(ran, 0, "LAYOUT_SENSITIVE a", "linked in another layout")
        again = self.config(layouts=[{**layouts[0], "head": self.program("head3", {"a": 111})}], **FAST)
        self.assert_ends(self.run_gate(*arguments, *again), 1, "REGRESSION a")

    def test_improvements_are_named_and_never_red(self):
        ran = self.run_gate(*self.programs({"a": 100}, {"a": 80}), *self.config(**FAST))
        self.assert_ends(ran, 0, "IMPROVEMENT a  -20.0%")

    def test_the_exact_margin_is_no_regression(self):
        ran = self.run_gate(*self.programs({"a": 100}, {"a": 102}), *self.config(**FAST))
        self.assert_ends(ran, 0)
        self.assertNotEqual(self.row("a")["verdict"], "REGRESSION")
        ran = self.run_gate(*self.programs({"a": 100}, {"a": 102}), *self.config(margin=0.01, **FAST))
        self.assert_ends(ran, 1, "REGRESSION a")

    def test_small_slowdowns_of_a_whole_suite_add_up(self):
        names = [f"n{i}" for i in range(4)]
        base, head = {name: 1000 for name in names}, {name: 1030 for name in names}
        # Each has a margin of 5 %, their mean one of 2 %.
        ran = self.run_gate(*self.programs(base, head), *self.config(margin=0.05, **FAST))
        self.assert_ends(ran, 1, "SMALL_SLOWDOWN n0", "suite all: mean of 4 +3.0%")
        self.assertTrue(self.report()["suite"]["is_red"])

    def test_what_takes_no_time_is_not_divided_by(self):
        ran = self.run_gate(*self.programs({"a": 0}, {"a": 0}), *self.config(**FAST))
        self.assert_ends(ran, 0)
        self.assertEqual(self.row("a")["verdict"], "INCONCLUSIVE")

    def test_informational_benchmarks_are_shown_and_not_judged(self):
        ran = self.run_gate(*self.programs({"a": 100, "b": 1}, {"a": 150, "b": 1}),
                            *self.config(informational=["^a$"], **FAST))
        self.assert_ends(ran, 0, "+50.0%")

    def test_strict_is_not_content_with_what_is_undecided(self):
        arguments = (*self.programs({"a": wild(1)}, {"a": wild(2)}), *self.config(looks=[16], **FAST))
        self.assert_ends(self.run_gate(*arguments), 0)
        self.assert_ends(self.run_gate("--strict", *arguments), 5)

    def test_the_same_machine_code_is_not_timed(self):
        # The interpreter is a program with machine code; what it runs is an argument of both.
        script = self.program("script", {"a": 100})
        both = ("--base", sys.executable, "--head", sys.executable,
                *self.config(arguments=[script], **FAST))
        self.assert_ends(self.run_gate(*both), 0, "IDENTICAL")
        self.assertEqual(self.row("a")["verdict"], "IDENTICAL")
        self.assertEqual(self.pair_calls(), [])
        self.assert_ends(self.run_gate("--aa", *both), 0)
        self.assertEqual((self.row("a")["verdict"], self.row("a")["n"]), ("EQUIVALENT", 16))


class Arms(GateTest):
    def test_another_result_is_an_error_whatever_the_time(self):
        ran = self.run_gate(*self.programs({"a": {"ns": 100, "digest": 7 << 32 | 1}},
                                           {"a": {"ns": 50, "digest": 7 << 32 | 2}}),
                            *self.config(**FAST))
        self.assert_ends(ran, 4, "a different result: checksum 0000000700000001 to 0000000700000002")

    def test_a_result_that_changes_from_process_to_process_is_an_error(self):
        changing = {str(i): {"digest_hi": 0, "digest_lo": i} for i in range(200)}
        ran = self.run_gate(*self.programs({"a": {"ns": 100, "digest": 1}},
                                           {"a": {"ns": 100, "digest": 1, "changing": changing}}),
                            *self.config(**FAST))
        # "changing" is overridden by "digest" in the stand-in, so say it by counters alone.
        self.assert_ends(ran, 0)
        ran = self.run_gate(*self.programs({"a": {"ns": 100, "counters": {"digest_hi": 0, "digest_lo": 1}}},
                                           {"a": {"ns": 100, "changing": changing}}), *self.config(**FAST))
        self.assert_ends(ran, 4, "different results in different processes")

    def test_allocations_count_exactly(self):
        def programs(before, after):
            return self.programs({"a": {"ns": 100, "counters": {"allocs": before}}},
                                 {"a": {"ns": 100, "counters": {"allocs": after}}})
        self.assert_ends(self.run_gate(*programs(3, 4), *self.config(**FAST)), 1, "3 to 4 allocations")
        self.assert_ends(self.run_gate(*programs(4, 3), *self.config(**FAST)), 0)
        self.assertEqual([finding["text"] for finding in self.row("a")["findings"]],
                         ["4 to 3 allocations"])
        self.assert_ends(self.run_gate(*programs(1, 1), *self.config(frame_path=["^a$"], **FAST)), 1,
                         "1 allocations on the frame path")

    def test_bytes_of_the_structure_count_exactly(self):
        ran = self.run_gate(*self.programs({"a": {"ns": 9, "counters": {"bytes_per_halfedge": 8.67}}},
                                           {"a": {"ns": 9, "counters": {"bytes_per_halfedge": 8.68}}}),
                            *self.config(**FAST))
        self.assert_ends(ran, 1, "8.67 to 8.68 bytes per half-edge")

    def test_peak_memory_grows_by_more_than_a_margin(self):
        def programs(after):
            return self.programs({"a": {"ns": 9, "counters": {"peak_bytes": 100e6}}},
                                 {"a": {"ns": 9, "counters": {"peak_bytes": after}}})
        self.assert_ends(self.run_gate(*programs(101e6), *self.config(**FAST)), 0)
        self.assert_ends(self.run_gate(*programs(103e6), *self.config(**FAST)), 1,
                         "peak resident size 100.0 to 103.0 MB")


class Exceptions(GateTest):
    WAIVER = {"benchmark": "^a$", "reason": "a check that was missing", "owner": "ada",
              "expires": "2999-01-01", "max_ratio": 1.15}

    def test_a_waiver_turns_red_into_waived_up_to_its_ratio(self):
        for after, code, word in ((110, 0, "WAIVED a"), (120, 1, "beyond the waiver's 1.150")):
            ran = self.run_gate(*self.programs({"a": 100}, {"a": after}),
                                *self.config(waivers=[self.WAIVER], **FAST))
            self.assert_ends(ran, code, word, "ada")

    def test_a_waiver_past_its_date_is_an_error(self):
        waiver = {**self.WAIVER, "expires": "2020-02-02"}
        ran = self.run_gate(*self.programs({"a": 100}, {"a": 100}), *self.config(waivers=[waiver]))
        self.assert_ends(ran, 2, "2020-02-02", "ada")

    def test_a_benchmark_that_vanishes_must_be_declared(self):
        arguments = self.programs({"a": 100, "b": 100}, {"a": 100, "c": 100})
        self.assert_ends(self.run_gate(*arguments, *self.config(**FAST)), 4, "ERROR b",
                         "does not declare it", "NEW c")
        self.assert_ends(self.run_gate(*arguments, *self.config(removed=["b"], **FAST)), 0, "REMOVED b")
        self.assert_ends(self.run_gate(*arguments, *self.config(renamed={"b": "c"}, **FAST)), 0)


class Text(GateTest):
    def test_the_first_line_is_the_verdict_and_what_could_be_seen(self):
        ran = self.run_gate(*self.programs({"a": 100}, {"a": 100}), *self.config(**FAST))
        self.assertRegex(ran.stdout.splitlines()[0], r"^OK: .*could be seen")
        self.assertEqual(ran.stdout.splitlines()[-1], "exit 0")
        self.assertEqual(ran.stderr, "", "progress is for terminals")

    def test_every_command_has_help_with_an_example(self):
        for command in ("run", "analyze", "aa", "host", "history", "simulate"):
            ran = self.gate(command, "--help")
            self.assert_ends(ran, 0)
            self.assertTrue(re.search(r"perfgate", ran.stdout), command)


if __name__ == "__main__":
    unittest.main()
