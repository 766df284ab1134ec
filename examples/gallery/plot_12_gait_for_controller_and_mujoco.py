"""
How do I get the gait into my controller or MuJoCo?
===================================================

A certified orbit is a set of time series: angles for the servos, torques for the motors. A controller needs them
as a table at equal time steps, and a simulator needs them as a model of the robot.
"""

# %%
# Solve for the orbit of a robot whose wings do not change their span: the pigeon with rigid wings.
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

import wingbeat as wb
from wingbeat._base.style import BLUE, VERMILION

robot = wb.load_species("pigeon").with_values({"wingbeat.span_retraction": 0.0})
orbit = wb.solve_orbit(wb.OrbitProblem(robot, speed=12.0), starts=2)
assert orbit.status is wb.Status.CONVERGED

# %%
# The suffix of the file chooses the format: a table for a controller, a model for MuJoCo.
folder = Path(tempfile.mkdtemp())
wb.export(orbit, folder / "gait.csv", samples=200)
wb.export(orbit, folder / "robot.xml")
gait = pd.read_csv(folder / "gait.csv", comment="#")

# %%
# ``MujocoFlight`` (extra ``mujoco``) flies the model in MuJoCo with wingbeat's air loads.
flight = wb.MujocoFlight(orbit, steps=256)
flown = flight.fly(beats=1)
ours = wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, beats=1, samples=256)
apart = np.abs(flown.states - ours.states).max(axis=0)

# %%
# What the controller gets: the angles of a wing (left) and the torque that one flap motor must give (middle). The
# body pitch in MuJoCo is that of the orbit (right).
figure, panels = plt.subplots(1, 3, figsize=(8.6, 3.0), layout="constrained")
time = 1e3 * gait["time"]
panels[0].plot(time, np.degrees(gait["flap"]), color=BLUE, label="flap")
panels[0].plot(time, np.degrees(gait["wing_pitch"]), color=VERMILION, linestyle="--", label="wing pitch")
panels[0].set(xlabel="time [ms]", ylabel="angle [deg]")
panels[0].legend(frameon=False)
panels[1].plot(time, gait["flap_torque_per_wing"], color=BLUE)
panels[1].set(xlabel="time [ms]", ylabel="flap torque of one wing [N m]")
beat = 1e3 * ours.time
panels[2].plot(beat, np.degrees(ours.states[:, 2]), color=BLUE, label="wingbeat")
panels[2].plot(beat[::16], np.degrees(flown.states[::16, 2]), "o", color=VERMILION, label="MuJoCo")
panels[2].set(xlabel="time [ms]", ylabel="body pitch [deg]")
panels[2].legend(frameon=False)
for axes in panels:
    axes.spines[["top", "right"]].set_visible(False)

# %%
# The answer:
assert apart[2] < 1e-4
print(
    f"The table has {len(gait)} rows and the flap motor of one wing must give at most "
    f"{np.abs(gait['flap_torque_per_wing']).max():.2f} N m. In a beat in MuJoCo the body pitch differs from ours "
    f"by at most {np.degrees(apart[2]):.0e} degrees."
)
