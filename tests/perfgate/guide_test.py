#!/usr/bin/env python3
"""The guide says what the program does: every key with its default, every exit code and verdict."""

import dataclasses
import json
import unittest

from support import TOOLS
from perfgate.cli import COMMANDS
from perfgate.errors import MEANING
from perfgate.model.config import Config, config_of
from perfgate.model.verdicts import ORDER

FOLDER = TOOLS / "perfgate"
GUIDE = (FOLDER / "GUIDE.md").read_text(encoding="utf-8")


class Guide(unittest.TestCase):
    def test_has_every_key_with_its_default(self):
        found = [line.split(" | ")[:2] for line in GUIDE.splitlines() if line.startswith("| `")]
        told = {key.strip("| `"): value.strip("`") for key, value in found}
        for field in dataclasses.fields(Config):
            default = json.dumps(getattr(Config(), field.name))
            self.assertEqual(told.get(field.name), default, field.name)

    def test_has_every_exit_code_and_verdict_and_command(self):
        for code, meaning in MEANING.items():
            self.assertIn(f"| {code} | {meaning} |", GUIDE)
        for verdict in ORDER:
            self.assertIn(f"`{verdict}`", GUIDE)
        for name, _, _ in COMMANDS:
            self.assertIn(f"| `{name}", GUIDE)

    def test_template_is_a_configuration(self):
        table = json.loads((FOLDER / "template" / "perfgate.json").read_text(encoding="utf-8"))
        self.assertEqual(config_of(table, "template").build["executable"], "bench")


if __name__ == "__main__":
    unittest.main()
