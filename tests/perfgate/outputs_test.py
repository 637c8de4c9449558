#!/usr/bin/env python3
"""The files of a report: each is read the way its reader does, and a stored report can be judged again."""

import html.parser
import json
import unittest
from xml.etree import ElementTree

from runner import GateTest

FAST = {"sample_ms": 0.001, "epochs": 1, "looks": [10], "confirm_pairs": 6}
ODD = "K\u00e4se/\u6f22<b>|&\"\U0001f9c0"


class Page(html.parser.HTMLParser):
    """Which tags stay open, what is fetched, and how many pictures there are."""

    VOID = ("meta", "br", "rect", "line", "circle", "polyline", "path", "text")

    def __init__(self):
        super().__init__()
        self.open, self.fetched, self.pictures, self.text = [], [], 0, ""

    def handle_starttag(self, tag, attrs):
        self.fetched += [value for key, value in attrs if key in ("src", "href", "action")]
        self.pictures += tag == "svg"
        if tag != "meta":
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        while self.open and self.open[-1] != tag and self.open[-1] in ("tr", "td", "th"):
            self.open.pop()
        if not self.open or self.open.pop() != tag:
            raise AssertionError(f"</{tag}> closes nothing")

    def handle_data(self, data):
        self.text += data


class Outputs(GateTest):
    def run_mixed(self, **environment):
        """One of each: slower, equal, wrong, informational, gone."""
        base = {"slow": 100, ODD: 100, "wrong": {"ns": 9, "digest": 1}, "shown": 100, "gone": 1}
        head = {"slow": 107, ODD: 100, "wrong": {"ns": 9, "digest": 2}, "shown": 150, "fresh": 1}
        return self.run_gate(*self.programs(base, head), env=environment,
                             *self.config(informational=["shown"], **FAST))

    def read(self, name):
        return (self.out / name).read_text(encoding="utf-8")

    def test_all_files_are_there_and_no_other(self):
        self.assert_ends(self.run_mixed(), 4)
        self.assertEqual(sorted(path.name for path in self.out.iterdir()),
                         ["bencher.json", "junit.xml", "report.html", "report.json",
                          "smaller_is_better.json", "summary.md"])

    def test_the_report_has_all_raw_samples_and_says_what_follows(self):
        self.run_mixed()
        report = self.report()
        self.assertEqual((report["schema"], report["seed"], report["verdict"], report["exit"]),
                         (1, 7, "ERROR", 4))
        for key in ("tool", "started", "host", "base", "head", "config", "benchmarks", "suite"):
            self.assertIn(key, report)
        for key in ("cpu", "cores", "governor", "turbo", "load", "kernel"):
            self.assertIn(key, report["host"])
        for side in ("base", "head"):
            self.assertRegex(report[side]["exe_sha256"], "^[0-9a-f]{64}$")
        row = self.row("slow")
        self.assertEqual([pair[1:3] for pair in row["pairs"]], [[100, 107]] * 10)
        for key in ("verdict", "ratio", "lower", "upper", "n", "k", "alpha", "margin", "detectable",
                    "ties", "base_ns", "head_ns", "ir", "mem", "checksum", "layouts", "waiver"):
            self.assertIn(key, row)
        self.assertEqual(self.row("wrong")["checksum"], {"base": ["0" * 15 + "1"], "head": ["0" * 15 + "2"]})

    def test_a_report_judged_again_has_the_same_bytes(self):
        self.run_mixed()
        before = {path.name: path.read_bytes() for path in self.out.iterdir()}
        again = self.folder / "again"
        ran = self.gate("analyze", self.out / "report.json", "--out", again)
        self.assert_ends(ran, 4)
        self.assertEqual({path.name: path.read_bytes() for path in again.iterdir()}, before)
        twice = [self.gate("analyze", self.out / "report.json", "--json").stdout for _ in range(2)]
        self.assertEqual(twice[0], twice[1])
        self.assertEqual(twice[0].encode(), before["report.json"])

    def test_a_report_can_be_judged_by_another_margin(self):
        self.run_gate(*self.programs({"a": 100}, {"a": 107}), *self.config(**FAST))
        self.assert_ends(self.gate("analyze", self.out / "report.json"), 1, "REGRESSION a")
        self.assert_ends(self.gate("analyze", self.out / "report.json", "--margin", "0.08"), 0)

    def test_a_noisy_host_widens_the_margins_of_benchmarks_and_means(self):
        self.run_gate(*self.programs({"a": 100, "b": 100}, {"a": 107, "b": 107}), *self.config(**FAST))
        report = {**self.report(), "margin_floor": 0.1}
        self.assertEqual(report["exit"], 1)
        path = self.folder / "noisy.json"
        path.write_text(json.dumps(report))
        found = json.loads(self.gate("analyze", path, "--json").stdout)
        self.assertEqual(found["exit"], 0)
        self.assertAlmostEqual(found["suite"]["margin"], 1.1)

    def test_junit_has_a_case_for_each_and_says_why(self):
        self.run_mixed()
        suite = ElementTree.fromstring(self.read("junit.xml")).find("testsuite")
        cases = {case.get("name"): case for case in suite.findall("testcase")}
        self.assertEqual(int(suite.get("tests")), len(cases))
        self.assertEqual((suite.get("failures"), suite.get("errors")), ("2", "2"))
        failure = cases["slow"].find("failure")
        for word in ("+7.0%", "[+7.0%,+7.0%]", "n=10", "could detect"):
            self.assertIn(word, failure.get("message"))
        self.assertIn("--filter '^slow$' --seed 7", failure.text)
        self.assertIn("checksum", cases["wrong"].find("error").get("message"))
        self.assertIn("does not declare", cases["gone"].find("error").get("message"))
        self.assertEqual([child.tag for child in cases[ODD]], ["system-out"])
        self.assertEqual([child.tag for child in cases["shown"]], ["system-out"])

    def test_the_summary_fits_a_comment_and_opens_twenty_rows(self):
        names = {f"{'n' * 90}{i:03}": 100 for i in range(300)}
        slow = {name: 100 + (i % 7) for i, name in enumerate(names)}
        rows = [{"name": name, "run_type": "iteration", "iterations": 1, "real_time": time + j % 3,
                 "time_unit": "ns"} for name, time in names.items() for j in range(6)]
        for side, times in (("b", names), ("h", slow)):
            changed = [{**row, "real_time": row["real_time"] - 100 + times[row["name"]]} for row in rows]
            (self.folder / f"{side}.json").write_text(json.dumps({"benchmarks": changed}))
        self.run_gate("--base", self.folder / "b.json", "--head", self.folder / "h.json")
        text = self.read("summary.md")
        self.assertLess(len(text.encode()), 65000)
        opened = text[:text.index("<details>")]
        self.assertEqual(sum(line.startswith("| ") for line in opened.splitlines()), 21)
        self.assertIn("</details>", text)
        self.assertTrue(text.startswith("<!-- perfgate -->\n**"), "found again, and the verdict first")

    def test_names_do_not_break_the_summary(self):
        self.run_mixed()
        row = next(line for line in self.read("summary.md").splitlines() if "K\u00e4se" in line)
        self.assertEqual(row.replace("\\|", "").count("|"), 9)

    def test_the_page_is_whole_and_fetches_nothing(self):
        self.run_mixed()
        text = self.read("report.html")
        page = Page()
        page.feed(text)
        self.assertEqual(page.open, [])
        self.assertEqual(page.fetched, [])
        self.assertNotIn("<script", text)
        self.assertNotIn("url(", text)
        self.assertGreaterEqual(page.pictures, 6, "ratios and rounds of each that was measured")
        self.assertIn(ODD, page.text)
        for word in ("prefers-color-scheme: dark", "@media print", "viewport"):
            self.assertIn(word, text)

    def test_exporters(self):
        self.run_mixed()
        bencher = json.loads(self.read("bencher.json"))
        self.assertEqual(bencher["slow"]["latency"]["value"], 107)
        self.assertLessEqual(bencher["slow"]["latency"]["lower_value"], 107)
        self.assertIn("shown_bencher_ignore", bencher)
        smaller = {entry["name"]: entry for entry in json.loads(self.read("smaller_is_better.json"))}
        self.assertEqual((smaller["slow"]["value"], smaller["slow"]["unit"]), (107, "ns"))
        self.assertIn("REGRESSION", smaller["slow"]["extra"])

    def test_annotations_are_for_github_only(self):
        self.assertNotIn("::error", self.run_mixed().stdout)
        summary = self.folder / "step.md"
        ran = self.run_mixed(GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=str(summary))
        errors = [line for line in ran.stdout.splitlines() if line.startswith("::error")]
        self.assertEqual(len(errors), 4, ran.stdout)  # three benchmarks, and their mean
        self.assertTrue(any("slow" in line and "+7.0%" in line for line in errors))
        self.assertTrue(any(line.startswith("::warning") and "shown" in line
                            for line in ran.stdout.splitlines()))
        self.assertEqual(summary.read_text(encoding="utf-8"), self.read("summary.md"))


if __name__ == "__main__":
    unittest.main()
