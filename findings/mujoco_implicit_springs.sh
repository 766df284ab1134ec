#!/usr/bin/env bash
# A stiff hinge in MuJoCo: which integrator keeps it?
#
# One would guess: the integrators `implicit` and `implicitfast` take stiff springs, as implicit methods do, and RK4,
# which is explicit, is the one to lose both springs and dampers first.
#
# What happens (MuJoCo 4.0.0): `implicit`, `implicitfast` and Euler are implicit in velocities alone. A damper of any
# strength is safe with them; a spring is not: with a step h, an inertia J and a stiffness k they diverge beyond
# k h^2/J = 4, all three with the same numbers. RK4 is the other way round: it still damps a spring at 5, and
# diverges with a damper c beyond c h/J = 2.8. A damper beside it rescues the spring with the implicit ones.
#
# Where it bites: a hinge that is made nearly rigid by a stiff spring is not saved by a change to an implicit
# integrator, and one that is made slow by a strong damper is lost by a change to RK4. MuJoCo warns only when numbers
# are near infinity, and then puts the model back to its start.
set -euo pipefail
command -v python3 >/dev/null || { echo "missing: python3"; exit 77; }
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
python3 -m venv "$tmp/venv" || { echo "missing: python3-venv"; exit 77; }
"$tmp/venv/bin/pip" -q install mujoco==4.0.0 numpy
cd "$tmp"
"$tmp/venv/bin/python" - <<'PY'
import mujoco

print("mujoco", mujoco.__version__)
TEXT = """<mujoco><option gravity="0 0 0" timestep="1" integrator="{0}"/><worldbody><body>
<joint type="hinge" axis="0 1 0" stiffness="{1}" damping="{2}"/>
<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody></mujoco>"""


def largest(integrator, stiffness, damping):
    """Return the largest speed in eight steps of length 1 of a hinge of inertia 1, which starts with speed 1."""
    model = mujoco.MjModel.from_xml_string(TEXT.format(integrator, stiffness, damping))
    data, found = mujoco.MjData(model), []
    data.qpos[0], data.qvel[0] = 0.1, 1.0
    for _ in range(8):
        mujoco.mj_step(model, data)
        found.append(abs(float(data.qvel[0])))
    return max(found)


seen = {}
for what, stiffness, damping in (("spring", 5, 0), ("damper", 0, 5), ("both", 5, 5)):
    for integrator in ("Euler", "implicit", "implicitfast", "RK4"):
        seen[what, integrator] = largest(integrator, stiffness, damping)
        print(f"{what:7} {integrator:13} largest speed {seen[what, integrator]:.4g}")
for integrator in ("Euler", "implicit", "implicitfast"):
    assert seen["spring", integrator] > 100
    assert seen["damper", integrator] < 1 and seen["both", integrator] < 1
assert seen["spring", "RK4"] < 1
assert seen["damper", "RK4"] > 100 and seen["both", "RK4"] > 100
PY
