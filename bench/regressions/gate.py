"""The arms of the gate as tools/perfgate has them, each as (base, head, rows) -> (finding, noticed)."""

import json
import pathlib
import subprocess
import sys
import tempfile

GATE = pathlib.Path(__file__).resolve().parent.parent.parent / "tools" / "perfgate"
# The exit codes of a regression, and of another result.
RED, BROKEN = 1, 4
BUDGET_S = 240.0


def is_there():
    """Whether this tree's gate measures."""
    if not (GATE / "__main__.py").exists():
        return False
    return subprocess.run([sys.executable, str(GATE), "run", "--help"], check=False,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def configuration(pattern, arm):
    return {"filter": pattern, "instructions": arm == "instructions", "budget_s": BUDGET_S,
            # Others may use this machine: they must not be taken for a change, nor hide one.
            "noise_policy": "warn", "metric": "processor_ns", "instruction_max_ns": 1e8,
            "environment": {"HEDGEROW_SIMD": "avx2"}, "allow_different": ["index_bits"]}


def report_of(base, head, pattern, arm):
    """The exit code, the report (none if there is none), and what was said."""
    with tempfile.TemporaryDirectory() as folder:
        config = pathlib.Path(folder) / "gate.json"
        config.write_text(json.dumps(configuration(pattern, arm)), encoding="utf-8")
        out = pathlib.Path(folder) / "out"
        ran = subprocess.run([sys.executable, str(GATE), "run", "--base", str(base), "--head", str(head),
                              "--config", str(config), "--out", str(out)], check=False, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        file = out / "report.json"
        report = json.loads(file.read_text(encoding="utf-8")) if file.exists() else None
    return ran.returncode, report, (ran.stdout + ran.stderr).strip()


def red_arms(row):
    """The arms that are red on one benchmark, and in which words."""
    found = {finding["arm"]: finding["text"] for finding in row["findings"] if finding["is_red"]}
    if row["verdict"] == "REGRESSION" and row["confirmation"] is not None:
        found["time"] = f"{row['ratio'] - 1:+.1%} time, at least {row['lower'] - 1:+.1%}, n={row['n']}"
    return found


def arm_of(arm):
    def judge(base, head, pattern):
        code, report, said = report_of(base, head, pattern, arm)
        if report is None:
            return f"the gate ended with {code}: {said[-400:]}", False
        for row in report["benchmarks"]:
            found = red_arms(row)
            if arm in found:
                expected = BROKEN if "result" in found else RED
                return f"{row['name']}: {found[arm]}; exit {code}", code == expected
        verdicts = ", ".join(f"{row['name']} {row['verdict']}" for row in report["benchmarks"])
        return f"exit {code}: {verdicts or said[-400:]}", False
    return judge


ARMS = {arm: arm_of(arm) for arm in ("time", "instructions", "memory", "result")}
