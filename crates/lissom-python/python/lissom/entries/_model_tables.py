# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""The tables of a model, and the classes of their entries."""

from __future__ import annotations

from typing import Any

from . import sections, parts, joints, springs, loads, contacts, feedback, hydraulics, motions, outputs, analyses
from ._entry import Entry, ModelTree
from .sections import Material, Section
from .parts import Beam, Shell, Solid, Body, PointMass, Superelement, Part
from .joints import Joint
from .springs import Spring
from .loads import Load, LocalLoad
from .contacts import Contact, Ground
from .feedback import State, Event, Unit
from .hydraulics import Fluid, HydraulicPart
from .motions import Initial
from .outputs import Output
from .analyses import Analysis

#: The classes of the entries of a table: one, or several by the word that chooses.
CLASSES: dict[str, type[Entry] | dict[str, type[Entry]]] = {
    "materials": sections.Material,
    "sections": {
        "rectangle": sections.Rectangle,
        "circle": sections.Circle,
        "tube": sections.Tube,
        "general": sections.General,
    },
    "parts": parts.Part,
    "beams": parts.Beam,
    "shells": parts.Shell,
    "solids": parts.Solid,
    "bodies": parts.Body,
    "point_masses": parts.PointMass,
    "superelements": parts.Superelement,
    "joints": {
        "cam": joints.Cam,
        "clamp": joints.Clamp,
        "constant_velocity": joints.ConstantVelocity,
        "cylindrical": joints.Cylindrical,
        "distance": joints.Distance,
        "equation": joints.Equation,
        "gear": joints.Gear,
        "generalized_coordinates": joints.GeneralizedCoordinates,
        "generic": joints.Generic,
        "inline": joints.Inline,
        "mean_motion": joints.MeanMotion,
        "parallel_axes": joints.ParallelAxes,
        "perpendicular_axes": joints.PerpendicularAxes,
        "planar": joints.Planar,
        "point_in_plane": joints.PointInPlane,
        "point_on_line": joints.PointOnLine,
        "prescribed_displacement": joints.PrescribedDisplacement,
        "prescribed_motion": joints.PrescribedMotion,
        "prescribed_rotation": joints.PrescribedRotation,
        "prismatic": joints.Prismatic,
        "revolute": joints.Revolute,
        "rigid_link": joints.RigidLink,
        "rolling": joints.Rolling,
        "screw": joints.Screw,
        "slider": joints.Slider,
        "spherical": joints.Spherical,
        "swing_arm": joints.SwingArm,
        "telescopic_rod": joints.TelescopicRod,
        "universal": joints.Universal,
        "wheel_on_rail": joints.WheelOnRail,
    },
    "springs": {
        "axial": springs.Axial,
        "point": springs.Point,
        "rolling_contact": springs.RollingContact,
        "tyre": springs.Tyre,
        "rope": springs.Rope,
        "torsional": springs.Torsional,
        "axial_friction": springs.AxialFriction,
        "torsional_friction": springs.TorsionalFriction,
        "bushing": springs.Bushing,
        "bearing": springs.Bearing,
        "journal_bearing": springs.JournalBearing,
        "coordinate_dynamics": springs.CoordinateDynamics,
        "axial_stop": springs.AxialStop,
        "torsional_stop": springs.TorsionalStop,
        "axial_latch": springs.AxialLatch,
        "torsional_latch": springs.TorsionalLatch,
    },
    "loads": {
        "force": loads.Force,
        "moment": loads.Moment,
        "force_between": loads.ForceBetween,
        "joint_torque": loads.JointTorque,
        "joint_force": loads.JointForce,
        "gyrostat": loads.Gyrostat,
    },
    "local_loads": loads.LocalLoad,
    "ground": contacts.Ground,
    "contacts": contacts.Contact,
    "states": feedback.State,
    "events": feedback.Event,
    "units": feedback.Unit,
    "fluids": hydraulics.Fluid,
    "hydraulics": {
        "volume": hydraulics.Volume,
        "pressure": hydraulics.Pressure,
        "junction": hydraulics.Junction,
        "cylinder": hydraulics.Cylinder,
        "orifice": hydraulics.Orifice,
        "valve": hydraulics.Valve,
        "check_valve": hydraulics.CheckValve,
        "relief_valve": hydraulics.ReliefValve,
        "pump": hydraulics.Pump,
        "accumulator": hydraulics.Accumulator,
        "pipe": hydraulics.Pipe,
    },
    "initial": motions.Initial,
    "outputs": {
        "position": outputs.Position,
        "displacement": outputs.Displacement,
        "rotation": outputs.Rotation,
        "quaternion": outputs.Quaternion,
        "cardan_angles": outputs.CardanAngles,
        "angle": outputs.Angle,
        "velocity": outputs.Velocity,
        "distance": outputs.Distance,
        "angular_velocity": outputs.AngularVelocity,
        "acceleration": outputs.Acceleration,
        "section_force": outputs.SectionForce,
        "section_moment": outputs.SectionMoment,
        "shell_force": outputs.ShellForce,
        "shell_moment": outputs.ShellMoment,
        "shell_stress": outputs.ShellStress,
        "solid_stress": outputs.SolidStress,
        "line": outputs.Line,
        "modal": outputs.Modal,
        "recovered": outputs.Recovered,
        "reaction": outputs.Reaction,
        "relative": outputs.Relative,
        "relative_acceleration": outputs.RelativeAcceleration,
        "relative_motion": outputs.RelativeMotion,
        "contact": outputs.Contact,
        "contact_force": outputs.ContactForce,
        "local_load": outputs.LocalLoad,
        "spring": outputs.Spring,
        "spring_force": outputs.SpringForce,
        "tyre": outputs.Tyre,
        "power": outputs.Power,
        "work": outputs.Work,
        "energy": outputs.Energy,
        "momentum": outputs.Momentum,
        "signal": outputs.Signal,
        "expression": outputs.Expression,
    },
    "analysis": {
        "dynamics": analyses.Dynamics,
        "statics": analyses.Statics,
        "path": analyses.Path,
        "buckling": analyses.Buckling,
        "modes": analyses.Modes,
    },
}

#: The words at the top of a model file, in order.
ORDER = (
    "lissom",
    "title",
    "gravity",
    "parameters",
    "materials",
    "sections",
    "points",
    "parts",
    "beams",
    "shells",
    "solids",
    "bodies",
    "point_masses",
    "superelements",
    "joints",
    "springs",
    "loads",
    "local_loads",
    "ground",
    "contacts",
    "inputs",
    "signals",
    "states",
    "events",
    "units",
    "fluids",
    "hydraulics",
    "initial",
    "assembly",
    "outputs",
    "analysis",
)


class ModelTables(ModelTree):
    """The tables of a model as attributes. What is changed in them counts from then on."""

    __slots__ = ()

    @property
    def title(self) -> str | None:
        """One line about the model."""
        of: str | None = self._value("title")
        return of

    @title.setter
    def title(self, of: str | None) -> None:
        self._set("title", of)

    @property
    def gravity(self) -> Any:
        """Acceleration of gravity [m/s²]; default: none."""
        of: Any = self._value("gravity")
        return of

    @gravity.setter
    def gravity(self, of: Any) -> None:
        self._set("gravity", of)

    @property
    def parameters(self) -> dict[str, Any]:
        """Numbers for use in expressions."""
        of: dict[str, Any] = self._table("parameters")
        return of

    @parameters.setter
    def parameters(self, of: dict[str, Any]) -> None:
        self._set("parameters", of)

    @property
    def materials(self) -> dict[str, Material]:
        """Isotropic elastic materials."""
        of: dict[str, Material] = self._table("materials")
        return of

    @materials.setter
    def materials(self, of: dict[str, Material]) -> None:
        self._set("materials", of)

    @property
    def sections(self) -> dict[str, Section]:
        """Cross sections; axis 1 along the beam, 2 and 3 perpendicular to it."""
        of: dict[str, Section] = self._table("sections")
        return of

    @sections.setter
    def sections(self, of: dict[str, Section]) -> None:
        self._set("sections", of)

    @property
    def points(self) -> dict[str, Any]:
        """Named positions [m]."""
        of: dict[str, Any] = self._table("points")
        return of

    @points.setter
    def points(self, of: dict[str, Any]) -> None:
        self._set("points", of)

    @property
    def parts(self) -> dict[str, Part]:
        """Sub-assemblies, which may be placed and repeated; their entries are named `part.name`."""
        of: dict[str, Part] = self._table("parts")
        return of

    @parts.setter
    def parts(self, of: dict[str, Part]) -> None:
        self._set("parts", of)

    @property
    def beams(self) -> dict[str, Beam]:
        """Flexible beams."""
        of: dict[str, Beam] = self._table("beams")
        return of

    @beams.setter
    def beams(self, of: dict[str, Beam]) -> None:
        self._set("beams", of)

    @property
    def shells(self) -> dict[str, Shell]:
        """Flexible shells and plates: curved surfaces of finite elements."""
        of: dict[str, Shell] = self._table("shells")
        return of

    @shells.setter
    def shells(self, of: dict[str, Shell]) -> None:
        self._set("shells", of)

    @property
    def solids(self) -> dict[str, Solid]:
        """Elastic solids: volumes of finite elements."""
        of: dict[str, Solid] = self._table("solids")
        return of

    @solids.setter
    def solids(self, of: dict[str, Solid]) -> None:
        self._set("solids", of)

    @property
    def bodies(self) -> dict[str, Body]:
        """Rigid bodies."""
        of: dict[str, Body] = self._table("bodies")
        return of

    @bodies.setter
    def bodies(self, of: dict[str, Body]) -> None:
        self._set("bodies", of)

    @property
    def point_masses(self) -> dict[str, PointMass]:
        """Point masses."""
        of: dict[str, PointMass] = self._table("point_masses")
        return of

    @point_masses.setter
    def point_masses(self, of: dict[str, PointMass]) -> None:
        self._set("point_masses", of)

    @property
    def superelements(self) -> dict[str, Superelement]:
        """Linear elastic parts, specified by reduced matrices."""
        of: dict[str, Superelement] = self._table("superelements")
        return of

    @superelements.setter
    def superelements(self, of: dict[str, Superelement]) -> None:
        self._set("superelements", of)

    @property
    def joints(self) -> dict[str, Joint]:
        """Constraints between nodes, or between coordinates of joints."""
        of: dict[str, Joint] = self._table("joints")
        return of

    @joints.setter
    def joints(self, of: dict[str, Joint]) -> None:
        self._set("joints", of)

    @property
    def springs(self) -> dict[str, Spring]:
        """Springs, dampers, friction, stops and latches."""
        of: dict[str, Spring] = self._table("springs")
        return of

    @springs.setter
    def springs(self, of: dict[str, Spring]) -> None:
        self._set("springs", of)

    @property
    def loads(self) -> dict[str, Load]:
        """Applied forces and moments, and those of actuators."""
        of: dict[str, Load] = self._table("loads")
        return of

    @loads.setter
    def loads(self, of: dict[str, Load]) -> None:
        self._set("loads", of)

    @property
    def local_loads(self) -> dict[str, LocalLoad]:
        """Forces and moments that depend on the motion of their own points, along beams and on nodes."""
        of: dict[str, LocalLoad] = self._table("local_loads")
        return of

    @local_loads.setter
    def local_loads(self, of: dict[str, LocalLoad]) -> None:
        self._set("local_loads", of)

    @property
    def ground(self) -> Ground | None:
        """Solids that are fixed in space, for contacts and drawings."""
        of: Ground | None = self._value("ground")
        return of

    @ground.setter
    def ground(self, of: Ground | None) -> None:
        self._set("ground", of)

    @property
    def contacts(self) -> dict[str, Contact]:
        """Parts that may touch, by their shapes; `kind` may be omitted: it follows from parts and keys."""
        of: dict[str, Contact] = self._table("contacts")
        return of

    @contacts.setter
    def contacts(self, of: dict[str, Contact]) -> None:
        self._set("contacts", of)

    @property
    def inputs(self) -> dict[str, Any]:
        """Numbers that are set during a simulation by events or by the calling program, with their initial values."""
        of: dict[str, Any] = self._table("inputs")
        return of

    @inputs.setter
    def inputs(self, of: dict[str, Any]) -> None:
        self._set("inputs", of)

    @property
    def signals(self) -> dict[str, Any]:
        """Named expressions of time, inputs, states and outputs."""
        of: dict[str, Any] = self._table("signals")
        return of

    @signals.setter
    def signals(self, of: dict[str, Any]) -> None:
        self._set("signals", of)

    @property
    def states(self) -> dict[str, State]:
        """First-order states: numbers whose time derivative is an expression."""
        of: dict[str, State] = self._table("states")
        return of

    @states.setter
    def states(self, of: dict[str, State]) -> None:
        self._set("states", of)

    @property
    def events(self) -> dict[str, Event]:
        """Actions when expressions cross zero."""
        of: dict[str, Event] = self._table("events")
        return of

    @events.setter
    def events(self, of: dict[str, Event]) -> None:
        self._set("events", of)

    @property
    def units(self) -> dict[str, Unit]:
        """Units (FMI) of other programs: advanced from sample to sample, or with equations that are solved with those of the model."""
        of: dict[str, Unit] = self._table("units")
        return of

    @units.setter
    def units(self, of: dict[str, Unit]) -> None:
        self._set("units", of)

    @property
    def fluids(self) -> dict[str, Fluid]:
        """Fluids of hydraulic parts."""
        of: dict[str, Fluid] = self._table("fluids")
        return of

    @fluids.setter
    def fluids(self, of: dict[str, Fluid]) -> None:
        self._set("fluids", of)

    @property
    def hydraulics(self) -> dict[str, HydraulicPart]:
        """Hydraulic parts: nodes with a pressure, and components between them such as cylinders, valves and pumps."""
        of: dict[str, HydraulicPart] = self._table("hydraulics")
        return of

    @hydraulics.setter
    def hydraulics(self, of: dict[str, HydraulicPart]) -> None:
        self._set("hydraulics", of)

    @property
    def initial(self) -> Initial | None:
        """Initial conditions: a rigid motion of all parts, or of those listed in an entry [initial.…]; static equilibrium."""
        of: Initial | None = self._value("initial")
        return of

    @initial.setter
    def initial(self, of: Initial | None) -> None:
        self._set("initial", of)

    @property
    def assembly(self) -> Any:
        """Corrects approximate positions of parts: they are moved by the smallest amount that closes all joints at their initial values."""
        of: Any = self._value("assembly")
        return of

    @assembly.setter
    def assembly(self, of: Any) -> None:
        self._set("assembly", of)

    @property
    def outputs(self) -> dict[str, Output]:
        """Quantities to be recorded."""
        of: dict[str, Output] = self._table("outputs")
        return of

    @outputs.setter
    def outputs(self, of: dict[str, Output]) -> None:
        self._set("outputs", of)

    @property
    def analysis(self) -> Analysis | None:
        """Kind of analysis and its settings."""
        of: Analysis | None = self._value("analysis")
        return of

    @analysis.setter
    def analysis(self, of: Analysis | None) -> None:
        self._set("analysis", of)
