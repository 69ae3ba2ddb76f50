"""Shared by the tests: the project's examples, and its command line where it is built."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(os.environ.get("LISSOM_ROOT") or Path(__file__).resolve().parents[3])
PENDULUM = str(ROOT / "examples" / "pendulum.toml")


@pytest.fixture
def program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """The command line. `LISSOM_PROGRAM` names it; without it what cargo has built is taken, if there is anything."""
    named = os.environ.get("LISSOM_PROGRAM")
    built = [ROOT / "target" / profile / "lissom" for profile in ("release", "debug")]
    found = [Path(named)] if named else [path for path in built if path.is_file()]
    if not found:
        pytest.skip("the command line is not built: cargo build --release")

    def run(*args: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run([str(found[0]), *map(str, args)], capture_output=True, text=True)

    return run
