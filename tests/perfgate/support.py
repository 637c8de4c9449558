"""What the tests of perfgate share: the package on the path."""

import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The tests of mutants point this at a changed copy.
TOOLS = pathlib.Path(os.environ.get("PERFGATE_TOOLS", str(ROOT / "tools")))
sys.path.insert(0, str(TOOLS))
