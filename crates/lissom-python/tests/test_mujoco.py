"""Imported robots against MuJoCo itself: mass matrices and motions. Left out where the package `mujoco` is not installed."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lissom
from test_joints import arm

mujoco = pytest.importorskip("mujoco", reason="the package `mujoco` is not installed: pip install mujoco")

Program = Callable[..., "subprocess.CompletedProcess[str]"]

#: A crane: hinges with rotors, a spring and dampers, a slide, a ball joint; masses given, and those of shapes.
CRANE = """
<mujoco model="crane">
  <compiler angle="radian"/>
  <option gravity="0 0 -9.81" timestep="2e-4" integrator="RK4"/>
  <default><geom density="900" contype="0" conaffinity="0"/><joint armature="0.01"/></default>
  <worldbody>
    <body name="post" pos="0 0 0.5">
      <joint name="swing" axis="0 0 1" damping="0.03" armature="0.05"/>
      <geom type="cylinder" size="0.06 0.25"/>
      <body name="boom" pos="0.1 0.05 0.25" euler="0 -0.2 0.1">
        <joint name="lift" axis="0 1 0" stiffness="90" springref="0.4" damping="1.5"/>
        <geom type="capsule" fromto="0 0 0 0.8 0 0.1" size="0.04"/>
        <body name="ram" pos="0.8 0 0.1" quat="0.9 0.1 0.2 -0.1">
          <joint name="reach" type="slide" axis="1 0 0.2" stiffness="150" damping="2" armature="0.3"/>
          <geom type="box" size="0.15 0.03 0.02" pos="0.1 0 0"/>
          <geom type="ellipsoid" size="0.05 0.04 0.03" pos="0.25 0 0" mass="0.4"/>
          <body name="load" pos="0.3 0 0">
            <joint name="hang" type="ball" armature="0"/>
            <inertial pos="0.02 0.03 -0.25" mass="1.3" fullinertia="0.02 0.03 0.015 0.002 -0.001 0.003"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""

#: An arm of three hinges; links have inertias with axes and centres of their own.
ARM = """
<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.02 0.01 0.2" rpy="0.1 0.2 0.3"/><mass value="2"/>
    <inertia ixx="0.03" iyy="0.028" izz="0.006" ixy="0.001" ixz="-0.002" iyz="0.0005"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0 0.03 0.15"/><mass value="1.1"/>
    <inertia ixx="0.012" iyy="0.011" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="hand"><inertial><origin xyz="0.01 0 0.05"/><mass value="0.4"/>
    <inertia ixx="0.001" iyy="0.0012" izz="0.0006" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0.3 0 0"/>
    <axis xyz="0 1 0"/><dynamics damping="0.2"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.4" rpy="0 0.4 0.2"/>
    <axis xyz="1 0 1"/><dynamics damping="0.1"/></joint>
  <joint name="wrist" type="continuous"><parent link="fore"/><child link="hand"/><origin xyz="0 0 0.3" rpy="0 0 0.7"/>
    <axis xyz="0 1 0.5"/><dynamics damping="0.05"/></joint>
</robot>
"""

BODIES = {"crane": ("post", "boom", "ram", "load"), "arm": ("upper", "fore", "hand")}
#: Joints with one coordinate, and what drives them.
JOINTS = {
    "crane": {"swing": ("torque", "rate"), "lift": ("torque", "rate"), "reach": ("force", "velocity")},
    "arm": {"shoulder": ("torque", "rate"), "elbow": ("torque", "rate"), "wrist": ("torque", "rate")},
}
END = 1.0


def imported(program: Program, folder: Path, text: str, more: str) -> lissom.Model:
    """The model that `lissom import` makes, with `more` behind it."""
    file = folder / "robot.xml"
    file.write_text(text)
    ended = program("import", file, "--out", folder / "robot.toml")
    assert ended.returncode == 0, ended.stderr
    written = (folder / "robot.toml").read_text()
    return lissom.loads(written + more, "robot.toml")


def simulated(text: str, step: float) -> Any:
    """MuJoCo's model, and the places of all bodies at every tenth of the time."""
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.timestep = step
    state = mujoco.MjData(model)
    places = [positions(model, state)]
    for _ in range(10):
        for _ in range(round(END / 10 / step)):
            mujoco.mj_step(model, state)
        places.append(positions(model, state))
    return model, state, np.array(places)


def positions(model: Any, state: Any) -> Any:
    mujoco.mj_forward(model, state)
    return state.xpos[1:].copy()


def mass_matrix(model: Any, state: Any) -> Any:
    """Column by column, which all versions of the package can do."""
    columns = []
    for unit in np.eye(model.nv):
        column = np.zeros(model.nv)
        mujoco.mj_mulM(model, state, column, unit)
        columns.append(column)
    return np.array(columns)


@pytest.mark.parametrize(("name", "text"), [("crane", CRANE), ("arm", ARM)])
def test_robots_move_as_in_mujoco(name: str, text: str, program: Program, tmp_path: Path) -> None:
    bodies = BODIES[name]
    outputs = "".join(f'[outputs.place_of_{body}]\nkind = "position"\nof = "{body}"\n' for body in bodies)
    model = imported(program, tmp_path, text, outputs)
    there, state, places = simulated(text, 1e-4)
    coarse = simulated(text, 2e-4)[2]
    names = [mujoco.mj_id2name(there, mujoco.mjtObj.mjOBJ_BODY, index) for index in range(1, there.nbody)]
    wanted = places[:, [names.index(body) for body in bodies]]
    moved = np.abs(wanted - wanted[0]).max()
    assert moved > 0.1, "it moves far"
    reached = []
    for step in (2e-3, 1e-3):
        run = model.replace({"analysis": {"kind": "dynamics", "scheme": "radau-iia", "end": END, "step": step}}).run()
        rows = [int(np.argmin(np.abs(run.time - END * part / 10))) for part in range(11)]
        assert np.allclose(run.time[rows], np.linspace(0, END, 11), rtol=0, atol=1e-12)
        found = np.array([[[run[f"place_of_{body}.{axis}"][row] for axis in "xyz"] for body in bodies] for row in rows])
        reached.append(np.abs(found - wanted).max())
    own = np.abs(coarse - places).max()
    assert own < 1e-8 * moved, f"MuJoCo's steps are short enough: {own:.1e} m"
    assert reached[1] < 1e-6 * moved, f"{reached} m of {moved:.2f} m"
    assert reached[1] < reached[0] / 5, f"what differs is the error of our steps: {reached}"


@pytest.mark.parametrize(("name", "text"), [("crane", CRANE), ("arm", ARM)])
def test_mass_matrices_are_those_of_mujoco(name: str, text: str, program: Program, tmp_path: Path) -> None:
    """A unit of each torque or force gives the accelerations of a column of the inverse."""
    # Without the spring that pulls at it, so that it is in equilibrium.
    text = text.replace(' springref="0.4"', "")
    joints = JOINTS[name]
    more = "".join(
        f'[loads.drive_{joint}]\nkind = "joint_{kind}"\njoint = "{joint}"\n{kind} = 0\n[outputs.motion_of_{joint}]\nkind = "relative"\nof = "{joint}"\n'
        for joint, (kind, _) in joints.items()
    )
    model = imported(program, tmp_path, text, more)
    linear = model.linearize([f"loads.drive_{joint}" for joint in joints], [f"motion_of_{joint}" for joint in joints], about="undeformed")
    rates = [linear.outputs.index(f"motion_of_{joint}.{rate}") for joint, (_, rate) in joints.items()]
    A, B, C, D = linear.state_space
    inverse = (C @ B)[rates]
    there = mujoco.MjModel.from_xml_string(text)
    state = mujoco.MjData(there)
    mujoco.mj_forward(there, state)
    mass = mass_matrix(there, state)
    dofs = [int(there.jnt_dofadr[mujoco.mj_name2id(there, mujoco.mjtObj.mjOBJ_JOINT, joint)]) for joint in joints]
    wanted = np.linalg.inv(mass)[np.ix_(dofs, dofs)]
    assert np.abs(inverse - wanted).max() < 1e-9 * np.abs(wanted).max(), f"{inverse}\n{wanted}"


def test_what_is_exported_is_the_same_robot(program: Program, tmp_path: Path) -> None:
    """An arm goes through a model file and back to a URDF: MuJoCo finds the same mass matrix."""
    imported(program, tmp_path, ARM, "")
    ended = program("export", tmp_path / "robot.toml", "--format", "urdf", "--out", tmp_path / "again.urdf")
    assert ended.returncode == 0, ended.stderr
    found = []
    for text in (ARM, (tmp_path / "again.urdf").read_text()):
        model = mujoco.MjModel.from_xml_string(text)
        state = mujoco.MjData(model)
        state.qpos[:] = [0.3, -0.7, 1.1]
        mujoco.mj_forward(model, state)
        found.append((mass_matrix(model, state), state.qfrc_bias.copy()))
    assert np.abs(found[0][0] - found[1][0]).max() < 1e-12 and np.abs(found[0][1] - found[1][1]).max() < 1e-11


def test_equations_of_motion_in_joint_coordinates_are_those_of_mujoco() -> None:
    """Mass matrix and bias of an arm of seven axes at a random state."""
    links = ""
    for i in range(7):
        inertial = f'<inertial pos="0.05 0.02 0.15" mass="{2 - 0.2 * i}" diaginertia="0.02 0.03 0.01"/>'
        links += f'<body pos="0 0 {0.3 if i else 0}">{inertial}<joint axis="{"0 1 0" if i % 2 else "0 0 1"}"/>'
    start = '<mujoco><compiler angle="radian"/><option gravity="0 0 -9.81"/><worldbody>'
    model = mujoco.MjModel.from_xml_string(start + links + "</body>" * 7 + "</worldbody></mujoco>")
    data, sim = mujoco.MjData(model), arm(7).simulation()
    rng = np.random.default_rng(5)
    data.qpos[:], data.qvel[:] = rng.uniform(-2, 2, (2, 7))
    mujoco.mj_forward(model, data)
    sim.reset(data.qpos, data.qvel)
    unit = np.eye(7)
    columns = np.zeros((7, 7))
    for own, direction in zip(columns, unit):
        mujoco.mj_mulM(model, data, own, direction)
    assert np.allclose(sim.mass_matrix(), columns, rtol=0, atol=1e-12)
    assert np.allclose(sim.bias(), data.qfrc_bias, rtol=0, atol=1e-10)


#: A body that floats, with a leg of two hinges and a slide.
FLOATING = """
<mujoco model="hopper">
  <compiler angle="radian"/>
  <option gravity="0 0 -9.81"/>
  <default><geom density="700" contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="trunk" pos="0.1 -0.2 1">
      <freejoint/>
      <geom type="box" size="0.2 0.1 0.06" pos="0.03 0.01 -0.02"/>
      <body name="thigh" pos="0.15 0.05 -0.05">
        <joint name="hip" axis="0 1 0.2"/>
        <geom type="capsule" fromto="0 0 0 0.02 0 -0.3" size="0.03"/>
        <body name="shank" pos="0.02 0 -0.3">
          <joint name="knee" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0.03 -0.25" size="0.02"/>
          <body name="foot" pos="0 0.03 -0.25">
            <joint name="reach" type="slide" axis="0.1 0 1"/>
            <geom type="sphere" size="0.03"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


def test_equations_of_motion_of_a_robot_that_floats_are_those_of_mujoco(program: Program, tmp_path: Path) -> None:
    """MuJoCo has the velocity of a free body in global axes, and its angular velocity in those of the body."""
    robot = imported(program, tmp_path, FLOATING, "")
    sim = robot.simulation()
    assert sim.coordinates() == ["trunk", "hip.angle", "knee.angle", "reach.displacement"]
    random = np.random.default_rng(7)
    reference = mujoco.MjModel.from_xml_string(FLOATING)
    for _ in range(3):
        quaternion = random.normal(size=4)
        q = np.concatenate([random.normal(size=3), quaternion / np.linalg.norm(quaternion), random.normal(size=3)])
        v = random.normal(size=9)
        sim.reset(q, v)
        found = sim.joint_state()
        found[0][3:7] *= np.sign(found[0][3:7] @ q[3:7])
        assert np.allclose(found[0], q, rtol=0, atol=1e-12)
        assert np.allclose(found[1], v, rtol=0, atol=1e-12)
        data = mujoco.MjData(reference)
        data.qpos[:], data.qvel[:] = q, v
        entries = np.zeros(9)
        mujoco.mju_quat2Mat(entries, q[3:7])
        turn = entries.reshape(3, 3)
        into = np.eye(9)
        into[:3, :3] = turn
        data.qvel[:3] = turn @ v[:3]
        mujoco.mj_forward(reference, data)
        mass = mass_matrix(reference, data)
        carried = np.zeros(9)
        carried[:3] = turn @ np.cross(v[3:6], v[:3])
        assert np.allclose(sim.mass_matrix(), into.T @ mass @ into, rtol=0, atol=1e-10)
        assert np.allclose(sim.bias(), into.T @ (data.qfrc_bias + mass @ carried), rtol=0, atol=1e-9)
    sim.reset({"hip.angle": 0.5})
    moved, _ = sim.joint_state()
    sim.reset()
    start, _ = sim.joint_state()
    assert np.allclose(moved[:7], start[:7], rtol=0, atol=1e-12)
