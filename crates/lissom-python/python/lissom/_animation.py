"""The page that shows a moving model, in a cell of a notebook or as a file."""

from __future__ import annotations

import html
import os
from pathlib import Path


class Animation:
    """A self-contained HTML page, which requires no network. A notebook shows it in its cell."""

    def __init__(self, page: str, height: int = 600) -> None:
        #: The page.
        self.html = page
        #: Height of the cell [pixels].
        self.height = height

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file, for any browser."""
        Path(path).write_text(self.html, encoding="utf-8")

    def _repr_html_(self) -> str:
        page = html.escape(self.html)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: {self.height}px; border: 0"></iframe>'

    def __repr__(self) -> str:
        return f"<lissom.Animation, {len(self.html) / 1e6:.1f} MB: show it in a notebook, or `save` it>"
