"""The words and tables of the page on the second opinion; every number in a table comes from a record."""

from __future__ import annotations

from typing import Any

HEAD = """# A second opinion on the air loads

`python validation/second_opinion.py` writes this page. It replays orbits in the unsteady ring vortex lattice of
[PteraSoftware](https://github.com/camUrban/PteraSoftware) (here {code}) and compares its loads with ours **on the
same motion**: the wings' corners at every step are points of the wing that our strips make up, and the body heaves,
pitches and advances as in the orbit. The body does not answer the lattice's loads. To do the same with an orbit of
your own:

```sh
uv run wingbeat orbit pigeon --speed 12 -o pigeon.nc
uv run --extra uvlm wingbeat compare pigeon.nc --with uvlm --plot lift.png
```

Both codes give the force on the wings alone, in the world (thrust forward, lift up), and the power that the wings
give to still air: minus the force times the velocity of the wing. Our loads are evaluated four times on the motion
of the orbit: with the measured coefficients alone, with each term of `--unsteady` and `--inflow`, and with both.
The orbits are those of least frequency, solved with the coefficients of Su and Fan alone.

## The result

{table}

- *lift later*: by which share of a beat the lattice's lift comes later than ours; negative is earlier.
- *rms*: root mean square of the difference of the two lifts over the beat, over the weight; *of theirs*: the same
  difference over the root mean square of the lattice's lift.
- *beyond 15 deg*: share of beat and strips whose angle of attack in our model is larger. A vortex lattice has
  attached flow at any angle; there it must be wrong. The lattice is a check of our loads only where this is small.

![lift and thrust by both codes](second_opinion.png)

Pigeon at 12 m/s. a: lift, b: thrust. Below: the share of strips beyond 15 degrees.

{reading}

## What each code leaves out

| left out | our coefficients alone | with both terms | vortex lattice |
|---|---|---|---|
| profile drag, viscosity | in the coefficients | in the coefficients | **left out** |
| stall, separation | in the coefficients, as in steady flow | as in steady flow | **left out** |
| leading-edge vortices that form and detach | **left out** | **left out** | **left out** |
| suction at the leading edge | in the coefficients (a blunt plate: little) | the same | whole |
| rotation and added mass | **left out** | thin aerofoil | in |
| induced flow | that of the wing whose coefficients were measured | an even stream by momentum | by the wake |
| lag by the wake of earlier parts of the beat | **left out** | **left out** | in |
| roll-up of the wake | **left out** | **left out** | **left out**: it stays where it was shed |
| loads of one strip on its neighbours | **left out** | **left out** | in |
| body and tail | **left out** here | **left out** here | **left out**; panels across the body join the wings |

## How well the lattice is converged

It takes velocities from the step before, so its loads come late by up to a step, and its panels err in proportion
to their size. `wingbeat compare` therefore flies two lattices, one with half the panels and steps of the other each
way, and extrapolates to panels and steps of no size. Pigeon at 12 m/s:

{convergence}

The default, {default}, differs from the finest by {errors}. A third beat
changes 0.1 %, because in forward flight the wake is soon left behind; for the bat at 5 m/s it changed 0.4 %. We
measured convergence for the pigeon alone.

Two known cases are in the tests. A steady plate of aspect ratio 6 at 3 degrees has the lift of a lifting line
within 3 %. A slender plate that heaves at a reduced frequency of 0.31 has 1.07 of Theodorsen's lift, at his phase
within 1 degree; the excess stays when panels and steps are refined further, so it belongs to this lattice.

## The version

PteraSoftware is pinned to 5.0.0. It has no movement in which a wing flaps, pitches, twists, sweeps, folds and
shortens while the body heaves and pitches. We therefore give it the panels of every step. That takes its private
class of panels and constructors of our own for its wing and movement, which another version may change. Version
5.1.0 wants an older MuJoCo than the tests of this project.
"""


READING = """

**In none of these flights is the lattice a check of the whole beat**: {0:.0%} to {1:.0%} of beat and strips are
beyond 15 degrees. The codes differ most in thrust and power. The lattice has all suction at the leading edge and no
profile drag. It asks {2:.0%} to {3:.0%} of our power for a motion that has no mean thrust in our model and a large
one in the lattice.

**Rotation and added mass** bring our lift clearly nearer to the lattice's where the least is stalled: pigeon at
16 m/s, and with 45 degrees of flap amplitude. They change the difference by a few percent for pigeon at 12 m/s and
the bat, and raise it for pigeon at 8 m/s. They mend neither thrust nor power. An earlier trial of these terms had
reported a fall of the difference from 0.37 to 0.14 for a pigeon with 45 degrees of amplitude. Here its direction
reproduces and its size does not.

**Inflow** alone takes lift away on the same motion, and that leads away from the lattice or changes nothing. The
coefficients are those of a finite plate and already hold most of its induced flow.
"""


def page(records: dict[tuple[str, float, float | None], dict[str, Any]], convergence: list[dict[str, Any]]) -> str:
    """Return the page.

    Parameters
    ----------
    records : of the comparisons, by animal, speed and largest flap amplitude.
    convergence : what several lattices make of one motion.
    """
    default = next(iter(records.values()))["lattice"]
    words = f"{default['chordwise']} x {default['spanwise']} panels a wing, {default['steps']} steps a beat"
    return HEAD.format(
        code=next(iter(records.values()))["code"],
        table=_table(records),
        reading=_reading(records),
        convergence=_convergence(convergence),
        default=words,
        errors=_errors(convergence),
    )


_TERMS = {
    ("none", "none"): "coefficients alone",
    ("thin-aerofoil", "none"): "rotation, added mass",
    ("none", "momentum"): "inflow",
    ("thin-aerofoil", "momentum"): "both",
}


def _name(case: tuple[str, float, float | None]) -> str:
    animal, speed, amplitude = case
    return f"{animal} {speed} m/s" + ("" if amplitude is None else f", flap at most {amplitude} deg")


def _table(records: dict[tuple[str, float, float | None], dict[str, Any]]) -> str:
    lines = [
        "| flight | beyond 15 deg | loads | lift [N] | thrust [N] | power [W] | lift later [beat] | rms / weight "
        "| rms of theirs |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for case, record in records.items():
        theirs = [record[name]["theirs"] for name in ("mean_lift", "mean_thrust", "aerodynamic_power")]
        numbers = " | ".join(f"{value:.3g}" for value in theirs)
        lines.append(f"| {_name(case)} | {record['beyond_15_deg']:.0%} | vortex lattice | {numbers} | | | |")
        for row in record["terms"]:
            name = f"ours: {_TERMS[row['unsteady'], row['inflow']]}"
            if "refused" in row:
                lines.append(f"| | | {name} | refused | | | | | |")
                continue
            ours = [row[key]["ours"] for key in ("mean_lift", "mean_thrust", "aerodynamic_power")]
            means = " | ".join(f"{value:.3g}" if abs(value) > 5e-4 else "0" for value in ours)
            share = row["lift_rms_difference"] / row["lift_rms_of_theirs"]
            last = f"{row['lift_lag']:+.3f} | {row['lift_rms_difference']:.2f} | {share:.2f}"
            lines.append(f"| | | {name} | {means} | {last} |")
    return "\n".join(lines)


def _convergence(rows: list[dict[str, Any]]) -> str:
    lines = [
        "| panels along chord x span, steps, beats | lift [N] | thrust [N] | power [W] "
        "| first harmonic of lift [N] | its phase [beat] |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        lattice = row["lattice"]
        name = f"{lattice['chordwise']} x {lattice['spanwise']}, {lattice['steps']}, {lattice['beats']}"
        values = f"{row['mean_lift']:.3f} | {row['mean_thrust']:.3f} | {row['aerodynamic_power']:.2f}"
        lines.append(f"| {name} | {values} | {row['first_harmonic']:.3f} | {row['phase_of_first']:.3f} |")
    return "\n".join(lines)


def _errors(rows: list[dict[str, Any]]) -> str:
    """Return by how much the default, the second row, differs from the finest lattice, the last."""
    names = {"mean_lift": "lift", "mean_thrust": "thrust", "aerodynamic_power": "power"}
    return ", ".join(f"{abs(rows[1][key] / rows[-1][key] - 1):.1%} in {name}" for key, name in names.items())


def _reading(records: dict[tuple[str, float, float | None], dict[str, Any]]) -> str:
    """Return what the numbers say of rotation and added mass, case by case."""
    lines = []
    for case, record in records.items():
        rows = {(row["unsteady"], row["inflow"]): row for row in record["terms"]}
        bare, turned = rows["none", "none"], rows["thin-aerofoil", "none"]
        shares = [row["lift_rms_difference"] / row["lift_rms_of_theirs"] for row in (bare, turned)]
        verb = "falls" if shares[1] < shares[0] else "rises"
        lines.append(
            f"- {_name(case)}: with rotation and added mass the difference of lift {verb} from {shares[0]:.2f} to "
            f"{shares[1]:.2f} of the lattice's lift, and the lattice's lift comes "
            f"{turned['lift_lag']:+.3f} in place of {bare['lift_lag']:+.3f} beats later than ours."
        )
    power = [record["aerodynamic_power"]["ratio"] for record in records.values()]
    share = [record["beyond_15_deg"] for record in records.values()]
    return "\n".join(lines) + READING.format(*(bound(of) for of in (share, power) for bound in (min, max)))
