"""Types of arguments and results of the compiled part."""

from __future__ import annotations

from typing import Optional

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

#: Times, names, units and values of all columns, summary as JSON.
Parts = tuple[Array, list[str], list[str], list[Array], str]

#: Member, state, collected values, time, steps, largest violation, diagnosis, histories as a Parquet file.
Outcome = tuple[int, str, list[float], Optional[float], int, Optional[float], Optional[str], Optional[bytes]]
