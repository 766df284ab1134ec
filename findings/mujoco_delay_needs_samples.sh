#!/usr/bin/env bash
# One would guess that an actuator of MuJoCo with delay="0.01" acts 10 ms late, or that a history too short for that is
# refused. With nsample="5" and steps of 1 ms it acts 5 ms late, and the model loads without a warning: the oldest
# command in the history is taken for the one asked for. A delay that is no multiple of the step is rounded up.
# It bites whoever raises the rate of a simulation with a delay: at half the step, half the delay is left.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet numpy==2.3.5 mujoco==4.0.0
"$folder/venv/bin/python" - <<'PYTHON'
import mujoco

print("mujoco", mujoco.__version__)


def late(step, delay, samples):
    """Return by how much the force comes later than the command, in seconds."""
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><option timestep="{step}" gravity="0 0 0"/>
        <worldbody><body><joint name="j" type="slide"/><geom size="0.1" mass="1"/></body></worldbody>
        <actuator><general joint="j" delay="{delay}" nsample="{samples}"/></actuator></mujoco>""")
    data = mujoco.MjData(model)
    for _ in range(5):
        mujoco.mj_step(model, data)
    data.ctrl[0] = 1.0
    for steps in range(100):
        mujoco.mj_step(model, data)
        if data.actuator_force[0] > 0.5:
            return round(steps * step, 6)


for step, delay, samples, seen in (
    (0.001, 0.01, 20, 0.01),
    (0.001, 0.01, 10, 0.01),
    (0.001, 0.01, 5, 0.005),
    (0.0005, 0.01, 10, 0.005),
    (0.003, 0.01, 20, 0.012),
):
    found = late(step, delay, samples)
    print(f"step {1e3 * step} ms, delay {1e3 * delay} ms, {samples} samples: {1e3 * found} ms late")
    assert found == seen
PYTHON
