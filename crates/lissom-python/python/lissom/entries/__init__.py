"""What a model is made of, as classes: `Body(mass=2, …)`, `joints.Revolute(base="ground", tip="rod", axis=[0, 0, 1])`.

Every class stands for an entry of a model file and has its keys as keyword arguments; `print` shows the TOML it means. Keys that
are words of Python get a line below: `from_`, `in_`. Wherever a number stands a text may stand instead: an expression.
"""

from . import analyses, contacts, feedback, joints, loads, motions, outputs, parts, sections, springs
from ._entry import Entry
from .contacts import Contact, Ground
from .feedback import Event, State, Unit
from .motions import Initial, PartMotion
from .parts import Beam, Body, Part, PointMass
from .sections import Material

__all__ = [
    "Beam",
    "Body",
    "Contact",
    "Entry",
    "Event",
    "Ground",
    "Initial",
    "Material",
    "Part",
    "PartMotion",
    "PointMass",
    "State",
    "Unit",
    "analyses",
    "contacts",
    "feedback",
    "joints",
    "loads",
    "motions",
    "outputs",
    "parts",
    "sections",
    "springs",
]
