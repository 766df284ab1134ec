"""The words and tables of the page on the second opinion; every number in a table comes from a record."""

from __future__ import annotations

from typing import Any

HEAD = """# A second opinion on the air loads

`python validation/second_opinion.py` writes this page. It replays orbits in the unsteady ring vortex lattice of
[PteraSoftware](https://github.com/camUrban/PteraSoftware) (here {code}) and compares the lattice's loads with
ours **on the same motion**. At every step the corners of the lattice's panels lie on the wing that our strips
form, and the body heaves, pitches and advances as in the orbit. The lattice's loads do not change this
motion. To compare an orbit of your own:

```sh
uv run wingbeat orbit pigeon --speed 12 -o pigeon.nc
uv run --extra uvlm wingbeat compare pigeon.nc --with uvlm --plot lift.png
```

Both codes give the force on the wings alone, in world axes: thrust is forward, lift is up. Both also give the power
that the wings give to still air. This power is minus the force times the velocity of the wing. We evaluate our
loads four times on the motion of the orbit:

- with the measured coefficients alone;
- with `--unsteady thin-aerofoil`, which adds rotation and added mass;
- with `--inflow momentum`, which adds induced flow;
- with both options.

Each orbit is the orbit of lowest frequency. It was solved with the Su-Fan coefficients alone.

## The result

{table}

- *lift delay*: the delay of the lattice's lift behind ours, as a fraction of the beat; a negative number means that
  the lattice's lift is earlier.
- *rms / weight*: root mean square over the beat of the difference between the two lifts, divided by the weight.
- *rms / lattice*: the same root mean square, divided by the root mean square of the lattice's lift.
- *beyond 15 deg*: the share of strips whose angle of attack in our model exceeds 15 degrees, averaged over the
  beat. In a vortex lattice the flow is attached at any angle, so beyond 15 degrees the lattice must be wrong. The
  lattice therefore checks our loads only if this share is small.

![lift and thrust by both codes](second_opinion.png)

Pigeon at 12 m/s. a: lift, b: thrust. The lower panels show the share of strips beyond 15 degrees.

{reading}

## What each code leaves out

| effect | our loads, coefficients alone | our loads, both options | vortex lattice |
|---|---|---|---|
| profile drag, viscosity | in the coefficients | in the coefficients | **left out** |
| stall, separation | only as in steady flow | only as in steady flow | **left out** |
| leading-edge vortices that form and detach | **left out** | **left out** | **left out** |
| suction at the leading edge | in the coefficients: little (blunt plate) | the same | included in full |
| rotation and added mass | **left out** | from thin-aerofoil theory | included |
| induced flow | that of the measured plate | a uniform stream from momentum theory | from the wake |
| delay of the loads due to the wake shed earlier | **left out** | **left out** | included |
| roll-up of the wake | **left out** | **left out** | **left out**: the wake stays where it was shed |
| effect of one strip's loads on its neighbours | **left out** | **left out** | included |
| body and tail | **left out** here | **left out** here | **left out**; panels across the body join the wings |

## How well the lattice is converged

The lattice uses velocities from the previous step, so its loads are late by up to a step. Its discretisation error
is proportional to the size of the panels. `wingbeat compare` therefore computes two lattices: the coarser one has
half as many panels in each direction and half as many steps as the finer one. From the results of both, it
extrapolates to panels and steps of zero size. The next table gives extrapolated results for the pigeon at 12 m/s.
Each row names the finer of its two lattices:

{convergence}

The default is {default}. Its results differ from those of the finest lattice by
{errors}. A third beat changes the results by only 0.1 %, because in forward
flight the wings soon leave the wake behind. For the bat at 5 m/s it changes them by 0.4 %. We measured the
convergence with panels and steps for the pigeon only.

The tests contain two cases with known results. For a steady plate of aspect ratio 6 at 3 degrees, the lattice's
lift agrees with lifting-line theory within 3 %. For a plate of large aspect ratio that heaves at a reduced
frequency of 0.31, the lattice's lift is 1.07 times Theodorsen's lift, and the phases of the two lifts agree within
1 degree. The excess of lift remains when panels and steps are refined further, so it is a property of this
lattice.

## The version

wingbeat requires exactly PteraSoftware 5.0.0. PteraSoftware has no movement in which a wing flaps, pitches,
twists, sweeps, folds and shortens while the body heaves and pitches. We therefore supply the panels of every step.
For this we use PteraSoftware's private class of panels, and derive our own classes from its classes of a wing and
of a movement. Another version of PteraSoftware may change these three classes. Version 5.1.0 requires an older
MuJoCo than our tests do.
"""


READING = """

**The lattice does not check the whole beat in any of these flights**: averaged over the beat, {0:.0%} to {1:.0%} of
the strips are beyond 15 degrees. The codes differ most in thrust and power. The lattice has full suction at the
leading edge and no profile drag. For the same motion the lattice's power is {2:.0%} to {3:.0%} of our power
with the coefficients alone. The lattice's mean thrust is large, while ours is about zero.

**Rotation and added mass** bring our lift clearly closer to the lattice's in the flights with the smallest share
beyond 15 degrees: the pigeon at 16 m/s, and the pigeon whose flap amplitude is at most 45 degrees. For the bat,
and for the pigeon at 12 m/s without this limit of the amplitude, the terms change the difference of the lifts by a
few percent. For the pigeon at 8 m/s, the terms increase the difference. They improve neither thrust nor power. In
an earlier trial of these terms, the difference fell from 0.37 to 0.14 for a pigeon with 45 degrees of amplitude.
Here the difference falls as well, but by less.

**Inflow** alone reduces our lift on the same motion. *rms / lattice* then increases or stays the same. The
coefficients were measured on a finite plate and already include most of the plate's induced flow.
"""


def page(records: dict[tuple[str, float, float | None], dict[str, Any]], convergence: list[dict[str, Any]]) -> str:
    """Return the page.

    Parameters
    ----------
    records : of the comparisons, by animal, speed and largest flap amplitude.
    convergence : what several lattices make of one motion.
    """
    default = next(iter(records.values()))["lattice"]
    words = f"{default['chordwise']} x {default['spanwise']} panels per wing, {default['steps']} steps per beat"
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
        "| flight | beyond 15 deg | loads | lift [N] | thrust [N] | power [W] | lift delay [beat] | rms / weight "
        "| rms / lattice |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for case, record in records.items():
        theirs = [record[name]["theirs"] for name in ("mean_lift", "mean_thrust", "aerodynamic_power")]
        numbers = " | ".join(f"{value:.3g}" for value in theirs)
        flight = f"| {_name(case)} | {record['beyond_15_deg']:.0%} |"
        lines.append(f"{flight} vortex lattice | {numbers} | | | |")
        for row in record["terms"]:
            name = f"ours: {_TERMS[row['unsteady'], row['inflow']]}"
            if "refused" in row:
                lines.append(f"{flight} {name} | refused | | | | | |")
                continue
            ours = [row[key]["ours"] for key in ("mean_lift", "mean_thrust", "aerodynamic_power")]
            means = " | ".join(f"{value:.3g}" if abs(value) > 5e-4 else "0" for value in ours)
            share = row["lift_rms_difference"] / row["lift_rms_of_theirs"]
            last = f"{row['lift_lag']:+.3f} | {row['lift_rms_difference']:.2f} | {share:.2f}"
            lines.append(f"{flight} {name} | {means} | {last} |")
    return "\n".join(lines)


def _convergence(rows: list[dict[str, Any]]) -> str:
    lines = [
        "| panels (chord x span), steps per beat, beats | lift [N] | thrust [N] | power [W] "
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


def _lag(beats: float) -> str:
    """Return in words by which fraction of a beat the lattice's lift is later."""
    return f"{abs(beats):.3f} beat {'earlier' if beats < 0 else 'later'}"


def _reading(records: dict[tuple[str, float, float | None], dict[str, Any]]) -> str:
    """Return what the numbers say of rotation and added mass, case by case."""
    lines = []
    for case, record in records.items():
        rows = {(row["unsteady"], row["inflow"]): row for row in record["terms"]}
        bare, turned = rows["none", "none"], rows["thin-aerofoil", "none"]
        shares = [row["lift_rms_difference"] / row["lift_rms_of_theirs"] for row in (bare, turned)]
        verb = "falls" if shares[1] < shares[0] else "rises"
        lags = [_lag(row["lift_lag"]) for row in (bare, turned)]
        lines.append(
            f"- {_name(case)}: with rotation and added mass, *rms / lattice* {verb} from {shares[0]:.2f} to "
            f"{shares[1]:.2f}. The lattice's lift is {lags[1]} than ours; "
            f"without these terms it is {lags[0]}."
        )
    power = [record["aerodynamic_power"]["ratio"] for record in records.values()]
    share = [record["beyond_15_deg"] for record in records.values()]
    return "\n".join(lines) + READING.format(*(bound(of) for of in (share, power) for bound in (min, max)))
