"""A hinge that gives way against Lagrange's equations, the five coordinates, MuJoCo, energy, and a rigid hinge."""

import dataclasses
import functools
import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import wingbeat as wb
from tests.helpers import hinge_oracle
from tests.helpers.models import changed
from tests.helpers.oracle_coefficients import su_fan
from tests.helpers.programs import compiled
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.state_rates import body_rates, rate_table

TOLERANCE = 1e-9
UNSTEADY = {"steady": {}, "unsteady": {"unsteady": "thin-aerofoil", "share": 0.7}}


@dataclasses.dataclass(frozen=True)
class Case:
    """One flight at an instant: q = (x, z, body_pitch, hinge angle), and its rates."""

    model: wb.FlightModel
    wingbeat: wb.Wingbeat
    q: np.ndarray
    v: np.ndarray
    phase: float

    @property
    def state(self):
        """(body_pitch, u, w, pitch_rate, hinge_angle, hinge_rate)."""
        return np.array([self.q[2], *self.v[:3], self.q[3], self.v[3]])

    def flier(self, **changes):
        """The same for the oracle; `changes` are dictionaries by the names of its parts."""
        vehicle = {part: vars(record) for part, record in vars(self.model.vehicle).items() if record is not None}
        parts = {"wingbeat": vars(self.wingbeat), "hinge": vars(self.wingbeat.pitch_hinge), **vehicle}
        parts = {name: numbers | changes.get(name, {}) for name, numbers in parts.items()}
        wingbeat, hinge = parts.pop("wingbeat"), parts.pop("hinge")
        return hinge_oracle.HingedFlier(
            parts, wingbeat, hinge, vars(self.model.air), su_fan, share=float(self.model.unsteady)
        )

    def wanted(self, **changes):
        """The oracle's x'', z'', psi'' and theta''."""
        return hinge_oracle.accelerations(self.flier(**changes), self.q, self.v, self.phase)


@compiled
def all_rates(model, wingbeat, state, phase):
    return body_rates(model, rate_table(model, wingbeat, phase), state)


def found(case):
    """Return x'', z'', psi'' and theta'' by the package."""
    return np.asarray(all_rates(case.model, case.wingbeat, case.state, case.phase))[[1, 2, 3, 5]]


def draw(uniform, air, twist_share):
    """Draw a flight in which every law and place that a hinge meets is at work."""
    wing = wb.Wing(
        uniform(0.2, 0.4),
        tuple(uniform(0.05, 0.15, 4).tolist()),
        uniform(0.004, 0.03),
        uniform(0.0, 3.0),
        tuple(uniform(-0.04, 0.04, 3).tolist()),
        uniform(0.8, 2.2),
        pitch_axis=uniform(0.0, 0.5),
        mass_axis=uniform(0.1, 0.6),
        mass_gyration=uniform(0.1, 0.4),
    )
    body = wb.Body(uniform(0.1, 0.5), uniform(1e-4, 1e-3), uniform(1e-4, 2e-3))
    tail = wb.Tail(uniform(1e-3, 1e-2), uniform(-0.1, 0.3), uniform(1, 4), uniform(0, 0.1), *uniform(-0.2, 0.2, 2))
    hinge = wb.PitchHinge(
        uniform(0.1, 3.0),
        uniform(0.0, 0.05),
        uniform(-0.5, 0.5),
        stop_angle=uniform(0.2, 0.8),
        stop_stiffness=uniform(0.5, 5.0),
        twist_share=twist_share,
    )
    wingbeat = wb.Wingbeat(
        frequency=uniform(3, 12),
        flap_mean=uniform(-0.3, 0.3),
        flap_amplitude=uniform(0.2, 1.2),
        pitch_mean=uniform(-0.3, 0.5),
        pitch_amplitude=uniform(0.0, 0.8),
        span_retraction=uniform(0.05, 0.5),
        twist_ratio=uniform(0.5, 2.0),
        fold_amplitude=uniform(0.05, 0.6),
        wrist=uniform(0.2, 0.8),
        pitch_phase=uniform(-1.0, 1.0),
        sweep_mean=uniform(-0.3, 0.3),
        sweep_amplitude=uniform(0.05, 0.4),
        sweep_phase=uniform(-3.0, 3.0),
        stroke_plane_tilt=uniform(-0.5, 0.5),
        tail_tilt=0.3,
        chord_retraction=0.2,
        twist_mean=-0.1,
        pitch_hinge=hinge,
    )
    aero = wb.aero.BladeElement(wb.aero.SuFan(), 10, "centre-of-pressure", **UNSTEADY[air])
    q = np.array([0.0, 0.0, uniform(-1, 1), uniform(-0.8, 0.8)])
    v = np.array([uniform(-2, 12), uniform(-3, 3), uniform(-8, 8), uniform(-30, 30)])
    return Case(wb.FlightModel(wb.Vehicle(body, wing, tail), aero), wingbeat, q, v, uniform(-0.5, 1.5))


@functools.cache
def cases(air, twist_share, count=8):
    """Return random flights none of whose strips is within a blend, which the oracle's coefficients lack."""
    uniform, those = np.random.default_rng([*map(ord, air), int(2 * twist_share)]).uniform, []
    while len(those) < count:
        case = draw(uniform, air, twist_share)
        try:
            those.append((case, case.wanted()))
        except ValueError:
            continue
    return those


# --- Lagrange's equations


@pytest.mark.slow
@pytest.mark.parametrize("twist_share", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("air", UNSTEADY)
def test_accelerations_are_those_of_lagrange(air, twist_share):
    for case, wanted in cases(air, twist_share):
        np.testing.assert_allclose(found(case), wanted, rtol=TOLERANCE, atol=TOLERANCE)


@pytest.mark.slow
@pytest.mark.parametrize("air", UNSTEADY)
def test_pieces_of_a_rigid_wing_move_as_lagrange_says(air):
    """Of spar, skin and joints; the oracle has the pieces themselves, the package ten strips."""
    uniform, compared = np.random.default_rng(58).uniform, 0
    aero = wb.aero.BladeElement(wb.aero.SuFan(), 10, "centre-of-pressure", **UNSTEADY[air])
    plain = {"mass_exponent": 0.0, "mass_axis": 0.5, "mass_gyration": wb.Wing.mass_gyration}
    rigid = {"twist_ratio": 1.0, "twist_mean": 0.0, "fold_amplitude": 0.0}
    while compared < 4:
        case, masses = draw(uniform, air, 0.0), uniform(1e-4, 1e-3, 24)
        table = {
            "mass_stations": tuple(uniform(0.0, 1.0, 24)),
            "station_masses": tuple(masses),
            "station_axes": tuple(uniform(0.0, 0.8, 24)),
            "station_gyrations": tuple(uniform(0.1, 0.3, 24)),
        }
        wing = dataclasses.replace(case.model.vehicle.wing, mass=float(masses.sum()), **plain, **table)
        model = wb.FlightModel(dataclasses.replace(case.model.vehicle, wing=wing), aero)
        case = dataclasses.replace(case, model=model, wingbeat=dataclasses.replace(case.wingbeat, **rigid))
        try:
            wanted = case.wanted()
        except ValueError as error:
            if "blend" not in str(error):
                raise
            continue
        np.testing.assert_allclose(found(case), wanted, rtol=TOLERANCE, atol=TOLERANCE)
        compared += 1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("part", "name"),
    [
        *(("hinge", name) for name in ("stiffness", "damping", "rest_angle", "stop_angle", "stop_stiffness")),
        *(("wing", name) for name in ("pitch_axis", "mass_axis", "mass_gyration", "mass", "mass_exponent")),
        *(("wingbeat", name) for name in ("twist_ratio", "span_retraction", "fold_amplitude", "sweep_amplitude")),
        *(("wingbeat", name) for name in ("chord_retraction", "twist_mean", "frequency")),
    ],
)
def test_the_comparison_sees_a_millionth(part, name):
    """Of one flight in eight, at least, whose numbers are drawn apart: a stop may be far."""
    gaps = []
    for case, _ in cases("unsteady", 0.5):
        flier = case.flier()
        value = (flier.vehicle | {"hinge": flier.hinge, "wingbeat": flier.wingbeat})[part][name]
        gaps.append(np.max(np.abs(found(case) / case.wanted(**{part: {name: value * (1 + 1e-6)}}) - 1.0)))
    assert max(gaps) > 10 * TOLERANCE


def flap_of(case):
    """Return the flap angle and its first two time derivatives."""
    beat, turn, pace = case.wingbeat, 2.0 * math.pi * case.phase, 2.0 * math.pi * case.wingbeat.frequency
    swing, lag = (beat.flap_amplitude * law(turn) for law in (math.cos, math.sin))
    return beat.flap_mean + swing, -pace * lag, -(pace**2) * swing


# --- The five coordinates, whose fifth torque is that of spring, damper and stops


@pytest.mark.slow
@pytest.mark.parametrize("air", UNSTEADY)
def test_the_five_coordinates_with_the_torque_of_spring_and_damper(air):
    for case, _ in cases(air, 0.0):
        hinge, beat = case.wingbeat.pitch_hinge, dataclasses.replace(case.wingbeat, pitch_hinge=None)
        flap = flap_of(case)
        q, q_dot = (np.array([*a[:3], flap[i], a[3]]) for i, a in enumerate((case.q, case.v)))
        time = case.phase / beat.frequency
        terms = wb.equations_of_motion(case.model, beat, q, q_dot, time)
        air_loads = wb.air_forces(case.model, beat, q, q_dot, time)
        matrix = np.asarray(terms.mass_matrix + air_loads.added_mass)
        resisting = terms.velocity_matrix @ q_dot + terms.time_force + terms.gravity_force
        right = np.asarray(air_loads.generalised - resisting) - matrix[:, 3] * flap[2]
        right[4] += hinge_oracle.stop_torque(vars(hinge), q[4]) - hinge.damping * q_dot[4]
        right[4] -= hinge.stiffness * (q[4] - hinge.rest_angle)
        free = [0, 1, 2, 4]
        wanted = np.linalg.solve(matrix[np.ix_(free, free)], right[free])
        np.testing.assert_allclose(found(case), wanted, rtol=TOLERANCE)


# --- MuJoCo, whose joint has a spring and a damper of its own


STILL = '<inertial pos="0 0 0" mass="1e-14" diaginertia="1e-14 1e-14 1e-14"/>'
TURNED = (np.arange(10) + 0.5) / 10


def numbers(*values):
    return " ".join(repr(float(value)) for value in values)


def strip_bodies(wing, side, sign, *, twists):
    """Return the strips of a wing as bodies on its pitch axis, all fixed to it or each on a joint of its own."""
    stations = np.atleast_1d(wing.chord)
    chords = np.interp(TURNED, np.linspace(0.0, 1.0, stations.size), stations)
    weights, text = (1.0 - TURNED) ** wing.mass_exponent, ""
    for i, (place, chord, weight) in enumerate(zip(TURNED, chords, weights / weights.sum(), strict=True)):
        mass, joint = wing.mass * weight, f'<joint name="{side}-{i}" axis="0 -1 0"/>' if twists else ""
        turning, ahead = mass * (wing.mass_gyration * chord) ** 2, (wing.pitch_axis - wing.mass_axis) * chord
        text += f"""<body pos="{numbers(0, sign * place * wing.semi_span, 0)}">{joint}<inertial
            pos="{numbers(ahead, 0, 0)}" mass="{numbers(mass)}" diaginertia="{numbers(1e-14, turning, turning)}"/>
            </body>"""
    return text


def mujoco_model(mujoco, vehicle, hinge, gravity):
    """Build the flier: each wing's hinge a joint with spring and damper, or its twist a tendon with both."""
    wing, body, wings, tendons, twists = vehicle.wing, vehicle.body, "", "", hinge.twist_share == 1.0
    spring = f'stiffness="{numbers(hinge.stiffness / 2)}" damping="{numbers(hinge.damping / 2)}"'
    rest, beta, (forward, left, up) = numbers(hinge.rest_angle), wing.stroke_plane_angle, wing.shoulder
    for side, sign in (("left", 1.0), ("right", -1.0)):
        joint = "" if twists else f'<joint name="{side}-0" axis="0 -1 0" {spring} springref="{rest}"/>'
        axes = numbers(math.sin(beta), 0, math.cos(beta), 0, 1, 0)
        wings += f"""<body pos="{numbers(forward, sign * left, up)}" xyaxes="{axes}">
            <joint name="{side}" axis="{sign} 0 0"/>{STILL}
            <body>{joint}{STILL}{strip_bodies(wing, side, sign, twists=twists)}</body></body>"""
        # A tendon as long as the twist of the tip, of which the last strip has 0.95.
        tendons += f'<fixed {spring} springlength="{rest}"><joint joint="{side}-9" coef="{1 / 0.95}"/></fixed>'
    return mujoco.MjModel.from_xml_string(f"""<mujoco>
      <compiler angle="radian" autolimits="false" boundmass="0" boundinertia="0" balanceinertia="false"/>
      <option gravity="0 0 {-gravity}"><flag contact="disable" constraint="disable"/></option><worldbody>
      <body name="body"><joint name="x" type="slide" axis="1 0 0"/><joint name="z" type="slide" axis="0 0 1"/>
      <joint name="pitch" axis="0 -1 0"/><inertial pos="0 0 0" mass="{numbers(body.mass)}"
      diaginertia="{numbers(*[body.pitch_inertia] * 3)}"/>{wings}</body></worldbody>
      {f"<tendon>{tendons}</tendon>" if twists else ""}</mujoco>""")


def without_air(case):
    """Return the flight in air that is hardly there, by the laws that MuJoCo's model has."""
    off = dict.fromkeys(("span_retraction", "fold_amplitude", "sweep_mean", "sweep_amplitude", "twist_mean"), 0.0)
    off |= {"pitch_mean": 0.0, "pitch_amplitude": 0.0, "stroke_plane_tilt": 0.0, "twist_ratio": 1.0}
    hinge = dataclasses.replace(case.wingbeat.pitch_hinge, stop_stiffness=0.0, rest_angle=0.3)
    vehicle = dataclasses.replace(case.model.vehicle, tail=None)
    model = changed(case.model, vehicle=vehicle, air=wb.Air(density=1e-9))
    beat = dataclasses.replace(case.wingbeat, **off, pitch_hinge=hinge)
    return dataclasses.replace(case, model=model, wingbeat=beat)


@pytest.mark.slow
@pytest.mark.parametrize("twist_share", [0.0, 1.0])
def test_mujoco_accelerates_as_we_do(twist_share):
    """Nothing drives the hinge, nothing holds the body, and the flap hinges take the torque that is ours."""
    mujoco = pytest.importorskip("mujoco")
    for case in (without_air(case) for case, _ in cases("steady", twist_share)):
        vehicle, beat, hinge = case.model.vehicle, case.wingbeat, case.wingbeat.pitch_hinge
        model = mujoco_model(mujoco, vehicle, hinge, case.model.air.gravity)
        data, moved, flap = mujoco.MjData(model), np.zeros((model.nv, 5)), flap_of(case)
        for place, name in enumerate(("x", "z", "pitch")):
            moved[model.joint(name).dofadr[0], place] = 1.0
        drives = [model.joint(side).dofadr[0] for side in ("left", "right")]
        for side, drive in zip(("left", "right"), drives, strict=True):
            moved[drive, 3] = 1.0
            for i, share in enumerate(TURNED if twist_share else [1.0]):
                moved[model.joint(f"{side}-{i}").dofadr[0], 4] = share
        ours, body = found(case), State(0.0, 0.0, case.q[2], *case.v[:3])
        torque = wb.flight_loads(case.model, beat, body, case.phase, hinge=case.state[4:]).flap_torque
        data.qpos[:] = moved @ [*case.q[:3], flap[0], case.q[3]]
        data.qvel[:] = moved @ [*case.v[:3], flap[1], case.v[3]]
        acceleration = moved @ [*ours[:3], flap[2], ours[3]]
        data.qacc[:] = acceleration
        mujoco.mj_inverse(model, data)
        weight = vehicle.mass * case.model.air.gravity
        sizes = [weight, weight, abs(torque), abs(torque), abs(hinge.torque(case.q[3], case.v[3]))]
        assert np.abs((data.qfrc_inverse @ moved - [0, 0, 0, torque, 0]) / sizes).max() <= 1e-6
        if twist_share == 0:  # with strips on joints of their own, forward dynamics are those of another wing
            data.qfrc_applied[drives] = torque / 2
            mujoco.mj_forward(model, data)
            np.testing.assert_allclose(data.qacc, acceleration, rtol=1e-6, atol=1e-6)


# --- A rigid hinge is the prescribed pitch


@pytest.mark.slow
def test_a_stiff_hinge_needs_the_torque_that_holds_a_prescribed_pitch():
    """Where its spring has this torque, a hinge stays in place, and the body does what it does with that pitch."""
    for case, _ in cases("unsteady", 0.0):
        rest = case.wingbeat.pitch_hinge.rest_angle
        held = dataclasses.replace(case.wingbeat, pitch_mean=rest, pitch_amplitude=0.0, pitch_hinge=None)
        prescribed = wb.flight_loads(case.model, held, State(0.0, 0.0, *case.state[:4]), case.phase)
        torque, misses = float(prescribed.pitch_torque), []
        for stiffness in (1e3, 1e4, 1e5):
            hinge = wb.PitchHinge(stiffness, rest_angle=rest)
            beat, angle = dataclasses.replace(case.wingbeat, pitch_hinge=hinge), rest - torque / stiffness
            rates = np.asarray(all_rates(case.model, beat, np.array([*case.state[:4], angle, 0.0]), case.phase))
            misses.append(np.append(rates[1:4] - prescribed.acceleration, rates[5]))
        first, second, third = np.abs(misses)
        for stiff, stiffer in ((first, second), (second, third)):
            rounding = 1e-7 * np.abs(prescribed.acceleration).max()
            np.testing.assert_allclose(stiffer, 0.1 * stiff, rtol=0.15, atol=rounding)


# --- Properties


angles, rates_of_change = st.floats(-1.5, 1.5), st.floats(-100, 100)
hinges = st.builds(
    wb.PitchHinge,
    stiffness=st.floats(1e-3, 1e3),
    damping=st.floats(0.0, 1.0),
    rest_angle=st.floats(-0.7, 0.7),
    stop_angle=st.floats(0.0, 1.5),
    stop_stiffness=st.sampled_from([0.0, 0.5, 20.0]),
    twist_share=st.sampled_from([0.0, 0.3, 1.0]),
)
QUICK = settings(deadline=None, max_examples=40, suppress_health_check=[HealthCheck.too_slow])


@given(hinge=hinges, angle=angles, rate=rates_of_change)
@QUICK
def test_spring_and_stops_pull_back_and_the_damper_takes_power(hinge, angle, rate):
    def torque(angle, rate):
        return float(hinge.torque(angle, rate))

    assert torque(angle, rate) <= torque(angle - 0.1, rate)  # steeper never pulls less
    assert (torque(angle, rate) - torque(angle, 0.0)) * rate <= 0
    mirrored = dataclasses.replace(hinge, rest_angle=-hinge.rest_angle)
    assert float(mirrored.torque(-angle, -rate)) == pytest.approx(-torque(angle, rate), rel=1e-12, abs=1e-12)


@pytest.mark.slow
@given(hinge=hinges, angle=angles, rate=rates_of_change)
@QUICK
def test_accelerations_are_linear_in_the_torque_of_the_hinge(hinge, angle, rate):
    """A torque at the hinge accelerates body and hinge by one column of the inverse of the mass matrix."""
    case, _ = cases("unsteady", 0.3)[0]
    state = np.array([*case.state[:4], angle, rate])

    def accelerations(**changes):
        own = dataclasses.replace(hinge, twist_share=0.3, **changes)
        beat = dataclasses.replace(case.wingbeat, pitch_hinge=own)
        return np.asarray(all_rates(case.model, beat, state, case.phase))[[1, 2, 3, 5]], float(
            own.torque(angle, rate)
        )

    (base, none), (soft, some), (stiff, more) = (
        accelerations(stiffness=k, stop_stiffness=1e-9) for k in (1e-9, 1.0, 5.0)
    )
    if abs(some - none) < 1e-3:
        return
    slope = (soft - base) / (some - none)
    np.testing.assert_allclose(stiff, base + slope * (more - none), rtol=1e-9, atol=1e-9 * np.abs(stiff).max())
    assert slope[3] > 0


@given(
    wrong=st.sampled_from(["stiffness", "damping", "stop_stiffness", "twist_share", "stop_angle"]),
    value=st.one_of(st.floats(max_value=-1e-9), st.just(math.nan), st.just(math.inf)),
)
@QUICK
def test_numbers_that_no_hinge_has_are_refused_by_name(wrong, value):
    with pytest.raises(wb.InvalidInputError, match=rf"pitch_hinge\.{wrong}"):
        wb.PitchHinge(**{"stiffness": 1.0, wrong: value})


def test_without_its_motion_a_wing_that_gives_way_has_no_loads():
    case, _ = cases("steady", 0.0)[0]
    with pytest.raises(wb.InvalidInputError, match="gives way"):
        wb.flight_loads(case.model, case.wingbeat, State(u=8.0), 0.0)
