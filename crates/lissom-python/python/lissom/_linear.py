"""The linear model at a state: sparse matrices, and first-order equations."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

from ._tables import Files, Table, full, scipy, sparse
from ._types import Array


class StateSpace(NamedTuple):
    """Matrices of `x' = A x + B u`, `y = C x + D u`."""

    #: Of shape (states, states).
    A: Array
    #: Of shape (states, inputs).
    B: Array
    #: Of shape (outputs, states).
    C: Array
    #: Of shape (outputs, inputs).
    D: Array


class LinearModel:
    """A model linearised about a state, made by `Model.linearize` and `Simulation.linearize`.

    ```text
    M q̈ + D q̇ + K q + Gᵀ λ = F u,    G q = 0,    y = C_q q + C_v q̇ + C_a q̈ + C_λ λ + C_u u
    ```

    Matrices are `scipy.sparse.csr_matrix`, in SI units. `q` has `coordinates` entries, the displacement and rotation of each node
    in its own axes [m, rad] and the other coordinates of the model; `unknowns` names them, then the multipliers.
    """

    def __init__(self, texts: dict[str, str], summary: dict[str, Any], warnings: list[str]) -> None:
        self._texts = texts
        #: The facts of `summary.json`.
        self.summary = summary
        #: Warnings.
        self.warnings = warnings
        #: The rows: columns `row` (from 1), `unknown`, `unit`.
        self.unknowns = Table._of(texts["unknowns.csv"])
        #: Number of coordinates.
        self.coordinates = int(summary["unknowns"]) - int(summary["multipliers"])
        #: Number of multipliers.
        self.multipliers = int(summary["multipliers"])
        #: Names of the inputs, the columns of `F`.
        self.inputs: list[str] = list(summary["inputs"])
        #: Names of the output columns, the rows of output matrices.
        self.outputs: list[str] = list(summary["outputs"])

    @classmethod
    def _of(cls, files: list[tuple[str, str]], summary: str, warnings: list[str]) -> LinearModel:
        return cls(dict(files), json.loads(summary), warnings)

    @property
    def M(self) -> Any:
        """Mass: derivative of the forces by accelerations, of shape (coordinates, coordinates)."""
        return sparse(self._texts["M.mtx"])

    @property
    def D(self) -> Any:
        """Damping and gyroscopic terms: derivative of the forces by velocities, of shape (coordinates, coordinates)."""
        return sparse(self._texts["D.mtx"])

    @property
    def K(self) -> Any:
        """Stiffness, that of stresses and constraint forces included, of shape (coordinates, coordinates)."""
        return sparse(self._texts["K.mtx"])

    @property
    def G(self) -> Any:
        """Gradient of the constraints, of shape (multipliers, coordinates)."""
        return sparse(self._texts["G.mtx"])

    @property
    def F(self) -> Any:
        """Right-hand sides for unit inputs, those of the constraints last; shape (coordinates + multipliers, inputs)."""
        if "inputs.mtx" not in self._texts:
            return scipy("sparse").csr_matrix((self.coordinates + self.multipliers, 0))
        return sparse(self._texts["inputs.mtx"])

    @property
    def B(self) -> Any:
        """The same as `F`: the input matrix of the second-order equations. That of first order is `state_space.B`."""
        return self.F

    def output_matrix(self, by: str) -> Any:
        """Outputs by `place`, `rate`, `acceleration` (columns: coordinates), `multiplier` (multipliers) or `input`."""
        if by not in ("place", "rate", "acceleration", "multiplier", "input"):
            raise ValueError(f"outputs depend on place, rate, acceleration, multiplier and input, not on `{by}`")
        text = self._texts.get(f"outputs-{by}.mtx")
        if text is None:
            sizes = {"multiplier": self.multipliers, "input": len(self.inputs)}
            return scipy("sparse").csr_matrix((len(self.outputs), sizes.get(by, self.coordinates)))
        return scipy("sparse").csr_matrix(full(text)) if by == "input" else sparse(text)

    @property
    def states(self) -> list[str]:
        """Names of the states x of the first-order equations."""
        self._refuse_without_state_space()
        return [str(name) for name in Table._of(self._texts["states.csv"])["state"]]

    @property
    def state_space(self) -> StateSpace:
        """First-order equations without constraints, for `scipy.signal.StateSpace(*linear.state_space)`.

        Raises:
            ValueError: if there are none, as for models of more than 600 coordinates; with the reason.
        """
        self._refuse_without_state_space()
        return StateSpace(*(full(self._texts[f"state-space-{name}.mtx"]) for name in "ABCD"))

    def _refuse_without_state_space(self) -> None:
        if "states.csv" not in self._texts:
            raise ValueError(f"there are no first-order equations: {self.summary['without_state_space']}")

    def __repr__(self) -> str:
        about = self.summary["about"]
        return (
            f"<lissom.LinearModel about {about}: {self.coordinates} coordinates, {self.multipliers} multipliers, "
            f"{len(self.inputs)} inputs, {len(self.outputs)} outputs>"
        )


def linear_model(files: Files) -> LinearModel:
    """From the result of the compiled part."""
    return LinearModel._of(*files)
