"""Forces of rolling tyres against the Magic Formula as this file evaluates it: Pacejka 2002, section 4.3.2, written apart from the program."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lissom
from conftest import ROOT

TYRE = ROOT / "examples" / "parts" / "passenger-car.tir"

RIG = """
lissom = 1
[parameters]
angle = 0
camber = 0
load = 4000
slip = 0
height = "0.317*cos(camber) - load/2e5"
[bodies.carriage]
mass = 100
inertia = [1, 1, 1]
position = [0, 0, "height"]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "carriage"
axis = [1, 0, 0]
[joints.drive]
kind = "prescribed_displacement"
joint = "rail"
displacement = "20*t"
[bodies.wheel]
mass = 10
inertia = [0.4, 0.6, 0.4]
position = [0, 0, "height"]
[joints.axle]
kind = "revolute"
base = "carriage"
tip = "wheel"
axis = ["sin(angle)*cos(camber)", "cos(angle)*cos(camber)", "sin(camber)"]
[joints.motor]
kind = "prescribed_rotation"
joint = "axle"
rotation = "20*(1 + slip)/0.31*t"
[springs.tyre]
kind = "tyre"
base = "ground"
tip = "wheel"
at_base = [0, 0, 0]
normal = [0, 0, 1]
wheel_axis = ["sin(angle)*cos(camber)", "cos(angle)*cos(camber)", "sin(camber)"]
magic_formula = "TYRE"
[initial.wheel]
parts = ["wheel"]
velocity = [20, 0, 0]
about = [0, 0, "height"]
angular_velocity = ["20*(1 + slip)/0.31*sin(angle)*cos(camber)", "20*(1 + slip)/0.31*cos(angle)*cos(camber)", "20*(1 + slip)/0.31*sin(camber)"]
[outputs.tyre]
kind = "tyre"
of = "tyre"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 0.5
step = 5e-4
"""


def coefficients() -> dict[str, float]:
    lines = (line.split("$")[0].partition("=") for line in TYRE.read_text().splitlines())
    return {name.strip(): float(value) for name, _, value in lines if value.strip()[:1] in set("-.0123456789")}


def forces(kappa: float, alpha: float, gamma: float, load: float) -> tuple[Any, Any, Any]:
    """Longitudinal and lateral force and aligning moment."""
    c = coefficients()

    def over_load(name: str, count: int = 2) -> float:
        d = (load - c["FNOMIN"]) / c["FNOMIN"]
        return sum(c[f"{name}{k + 1}"] * d**k for k in range(count))

    def bent(wave: Callable[[Any], Any], slip: float, slope: float, shape: float, size: float, curvature: float) -> Any:
        x = slope * slip
        return size * wave(shape * np.arctan(x - min(curvature, 1) * (x - np.arctan(x))))

    friction = over_load("PDX") * (1 - c["PDX3"] * gamma**2)
    stiff_x = load * over_load("PKX") * np.exp(c["PKX3"] * (load / c["FNOMIN"] - 1))
    own = kappa + over_load("PHX")
    curvature = over_load("PEX", 3) * (1 - c["PEX4"] * np.sign(own))
    pull = bent(np.sin, own, stiff_x / (c["PCX1"] * friction * load), c["PCX1"], friction * load, curvature)
    pull += load * over_load("PVX")

    friction = over_load("PDY") * (1 - c["PDY3"] * gamma**2)
    stiff_y = c["PKY1"] * c["FNOMIN"] * np.sin(2 * np.arctan(load / (c["PKY2"] * c["FNOMIN"])))
    stiff_y *= 1 - c["PKY3"] * abs(gamma)
    d = load / c["FNOMIN"] - 1
    shift = over_load("PHY") + c["PHY3"] * gamma
    own = alpha + shift
    curvature = over_load("PEY") * (1 - (c["PEY3"] + c["PEY4"] * gamma) * np.sign(own))
    slope = stiff_y / (c["PCY1"] * friction * load)
    side = bent(np.sin, own, slope, c["PCY1"], friction * load, curvature)
    upwards = load * (over_load("PVY") + (c["PVY3"] + c["PVY4"] * d) * gamma)
    side += upwards

    less = c["RBX1"] * np.cos(np.arctan(c["RBX2"] * kappa))
    curvature = over_load("REX")
    pull *= bent(np.cos, alpha + c["RHX1"], less, c["RCX1"], 1, curvature)
    pull /= bent(np.cos, c["RHX1"], less, c["RCX1"], 1, curvature)
    less = c["RBY1"] * np.cos(np.arctan(c["RBY2"] * (alpha - c["RBY3"])))
    start = over_load("RHY")
    side *= bent(np.cos, kappa + start, less, c["RCY1"], 1, over_load("REY"))
    side /= bent(np.cos, start, less, c["RCY1"], 1, over_load("REY"))
    by_slip = friction * load * (over_load("RVY") + c["RVY3"] * gamma) * np.cos(np.arctan(c["RVY4"] * alpha))
    by_slip *= np.sin(c["RVY5"] * np.arctan(c["RVY6"] * kappa))

    def equivalent(angle: float) -> Any:
        return np.arctan(np.hypot(np.tan(angle), stiff_x / stiff_y * kappa))

    radius = c["UNLOADED_RADIUS"]
    turned = alpha + over_load("QHZ") + (c["QHZ3"] + c["QHZ4"] * d) * gamma
    steep = over_load("QBZ", 3) * (1 + c["QBZ4"] * gamma + c["QBZ5"] * abs(gamma))
    peak = load * over_load("QDZ") * (1 + c["QDZ3"] * gamma + c["QDZ4"] * gamma**2) * radius / c["FNOMIN"]
    curvature = over_load("QEZ", 3)
    curvature *= 1 + (c["QEZ4"] + c["QEZ5"] * gamma) * 2 / np.pi * np.arctan(steep * c["QCZ1"] * turned)
    trail = bent(np.cos, equivalent(turned), steep, c["QCZ1"], peak, curvature) * np.cos(alpha)
    rest = load * (c["QDZ6"] + c["QDZ7"] * d + (c["QDZ8"] + c["QDZ9"] * d) * gamma) * radius * np.cos(alpha)
    rest *= np.cos(np.arctan((c["QBZ9"] + c["QBZ10"] * slope * c["PCY1"]) * equivalent(alpha + shift + upwards / stiff_y)))
    arm = radius * (c["SSZ1"] + c["SSZ2"] * (side + by_slip) / c["FNOMIN"] + (c["SSZ3"] + c["SSZ4"] * d) * gamma)
    return pull, side + by_slip, rest - trail * side + arm * pull


@pytest.mark.parametrize(
    ("slip", "angle", "camber", "load"),
    [(0, 0.05, 0, 4000), (0.04, 0, 0, 3000), (-0.06, -0.04, 0.03, 5000), (0.1, 0.12, -0.05, 2500)],
)
def test_a_rolling_tyre_has_the_forces_of_its_file(
    tmp_path: Path, slip: float, angle: float, camber: float, load: float
) -> None:
    model = tmp_path / "rig.toml"
    model.write_text(RIG.replace("TYRE", str(TYRE)))
    results = lissom.load(
        model,
        **{"parameters.slip": slip, "parameters.angle": angle, "parameters.camber": camber, "parameters.load": load},
    ).run()
    found = {name: results[f"tyre.{name}"][-1] for name in ["slip", "slip_angle", "normal", "longitudinal", "lateral", "aligning"]}
    assert found["slip_angle"] == pytest.approx(angle, abs=1e-3)
    wanted = forces(found["slip"], found["slip_angle"], camber, found["normal"])
    assert [found["longitudinal"], found["lateral"], found["aligning"]] == pytest.approx(wanted, rel=1e-3, abs=1e-6 * load)
