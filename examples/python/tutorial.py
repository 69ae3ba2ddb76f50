# %% [markdown]
# # Lissom in Python, from a model to a controller
#
# A notebook in the percent format: Jupyter, VS Code and Spyder open it; `python tutorial.py` runs it as it is. The tests of the
# package run it, too, and compare `values` with those of the command line, to the last bit.

# %%
from pathlib import Path

import numpy as np

import lissom
from lissom.entries import Body, analyses, joints, outputs

EXAMPLES = Path(__file__).resolve().parents[1] if "__file__" in globals() else Path("examples")
values: dict[str, float] = {}

# %% [markdown]
# ## Run a model file

# %%
pendulum = lissom.load(EXAMPLES / "pendulum.toml")
result = pendulum.run()
values["pendulum_x"] = result["bob.x"][-1]
print(result, result.summary["newton_iterations"], "iterations")
result.names

# %% [markdown]
# Another value anywhere in the file makes another model; the first one stays as it is.

# %%
heavy = pendulum.replace({"point_masses.bob.mass": 4})
values["heavy_x"] = heavy.run()["bob.x"][-1]

# %% [markdown]
# ## Frequencies, derivatives, a linear model

# %%
crank = lissom.load(EXAMPLES / "tip-crank.toml")
modes = crank.modes(3, about="undeformed")
values["first_frequency"] = modes.frequencies[0]
gradient = pendulum.gradient("bob.x@0.5", ["springs.spring.stiffness"])
values["derivative"] = gradient["springs.spring.stiffness"]
linear = crank.linearize(about="undeformed")
values["mass_trace"] = float(linear.M.diagonal().sum())
print(modes.frequencies, gradient, linear)

# %% [markdown]
# ## Build a model from objects
#
# Every class stands for an entry of a model file; `print(model)` shows that file.

# %%
swing = lissom.Model("A swinging bar", gravity=[0, 0, -9.81])
swing.bodies["bar"] = Body(mass=2, inertia=[1e-3, 0.17, 0.17], position=[0.5, 0, 0])
swing.joints["hinge"] = joints.Revolute(base="ground", tip="bar", at=[0, 0, 0], axis=[0, 1, 0])
swing.outputs["hinge"] = outputs.Relative(of="hinge")
swing.outputs["energy"] = outputs.Energy()
swing.analysis = analyses.Dynamics(end=2, step=5e-3)
print(swing)
fall = swing.run()
values["swing"] = fall["hinge.angle"][-1]
assert np.abs(fall["energy.total"] - fall["energy.total"][0]).max() < 1e-2

# %% [markdown]
# ## Step by step, with a controller in Python

# %%
arm = lissom.load(EXAMPLES / "controlled-arm.toml", **{"analysis.end": 0.6})


def target(sim: lissom.Simulation) -> float:
    """Where the arm is to be: called every 10 ms."""
    return 0.8 if sim.time < 0.3 else 0.5


driven = arm.run(inputs={"target": target}, sample=0.01)
print(driven["arm.angle"][-1])

# %% [markdown]
# A simulation can be taken by hand, and gone back to.

# %%
sim = arm.simulation()
sim.step_to(0.2)
kept = sim.snapshot()
sim.step_to(0.25)
there = sim["arm.angle"]
sim.restore(kept)
sim.step_to(0.25)
assert sim["arm.angle"] == there

# %% [markdown]
# ## Many models

# %%
table = lissom.sweep(pendulum, {"point_masses.bob.mass": [1, 2, 4]}, collect={"swing": "max(bob.x)"})
values["sweep_swing"] = table["swing"][2]
print(table["swing"])
