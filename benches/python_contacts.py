"""Cost of contacts beside Exudyn, at equal error: a ball strikes two others one after the other.

    pip install exudyn
    python benches/python_contacts.py target/release/lissom

The exact velocities at the end are 0, 0 and 1 m/s. Processor time of the steps alone.
"""

import json
import subprocess
import sys
import tempfile
import time

sys.exudynFast = True
import exudyn as exu
from exudyn.utilities import InertiaSphere, MarkerBodyRigid, NodeGenericData, ObjectContactSphereSphere

BALLS = {"a": (-0.25, 1.0), "b": (0.0, 0.0), "c": (0.21, 0.0)}
STIFFNESS, EXPONENT, RADIUS = 1e6, 1.5, 0.1


def error(velocities):
    """Largest deviation from the exact velocities [m/s]."""
    return max(abs(found - exact) for found, exact in zip(velocities, (0.0, 0.0, 1.0)))


def lissom(program, end, tolerance):
    model = "lissom = 1\n"
    for name, (x, v) in BALLS.items():
        model += f"""[bodies.{name}]
mass = 1
inertia = {{ sphere = {RADIUS} }}
shape = {{ sphere = {RADIUS} }}
position = [{x}, 0, 0]
velocity = [{v}, 0, 0]
[outputs.{name}]
kind = "velocity"
of = "{name}"
"""
    for base, tip in ("ab", "bc"):
        law = f"stiffness = {STIFFNESS}\nexponent = {EXPONENT}"
        model += f'[contacts.{base}{tip}]\nbase = "{base}"\ntip = "{tip}"\n{law}\n'
    model += f'[analysis]\nkind = "dynamics"\nend = {end}\nrelative_tolerance = {tolerance}\n'
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/model.toml", "w") as file:
            file.write(model)
        run = [program, "run", f"{folder}/model.toml", "--out", f"{folder}/out", "--quiet", "--no-plots"]
        subprocess.run(run, check=True)
        with open(f"{folder}/out/summary.json") as file:
            seconds = json.load(file)["solve_seconds"]
        with open(f"{folder}/out/history.csv") as file:
            rows = file.read().split()
    columns = rows[0].split(",")
    last = dict(zip(columns, map(float, rows[-1].split(","))))
    return seconds, error([last[f"{name}.v1"] for name in BALLS])


def exudyn(end, step):
    mbs = exu.SystemContainer().AddSystem()
    bodies = [
        mbs.CreateRigidBody(
            referencePosition=[x, 0, 0], initialVelocity=[v, 0, 0], inertia=InertiaSphere(1, RADIUS)
        )
        for x, v in BALLS.values()
    ]
    markers = [mbs.AddMarker(MarkerBodyRigid(bodyNumber=body)) for body in bodies]
    for pair in (markers[:2], markers[1:]):
        node = mbs.AddNode(NodeGenericData(initialCoordinates=[0.1, 0, 0, 0], numberOfDataCoordinates=4))
        contact = ObjectContactSphereSphere(
            markerNumbers=pair,
            nodeNumber=node,
            spheresRadii=[RADIUS, RADIUS],
            contactStiffness=STIFFNESS,
            contactStiffnessExponent=EXPONENT,
        )
        mbs.AddObject(contact)
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = settings.solution.sensors.active = False
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime = round(end / step), end
    integration.verboseMode = 0
    integration.generalizedAlpha.spectralRadius = 1.0
    integration.newton.useModifiedNewton = True
    integration.newton.relativeTolerance, integration.newton.absoluteTolerance = 1e-10, 1e-12
    start = time.process_time()
    mbs.SolveDynamic(settings, showHints=False, showCausingItems=False)
    seconds = time.process_time() - start
    velocity = exu.OutputVariableType.Velocity
    return seconds, error([mbs.GetObjectOutputBody(body, velocity)[0] for body in bodies])


if __name__ == "__main__":
    program = sys.argv[1] if len(sys.argv) > 1 else "lissom"
    exu.SuppressWarnings(True)
    for end in (0.12, 1.0):
        for step in (3e-4, 1e-4, 3e-5, 1e-5):
            seconds, own = exudyn(end, step)
            print(f"{end} s: Exudyn, steps of {step:g} s: error {own:.1e} m/s, {1e3 * seconds:.1f} ms")
        for tolerance in (1e-3, 1e-4, 1e-5, 1e-6):
            seconds, own = lissom(program, end, tolerance)
            print(f"{end} s: Lissom, tolerance {tolerance:g}: error {own:.1e} m/s, {1e3 * seconds:.1f} ms")
