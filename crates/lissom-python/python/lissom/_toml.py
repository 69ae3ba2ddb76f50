"""Conversion of Python values to TOML for model and sweep files, and back."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def value(of: Any) -> str:
    """A value on one line. Numbers are reproduced to the last bit; a text remains a text, or an expression of the model."""
    if isinstance(of, np.generic):
        of = of.item()
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, int):
        return str(of)
    if isinstance(of, float):
        # `inf` and `nan` are valid in TOML; the model rejects them with its own message.
        return repr(of)
    if isinstance(of, str):
        return json.dumps(of, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(of, np.ndarray):
        return value(of.tolist())
    if hasattr(of, "to_table"):
        of = of.to_table()
    if isinstance(of, Mapping):
        return "{ " + ", ".join(f"{key(str(name))} = {value(inner)}" for name, inner in of.items()) + " }"
    if isinstance(of, Sequence):
        return "[" + ", ".join(value(inner) for inner in of) + "]"
    raise TypeError(f"a model holds numbers, texts, booleans, lists and tables, not {type(of).__name__}: {of!r}")


def key(name: str) -> str:
    """A key, in quotes where it needs them."""
    bare = name != "" and all(c.isascii() and (c.isalnum() or c in "_-") for c in name)
    return name if bare else value(name)


def overrides(changes: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Paths and TOML values."""
    return [(path, value(of)) for path, of in changes.items()]


def parse(text: str) -> dict[str, Any]:
    """A TOML text as dictionaries, lists and values."""
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib

    return tomllib.loads(text)
