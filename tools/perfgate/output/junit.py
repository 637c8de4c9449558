"""The report as JUnit XML: a test case for each benchmark and each suite."""

from __future__ import annotations

import re
from typing import Any, Mapping
from xml.etree import ElementTree

from . import words

# What XML 1.0 cannot hold, escaped or not.
FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def clean(text: str) -> str:
    return FORBIDDEN.sub("?", text)


def add_case(suite: ElementTree.Element, row: Mapping[str, Any], again: str) -> None:
    case = ElementTree.SubElement(suite, "testcase", classname="perfgate", name=clean(row["name"]),
                                  time=f"{(row['head_ns'] or 0.0) / 1e9:.9f}")
    message = clean(words.line(row))
    if words.is_failure(row):
        kind = "failure" if row["verdict"] == "REGRESSION" else "error"
        found = ElementTree.SubElement(case, kind, type=row["verdict"], message=message)
        found.text = f"{message}\nagain: {clean(again)}\n"
    elif row["verdict"] == "INCONCLUSIVE" and row["n"] == 0:
        ElementTree.SubElement(case, "skipped", message=message)
    else:
        ElementTree.SubElement(case, "system-out").text = message


def junit(report: Mapping[str, Any]) -> str:
    rows = report["benchmarks"]
    suites = report["suites"]
    failures = [row for row in rows if words.is_failure(row)]
    errors = sum(1 for row in failures if row["verdict"] == "ERROR")
    red_suites = sum(1 for suite in suites if suite["is_red"])
    skipped = sum(1 for row in rows if row["verdict"] == "INCONCLUSIVE" and row["n"] == 0
                  and not words.is_failure(row))
    root = ElementTree.Element("testsuites", name="perfgate")
    suite = ElementTree.SubElement(
        root, "testsuite", name="perfgate", tests=str(len(rows) + len(suites)),
        failures=str(len(failures) - errors + red_suites), errors=str(errors),
        skipped=str(skipped), timestamp=clean(report["started"]))
    properties = ElementTree.SubElement(suite, "properties")
    ElementTree.SubElement(properties, "property", name="headline", value=clean(report["headline"]))
    for row in rows:
        add_case(suite, row, words.reproduce(report, row))
    for mean in suites:
        case = ElementTree.SubElement(suite, "testcase", classname="perfgate.suite",
                                      name=clean(mean["name"]), time="0")
        if mean["is_red"]:
            ElementTree.SubElement(case, "failure", type="REGRESSION",
                                   message=clean(words.suite_line(mean)))
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + \
        ElementTree.tostring(root, encoding="unicode") + "\n"
