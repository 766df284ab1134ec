#!/usr/bin/env bash
# One would guess that MuJoCo's activation "filterexact", a first-order lag integrated exactly, is the more exact one
# with every integrator. With RK4 it is the coarse one: after steps of 1 ms, a lag of 20 ms is wrong by 0.9 % of the
# command, as much as plain "filter" with Euler, because the exact increment is taken at stages that are averaged. With
# RK4 the plain "filter" is right to 1e-6.
# It bites whoever gives a servo of known bandwidth to a simulation that flies with RK4.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet numpy==2.3.5 mujoco==4.0.0
"$folder/venv/bin/python" - <<'PYTHON'
import mujoco
import numpy as np

print("mujoco", mujoco.__version__)
wrong = {}
for integrator in ("Euler", "implicitfast", "RK4"):
    for lag in ("filter", "filterexact"):
        model = mujoco.MjModel.from_xml_string(f"""
            <mujoco><option timestep="0.001" integrator="{integrator}" gravity="0 0 0"/>
            <worldbody><body><joint name="j" type="slide"/><geom size="0.1" mass="1"/></body></worldbody>
            <actuator><general joint="j" dyntype="{lag}" dynprm="0.02"/></actuator></mujoco>""")
        data, found = mujoco.MjData(model), []
        data.ctrl[0] = 1.0
        for _ in range(100):
            mujoco.mj_step(model, data)
            found.append(data.act[0])
        exact = 1.0 - np.exp(-np.arange(1, 101) * 0.001 / 0.02)
        wrong[integrator, lag] = np.abs(found - exact).max()
        print(f"{integrator:13} {lag:12} largest error {wrong[integrator, lag]:.1e}")
assert wrong["Euler", "filterexact"] < 1e-12 and wrong["implicitfast", "filterexact"] < 1e-12
assert wrong["RK4", "filterexact"] > 0.009
assert wrong["RK4", "filter"] < 1e-6
PYTHON
