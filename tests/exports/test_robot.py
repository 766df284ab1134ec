"""URDF and SDF of a vehicle, read by Drake: masses, inertias, places, joints and limits are ours."""

import dataclasses
from xml.etree import ElementTree

import numpy as np
import pytest

import wingbeat as wb
from tests.exports.conftest import derivative

pytestmark = pytest.mark.slow

parsing = pytest.importorskip("pydrake.multibody.parsing")
from pydrake.math import RigidTransform, RotationMatrix  # noqa: E402
from pydrake.multibody.plant import MultibodyPlant  # noqa: E402
from pydrake.multibody.tree import ForceElementIndex, RevoluteSpring  # noqa: E402

SAMPLES = 32
SIDES = {"left": 1.0, "right": -1.0}
# What stands for no mass and no inertia, in kg and kg m2; a wing of ten strips has up to 21 links with it.
NOTHING = 1e-14


@pytest.fixture(scope="module")
def twisted_orbit(rigid_orbit):
    """A twist ratio, and a constant twist; a wingbeat that was not solved for, so the beat does not close."""
    record = rigid_orbit.record()
    record["wingbeat"] |= {"twist_ratio": 1.5, "twist_mean": 0.05}
    return wb.Orbit.of_record(record, rigid_orbit.problem, starts=2)


@pytest.fixture(scope="module")
def waving_orbit(rigid_orbit):
    """A twist by a law of its own, beside the twist ratio."""
    record = rigid_orbit.record()
    record["wingbeat"] |= {"twist_ratio": 1.5, "twist_harmonics": [0.05, 0.02]}
    return wb.Orbit.of_record(record, rigid_orbit.problem, starts=2)


@pytest.fixture(params=["rigid", "pigeon", "bat", "swept", "twisted", "waving", "passive", "off_axis"])
def orbit(request):
    if request.param == "swept":  # without the twist of its own, which makes strips of it
        record = (rigid := request.getfixturevalue("rigid_orbit")).record()
        record["wingbeat"] |= {"sweep_mean": 0.05, "sweep_amplitude": 0.1}
        return wb.Orbit.of_record(record, rigid.problem, starts=2)
    found = request.getfixturevalue(f"{request.param}_orbit")
    return getattr(found, "orbit", found)


class Read:
    """A file of an orbit as Drake reads it, and the gait for its joints."""

    def __init__(self, orbit, suffix, folder):
        path = folder / f"robot{suffix}"
        wb.export(orbit, path, samples=SAMPLES)
        self.top = ElementTree.fromstring(path.read_bytes())
        self.plant = MultibodyPlant(0.0)
        (model,) = parsing.Parser(self.plant).AddModels(str(path))
        self.plant.Finalize()
        self.links = [self.plant.get_body(i) for i in self.plant.GetBodyIndices(model)]
        self.joints = [self.plant.get_joint(i) for i in self.plant.GetJointIndices(model)]
        self.joints = {j.name(): j for j in self.joints if j.num_velocities() == 1}
        self.context = self.plant.CreateDefaultContext()
        start = orbit.initial_state, 1, SAMPLES
        hinge = orbit.record().get("hinge_start")
        self.series = wb.simulate(orbit.problem.model, orbit.wingbeat, *start, hinge=hinge).dataset
        self.orbit = orbit

    def law(self, name, k):
        if name == "tip_twist":
            beat, turn = self.orbit.wingbeat, 2 * np.pi * k / SAMPLES
            return beat.twist_mean + np.dot((beat.twist_harmonics or (0, 0)), (np.cos(turn), np.sin(turn)))
        return float(self.series[name].values[k])

    def share(self, joint, law):
        """Return how far a joint moves if a law moves by one."""
        kind = joint.split("_", 1)[1]
        if kind in ("flap", "wing_pitch", "fold", "sweep"):
            return float(kind == law)
        wing, beat = self.orbit.problem.vehicle.wing, self.orbit.wingbeat
        hand, strip = beat.wrist if beat.fold_amplitude else 1.0, kind.rsplit("_", 1)[1]
        at = hand if strip == "hand" else (int(strip) - 0.5) / self.series.sizes["station"]
        if kind.startswith("span"):
            return float(law == "span_ratio") * wing.semi_span * (at - hand * (at > hand))
        return {"wing_pitch": 1 + (beat.twist_ratio - 1) * at, "tip_twist": at}.get(law, 0.0)

    def position(self, joint, k):
        laws = ("flap", "wing_pitch", "sweep", "span_ratio", "fold", "tip_twist")
        return sum(self.share(joint, law) * (self.law(law, k) - (law == "span_ratio")) for law in laws)

    def pose(self, k, body_pitch=0.0, place=(0.0, 0.0, 0.0)):
        """Place the body, and the wings as in the gait's sample k."""
        turned = RigidTransform(RotationMatrix.MakeYRotation(-body_pitch), place)
        values = self.plant.GetPositions(self.context)
        for name, joint in self.joints.items():
            values[joint.position_start()] = self.position(name, k)
        self.plant.SetPositions(self.context, values)
        self.plant.SetFreeBodyPose(self.context, self.plant.GetBodyByName("body"), turned)


def wing_points(orbit, read, k):
    """Return the left wing's strips in body axes by plain formulas: masses, quarter chords, chord vectors."""
    wing, beat, count = orbit.problem.vehicle.wing, orbit.wingbeat, read.series.sizes["station"]
    flap, pitch, sweep, span, fold, twist = (
        read.law(name, k) for name in ("flap", "wing_pitch", "sweep", "span_ratio", "fold", "tip_twist")
    )
    angle = wing.stroke_plane_angle + beat.stroke_plane_tilt
    axes = np.array([[np.sin(angle), 0, np.cos(angle)], [0, 1, 0], [-np.cos(angle), 0, np.sin(angle)]])
    at = (np.arange(count) + 0.5) / count
    stations = np.atleast_1d(wing.chord)
    chord = (
        np.interp(at, np.linspace(0, 1, len(stations)), stations)
        if len(stations) > 1
        else np.full(count, wing.chord)
    )
    mass = (1 - at) ** wing.mass_exponent
    place, fore = np.zeros((count, 3)), np.zeros((count, 3))
    out = [
        np.array([np.sin(sweep), np.cos(sweep) * np.cos(a), np.cos(sweep) * np.sin(a)]) for a in (flap, flap - fold)
    ]
    for i, s in enumerate(at):
        on_hand = s > beat.wrist
        place[i] = span * wing.semi_span * (min(s, beat.wrist) * out[0] + max(s - beat.wrist, 0) * out[1])
        a, p = flap - fold * on_hand, pitch * (1 + (beat.twist_ratio - 1) * s) + twist * s
        ahead = np.array([np.cos(sweep), -np.sin(sweep) * np.cos(a), -np.sin(sweep) * np.sin(a)])
        fore[i] = np.cos(p) * ahead + np.sin(p) * np.array([0, -np.sin(a), np.cos(a)])
    fore = chord[:, None] * (fore @ axes)
    quarter = np.array(wing.shoulder) + place @ axes + (wing.pitch_axis - 0.25) * fore
    return wing.mass * mass / mass.sum(), quarter, fore


def inertia_of(masses, points):
    """Return the inertia of mass points about the origin, shape (3, 3)."""
    return np.einsum(
        "n,nij->ij", masses, (points**2).sum(1)[:, None, None] * np.eye(3) - points[:, :, None] * points[:, None]
    )


def rods(wing, mass, quarter, chord):
    """Return mass points of strips: each a uniform rod along its chord, as three points by Simpson's rule."""
    middle, half = quarter + (0.25 - wing.mass_axis) * chord, np.sqrt(3) * wing.mass_gyration * chord
    points = [middle - half, middle, middle + half]
    return np.concatenate([mass / 6, mass * 4 / 6, mass / 6]), np.concatenate(points)


@pytest.mark.parametrize("suffix", [".urdf", ".sdf"])
def test_the_whole_vehicle_has_our_mass_centre_and_inertia(orbit, suffix, tmp_path):
    read = Read(orbit, suffix, tmp_path)
    vehicle = orbit.problem.vehicle
    body = read.plant.GetBodyByName("body").default_spatial_inertia()
    own = np.diag(body.CalcRotationalInertia().get_moments())
    assert own[1, 1] == pytest.approx(vehicle.body.pitch_inertia, rel=1e-12)
    for k in (0, 5, 19):
        read.pose(k)
        mass, points = rods(vehicle.wing, *wing_points(orbit, read, k))
        masses = np.concatenate([mass, mass, [vehicle.body.mass]])
        places = np.concatenate([points, points * [1, -1, 1], np.zeros((1, 3))])
        whole = masses.sum()
        centre = masses @ places / whole
        found = read.plant.CalcSpatialInertia(
            read.context, read.plant.world_frame(), [link.index() for link in read.links]
        )
        assert found.get_mass() == pytest.approx(vehicle.mass, rel=1e-9)
        np.testing.assert_allclose(found.get_com(), centre, rtol=0, atol=1e-9 * vehicle.wing.semi_span)
        ours = inertia_of(masses, places - centre) + own
        about = found.Shift(found.get_com()).CalcRotationalInertia().CopyToFullMatrix3()
        # Of a wing of strips, what stands for nothing adds up: to 1.2e-9 of the bat's inertia.
        slack = NOTHING * len(read.links) * (len(read.links) > 7)
        np.testing.assert_allclose(about, ours, rtol=0, atol=1e-9 * np.abs(ours).max() + slack)


@pytest.mark.parametrize("suffix", [".urdf", ".sdf"])
def test_each_link_has_our_mass_centre_and_inertia(orbit, suffix, tmp_path):
    read = Read(orbit, suffix, tmp_path)
    wing, count = orbit.problem.vehicle.wing, read.series.sizes["station"]
    mass, _, chord = wing_points(orbit, read, 0)
    chord = np.linalg.norm(chord, axis=1)
    ahead, station = np.array([1.0, 0.0, 0.0]), (np.arange(count) + 0.5) / count * wing.semi_span
    held = 0
    for link in read.links:
        side, _, name = link.name().partition("_")
        if side not in SIDES:
            continue
        inertia, strips = link.default_spatial_inertia(), []
        if name == "wing" and f"{side}_strip_1" not in [other.name() for other in read.links]:
            strips, along = list(range(count)), SIDES[side] * station
        elif name.startswith("strip"):
            strips, along = [int(name.split("_")[1]) - 1], np.zeros(count)
        if not strips:  # stands for nothing
            assert inertia.get_mass() == NOTHING
            continue
        held += len(strips)
        points = along[strips, None] * np.array([0.0, 1.0, 0.0])
        along_chord = chord[strips, None] * ahead
        points = points + (wing.pitch_axis - 0.25) * along_chord
        masses, points = rods(wing, mass[strips], points, along_chord)
        assert inertia.get_mass() == pytest.approx(masses.sum(), rel=1e-12)
        centre = masses @ points / masses.sum()
        np.testing.assert_allclose(inertia.get_com(), centre, rtol=0, atol=1e-12 * wing.semi_span)
        about = inertia.Shift(inertia.get_com()).CalcRotationalInertia().CopyToFullMatrix3()
        ours = inertia_of(masses, points - centre)
        # A strip is a rod; what it has about its chord stands for zero.
        np.testing.assert_allclose(
            about, ours, rtol=0, atol=1e-9 * np.abs(ours).max() + 1.01 * NOTHING * (len(strips) == 1)
        )
    assert held == 2 * count


@pytest.mark.parametrize("suffix", [".urdf", ".sdf"])
def test_joints_carry_the_strips_where_ours_are(orbit, suffix, tmp_path):
    read, wing = Read(orbit, suffix, tmp_path), orbit.problem.vehicle.wing
    away = (wing.pitch_axis - 0.25) * np.linalg.norm(wing_points(orbit, read, 0)[2], axis=1)
    for k in range(0, SAMPLES, 5):
        state = [float(read.series[name].values[k]) for name in ("body_pitch", "x", "z")]
        read.pose(k, state[0], (state[1], 0.0, state[2]))
        ours = read.series["strip_position"].values[k]
        for side, sign in SIDES.items():
            for i, place in enumerate(ours):
                name = f"{side}_strip_{i + 1}"
                apart = not read.plant.HasBodyNamed(name)
                link = read.plant.GetBodyByName(f"{side}_wing" if apart else name)
                at = [away[i], sign * (i + 0.5) / len(ours) * wing.semi_span * apart, 0.0]
                found = link.EvalPoseInWorld(read.context).multiply(at)
                np.testing.assert_allclose(found, place * [1, sign, 1], rtol=0, atol=1e-12)


@pytest.mark.parametrize("suffix", [".urdf", ".sdf"])
def test_the_mass_matrix_is_that_of_our_five_coordinates(orbit, suffix, tmp_path):
    read = Read(orbit, suffix, tmp_path)
    beat = orbit.wingbeat
    for k in (3, 17):
        read.pose(k, 0.3, (1.0, 0.0, 2.0))
        moved = np.zeros((read.plant.num_velocities(), 5))  # by x, z, body pitch, flap and wing pitch at the root
        first = read.plant.GetJointByName("body").velocity_start()
        moved[first + 3, 0] = moved[first + 5, 1] = 1.0
        moved[first + 1, 2] = -1.0
        for name, joint in read.joints.items():
            moved[joint.velocity_start(), 3:] = [read.share(name, law) for law in ("flap", "wing_pitch")]
        found = moved.T @ read.plant.CalcMassMatrix(read.context) @ moved
        q = np.array([1.0, 2.0, 0.3, read.law("flap", k), read.law("wing_pitch", k)])
        terms = wb.equations_of_motion(orbit.problem.model, beat, q, np.zeros(5), k / SAMPLES / beat.frequency)
        ours = np.asarray(terms.mass_matrix)
        scale = np.sqrt(np.outer(np.diag(ours), np.diag(ours)))
        slack = NOTHING * 40 * (len(read.joints) > 6)  # of links that stand for nothing
        assert (np.abs(found - ours) <= 1e-9 * scale + slack).all()


@pytest.mark.parametrize("suffix", [".urdf", ".sdf"])
def test_limits_are_those_of_bounds_torques_and_rates(orbit, suffix, tmp_path):
    read = Read(orbit, suffix, tmp_path)
    bounds, beat = orbit.problem.bounds, orbit.wingbeat
    limits = {}
    for joint in read.top.iter("joint"):
        node = joint.find("limit") if suffix == ".urdf" else joint.find("axis/limit")
        values = node.attrib if suffix == ".urdf" else {one.tag: one.text for one in node}
        limits[joint.get("name")] = {name: float(value) for name, value in values.items()}
    assert limits.keys() == read.joints.keys()
    followers = {joint.get("name") for joint in read.top.iter("joint") if joint.find(".//mimic") is not None}
    for name, joint in read.joints.items():
        own, other = limits[name], limits[("right" if name[0] == "l" else "left") + name[name.index("_") :]]
        assert own == other
        gait = np.array([read.position(name, k) for k in range(SAMPLES + 1)])
        assert own["lower"] - 1e-12 <= gait.min() <= gait.max() <= own["upper"] + 1e-12
        rate = np.abs(np.diff(gait)).max() * SAMPLES * beat.frequency
        assert 0.98 * rate <= own["velocity"] <= 1.1 * rate + 1e-12
        assert joint.position_lower_limits()[0] == own["lower"]
        assert joint.velocity_upper_limits()[0] == own["velocity"]
        gives = beat.pitch_hinge is not None and name.endswith("wing_pitch")
        assert (own["effort"] == 0) == (name in followers or gives)
    flap = limits["left_flap"]
    assert (flap["lower"], flap["upper"]) == pytest.approx(bounds["flap"], abs=1e-15)
    assert flap["effort"] == pytest.approx(0.5 * np.abs(orbit.dataset["flap_torque"]).max().item(), rel=1e-12)
    if beat.pitch_hinge is not None:
        pitch = limits["left_wing_pitch"]
        assert (pitch["lower"], pitch["upper"]) == (-np.pi, np.pi)
        return
    mean, swing = bounds["pitch_mean"], bounds["pitch_amplitude"][1]
    twists = len(beat.twist_harmonics) > 0
    for name in ("left_wing_pitch", "left_wing_pitch_1", "left_wing_pitch_10"):
        if name not in limits or name in followers or twists:
            continue
        share, beyond = read.share(name, "wing_pitch"), read.share(name, "tip_twist") * beat.twist_mean
        ends = np.array([mean[0] - swing, mean[1] + swing]) * share + beyond
        assert (limits[name]["lower"], limits[name]["upper"]) == pytest.approx(tuple(ends), abs=1e-12)
        peak = 0.5 * np.abs(orbit.dataset["pitch_torque"]).max().item()
        assert limits[name]["effort"] == pytest.approx(peak / share, rel=1e-12)


def test_joints_follow_one_that_the_message_commands(orbit, tmp_path):
    yaml = pytest.importorskip("yaml")
    read = Read(orbit, ".urdf", tmp_path)
    followed = {
        j.get("name"): j.find("mimic").attrib for j in read.top.iter("joint") if j.find("mimic") is not None
    }
    wb.export(orbit, tmp_path / "gait.yaml", samples=SAMPLES)
    message = yaml.safe_load((tmp_path / "gait.yaml").read_text())
    gives = {"left_wing_pitch", "right_wing_pitch"} if orbit.wingbeat.pitch_hinge is not None else set()
    assert set(message["joint_names"]) == read.joints.keys() - followed.keys() - gives
    # Laws that move by themselves: twist is one only where it has waves.
    beat = orbit.wingbeat
    if beat.twist_harmonics:
        assert len(message["joint_names"]) == 2 * 11
    else:
        laws = 2 - bool(gives) + bool(beat.span_retraction) + bool(beat.fold_amplitude) + bool(beat.sweep_amplitude)
        assert len(message["joint_names"]) == 2 * laws
    for k, point in enumerate(message["points"]):
        commanded = dict(zip(message["joint_names"], point["positions"], strict=True))
        for name in read.joints:
            if name in followed:
                line = {key: value for key, value in followed[name].items() if key != "joint"}
                ratio, offset = float(line["multiplier"]), float(line["offset"])
                commanded[name] = ratio * commanded[followed[name]["joint"]] + offset
            if name in gives:
                continue
            assert commanded[name] == pytest.approx(read.position(name, k), abs=1e-12)


def test_the_message_is_one_that_ros_takes(orbit, tmp_path):
    """Its fields are those of trajectory_msgs; its rules are those of joint_trajectory_controller."""
    yaml = pytest.importorskip("yaml")
    wb.export(orbit, tmp_path / "gait.yaml", samples=SAMPLES)
    message = yaml.safe_load((tmp_path / "gait.yaml").read_text())
    assert message.keys() == {"header", "joint_names", "points"}
    assert message["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}
    assert len(message["points"]) == SAMPLES + 1
    times, series = [], {"positions": [], "velocities": [], "accelerations": []}
    for point in message["points"]:
        assert point.keys() == {*series, "effort", "time_from_start"}
        assert point["effort"] == []
        for name, values in series.items():
            assert {type(value) for value in point[name]} == {float}
            assert len(point[name]) == len(message["joint_names"])
            values.append(point[name])
        time = point["time_from_start"]
        assert time.keys() == {"sec", "nanosec"}
        assert {type(value) for value in time.values()} == {int}
        assert 0 <= time["nanosec"] < 10**9
        times.append(time["sec"] + 1e-9 * time["nanosec"])
    period = 1 / orbit.wingbeat.frequency
    assert (np.diff(times) > 0).all()
    np.testing.assert_allclose(times, np.linspace(0, period, SAMPLES + 1), rtol=0, atol=0.6e-9)
    position, rate, acceleration = (np.array(values)[:-1] for values in series.values())
    peak = np.abs(rate).max()
    np.testing.assert_allclose(derivative(position, period), rate, rtol=0, atol=1e-9 * peak)
    np.testing.assert_allclose(
        derivative(rate, period), acceleration, rtol=0, atol=1e-9 * np.abs(acceleration).max()
    )


def test_a_number_without_a_point_is_a_text_to_yaml(tmp_path):
    """Python writes 1e-05, which PyYAML, and so ROS, reads as a text: the message writes 1.0e-05."""
    yaml = pytest.importorskip("yaml")
    from wingbeat.exports.robot import _list

    values = np.array([1e-05, -3e22, 1.5e-7, 0.1, -0.0, 5e-324])
    assert repr(1e-05) == "1e-05"
    assert yaml.safe_load("[1e-05]") == ["1e-05"]
    assert yaml.safe_load(_list(values)) == values.tolist()


def test_a_wing_lighter_than_what_stands_for_nothing_is_refused(rigid_orbit, tmp_path, monkeypatch):
    monkeypatch.setattr("wingbeat.exports.robot.NOTHING", 1e-10)
    with pytest.raises(wb.InvalidInputError, match=r"wing\.mass = .*: has an inertia of .* would add"):
        wb.export(rigid_orbit, tmp_path / "robot.sdf")
    assert not list(tmp_path.iterdir())


def test_a_hand_that_folds_on_a_wing_that_sweeps_is_refused(bat_orbit, tmp_path, monkeypatch):
    swept = dataclasses.replace(bat_orbit.wingbeat, sweep_mean=0.05)
    monkeypatch.setattr(wb.Orbit, "wingbeat", swept)
    for suffix in ("urdf", "sdf", "yaml"):
        with pytest.raises(wb.InvalidInputError, match=r"fold_amplitude = .*: on a wing that sweeps .* \.csv"):
            wb.export(bat_orbit.orbit, tmp_path / f"robot.{suffix}")
    assert not list(tmp_path.iterdir())


def test_a_tail_is_drawn_with_the_body(animal_orbit, tmp_path):
    """A link of its own without mass would weigh 1 kg to PyBullet."""
    read = Read(animal_orbit, ".urdf", tmp_path)
    tail = animal_orbit.problem.vehicle.tail
    (box,) = [shape for shape in read.top.findall("link[@name='body']/visual") if shape.find(".//box") is not None]
    place = [float(value) for value in box.find("origin").get("xyz").split()]
    assert place == [-tail.arm, 0.0, tail.height]
    assert all(link.find("inertial") is not None for link in read.top.iter("link"))


@pytest.mark.parametrize("suffix", [".urdf", ".sdf"])
def test_any_name_makes_a_file(rigid_orbit, suffix, tmp_path):
    problem = rigid_orbit.problem
    species = dataclasses.replace(problem.species, name='my -- "best" <robot> & Vögel 2')
    named = dataclasses.replace(problem, species=species)
    read = Read(wb.Orbit.of_record(rigid_orbit.record(), named, starts=2), suffix, tmp_path)
    model = read.top if suffix == ".urdf" else read.top.find("model")
    assert model.get("name") == "my_best_robot_Vögel_2"


def test_only_sdf_gives_drake_actuators(bat_orbit, tmp_path):
    """To Drake, effort makes an actuator in SDF; in URDF it would take a transmission."""
    found = {suffix: Read(bat_orbit.orbit, suffix, tmp_path).plant for suffix in (".urdf", ".sdf")}
    assert found[".urdf"].num_actuators() == 0
    actuators = [found[".sdf"].get_joint_actuator(i) for i in found[".sdf"].GetJointActuatorIndices()]
    own = [f"{side}_{name}" for side in SIDES for name in ("flap", "fold", "wing_pitch_10")]
    assert sorted(actuator.name() for actuator in actuators) == sorted(own)


def test_a_hinge_that_gives_way_is_a_spring_where_a_format_has_springs(passive_orbit, tmp_path):
    """Drake makes a spring of SDF's numbers, and no actuator of effort 0; URDF has a damper, and says the rest."""
    hinge, read = passive_orbit.wingbeat.pitch_hinge, Read(passive_orbit, ".sdf", tmp_path)
    (dynamics,) = {tuple((one.tag, float(one.text)) for one in node) for node in read.top.iter("dynamics")}
    wanted = {"damping": 0.0083, "spring_reference": hinge.rest_angle, "spring_stiffness": 0.7}
    assert dict(dynamics) == pytest.approx(wanted, rel=1e-15)
    assert read.plant.num_actuators() == 2
    count = read.plant.num_force_elements()
    elements = [read.plant.get_force_element(ForceElementIndex(i)) for i in range(count)]
    springs = [one for one in elements if isinstance(one, RevoluteSpring)]
    assert sorted(one.joint().name() for one in springs) == ["left_wing_pitch", "right_wing_pitch"]
    assert {(one.default_stiffness(), one.default_nominal_angle()) for one in springs} == {(0.7, hinge.rest_angle)}

    urdf = Read(passive_orbit, ".urdf", tmp_path)
    dampers = [float(node.get("damping")) for node in urdf.top.iter("dynamics")]
    assert dampers == [0.0083, 0.0083]
    assert urdf.joints["left_wing_pitch"].default_damping() == 0.0083
    assert (
        "URDF has no springs: each wing_pitch needs one with 0.7 N m/rad" in (tmp_path / "robot.urdf").read_text()
    )
