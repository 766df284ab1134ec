"""What a plate in a stream can give: ranges of the constants of a run and of its coefficients."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wingbeat._base import FaultList, plain_unit
from wingbeat.aero.coefficient_model import MAX_DRAG, MAX_LIFT

if TYPE_CHECKING:
    from wingbeat.experiment.record import LoadCellRun
    from wingbeat.experiment.reduction import RunMeans

# Constants beyond these ranges are in another unit. Streams are slower than sound, mercury has 13 500 kg/m3.
_RANGES = {
    "speed": (1e-4, 340.0),
    "density": (0.004, 2e4),
    "chord": (1e-4, 10.0),
    "span": (1e-4, 50.0),
}
# Dynamic viscosities of gases from 100 to 3000 K, and of liquids from liquefied gas to honey [Pa s].
_GAS, _LIQUID = (4e-6, 1e-4), (5e-5, 50.0)
_GAS_DENSITY, _LIQUID_DENSITY = 50.0, 400.0
# Water, fresh or salt: its density [kg/m3], and kinematic viscosities above the largest [m2/s] (0 C: 1.8e-6).
_WATER, _TOO_THICK = (985.0, 1035.0), 4e-4
# Water tunnels end at about 30 m/s.
_FASTEST_LIQUID = 30.0
# Reynolds numbers of wings: below, Stokes flow; above, airliners.
_USUAL_REYNOLDS = 10.0, 1e7
_ASPECT = 0.05, 100.0
# A drag below zero by less than this is an error of the zero, which the standard error does not know.
_ZERO_ERROR = 0.02
# Lift of a thin aerofoil at an angle, 2 pi sin(alpha) (Glauert 1926), plus that of camber.
_CAMBER_LIFT = 0.8
# At angles whose sine is above the first number, a plate has a force coefficient of about 1.6 sin(alpha). A tenth
# of it is less than any wing has that is not near its angle of zero lift.
_INCLINED, _SLIGHT = 0.17, 0.16
# At angles whose sine is above this, the force on a plate is across it rather than along it, but for friction.
_STEEP = 0.3
# Largest distance of the centre of pressure from mid-chord, and moment about mid-chord that camber adds; the second
# pair is for steep angles up to 90 degrees where the centre is behind mid-chord, as no plate's is there.
_ARM, _ARM_BEHIND = (0.35, 0.15), (0.2, 0.1)
# Standard errors that a range is widened by.
_SURE = 4.0
# What makes the coefficients of a plate so many times too large.
_FACTORS = {
    1e-6: "lengths in mm, or a speed in mm/s",
    1e-4: "lengths in cm, or a speed in cm/s",
    1e-3: "forces in kN, or a density in g/m3",
    1e2: "forces in grams or cN",
    1e3: "forces in mN, or a density in g/cm3",
    1e6: "forces in uN",
}


def check_constants(faults: FaultList, run: LoadCellRun) -> None:
    """Note constants of a run, in SI units, that no stream and no plate has, with what they seem to be.

    The viscosity of gases and liquids is judged with the density, because both are known for any fluid.
    """

    def note(name: str, rule: str, fix: str) -> None:
        faults.add(f"{run.name}, {name}", getattr(run, name), rule, fix)

    before = len(faults.faults)
    for name, (least, most) in _RANGES.items():
        value, unit = getattr(run, name), plain_unit(name)
        if not least <= value <= most:
            length = "; is it in mm or cm?" if value > most and unit == "m" else ""
            note(name, f"must lie between {least:g} and {most:g} {unit}", f"give it in {unit}{length}")
    if len(faults.faults) > before:
        return
    density, viscosity = run.density, run.viscosity
    dynamic = density * viscosity
    if density < _GAS_DENSITY and not _GAS[0] <= dynamic <= _GAS[1]:
        if dynamic < _GAS[0] and 0.5 < density < 2 and 2e-7 < viscosity < 2e-6:
            fix = f"is the density in g/cm3? Water has {1e3 * density:.4g} kg/m3"
            note("density", f"is that of a gas, but {viscosity:g} m2/s is the viscosity of a liquid", fix)
            return
        fix = "give the kinematic viscosity in m2/s, 1.5e-5 for air; multiply cSt by 1e-6"
        note("viscosity", f"with a density of {density:g} kg/m3 is not that of a gas", fix)
    elif _WATER[0] < density < _WATER[1] and viscosity > _TOO_THICK:
        if viscosity < 3e-3:
            rule = "seems to be the dynamic viscosity of water in Pa s; the kinematic one is needed, in m2/s"
            note("viscosity", rule, f"divide it by the density: {viscosity / density:.4g}")
        else:
            rule = "is not the kinematic viscosity of water in m2/s, which is about 1e-6"
            note("viscosity", rule, "multiply mm2/s, cSt and mPa s by 1e-6, and cm2/s (stokes) by 1e-4")
    elif density > _LIQUID_DENSITY and not _LIQUID[0] <= dynamic <= _LIQUID[1]:
        fix = "give the kinematic viscosity in m2/s, 1e-6 for water; mm2/s and cSt times 1e-6"
        note("viscosity", f"with a density of {density:g} kg/m3 is not that of a liquid", fix)
    if density > _LIQUID_DENSITY and run.speed > _FASTEST_LIQUID:
        note("speed", f"is faster than any water tunnel, {_FASTEST_LIQUID:g} m/s", "give it in m/s; is it in cm/s?")
    if run.reynolds < 1:
        note("viscosity", f"makes the Reynolds number {run.reynolds:.2g}, but it must be >= 1", "check the units")


def constant_notes(run: LoadCellRun) -> list[str]:
    """Return notes on constants that are possible, but not usual."""
    notes = []
    if not _USUAL_REYNOLDS[0] <= run.reynolds <= _USUAL_REYNOLDS[1]:
        notes.append(
            f"{run.name}: the Reynolds number is {run.reynolds:.3g}; are speed, chord and viscosity in SI units?"
        )
    if not _ASPECT[0] <= run.span / run.chord <= _ASPECT[1]:
        notes.append(f"{run.name}: the span is {run.span / run.chord:.3g} chords; are both in metres?")
    # Sutherland's law at 1 bar, with the temperature from the density of air.
    kelvin = 353.0 / run.density
    of_air = 1.458e-6 * kelvin**1.5 / (kelvin + 110.4)
    is_dynamic = abs(run.viscosity / of_air - 1) < 0.04 and abs(run.viscosity * run.density / of_air - 1) > 0.08
    if 1.1 < run.density < 1.35 and is_dynamic:
        right = of_air / run.density
        notes.append(
            f"{run.name}: the viscosity, {run.viscosity:g}, seems to be the dynamic one of air in Pa s; the "
            f"kinematic one is {right:.3g} m2/s"
        )
    return notes


def check_coefficients(faults: FaultList, run: LoadCellRun, means: RunMeans) -> None:
    """Note mean coefficients that no plate has, with what may have gone wrong."""
    where = f"{run.name}, alpha_deg = {means.alpha_deg:.4g}"
    (lift, drag, moment), (lift_se, drag_se, moment_se) = means.mean[:3].tolist(), means.se[:3].tolist()
    whole, error = math.hypot(lift, drag), math.hypot(lift_se, drag_se)
    sine = abs(math.sin(math.radians(means.alpha_deg)))
    factor = whole / (1.6 * sine + 0.05)
    near = min(_FACTORS, key=lambda power: abs(math.log(max(factor, 1e-300) / power)))
    off = "check the units of force, speed, density, chord and span"
    off = f"the numbers seem to have {_FACTORS[near]}: {off}" if 0.2 < factor / near < 5 else off
    if abs(lift) > MAX_LIFT + _SURE * lift_se:
        faults.add(f"{where}, C_L", lift, f"must lie between {-MAX_LIFT:g} and {MAX_LIFT:g}: no wing has more", off)
    if drag > MAX_DRAG + _SURE * drag_se:
        faults.add(f"{where}, C_D", drag, f"must be at most {MAX_DRAG:g}: no wing has more", off)
    elif drag < -_ZERO_ERROR - _SURE * drag_se:
        fix = "check the signs (tangential_force towards the trailing edge) and the zero readings"
        faults.add(f"{where}, C_D", drag, "must be > 0: the stream drags every plate with it", fix)
    if abs(moment) > MAX_LIFT + _SURE * moment_se:
        fix = "give it about mid-chord, in N m; is it in N mm?"
        faults.add(f"{where}, C_M", moment, f"must lie between {-MAX_LIFT:g} and {MAX_LIFT:g}", fix)
    # Friction on both sides of a smooth plate in laminar flow: Blasius 1908.
    friction = 2.656 / math.sqrt(means.reynolds)
    turn = math.radians(means.alpha_deg)
    tangential = drag * math.cos(turn) - lift * math.sin(turn)
    if sine > _INCLINED and whole + _SURE * error < _SLIGHT * sine:
        rule = (
            f"is the whole force coefficient, less than a tenth of a plate's there, about {10 * _SLIGHT * sine:.2g}"
        )
        faults.add(where, whole, rule, off)
    elif sine > _STEEP and abs(tangential) - friction - _SURE * error > abs(means.normal):
        rule = f"is the tangential force coefficient, more than that of the normal force, {means.normal:.2g}"
        fix = "are the two columns exchanged, or are they lift and drag?"
        faults.add(f"{where}, C_T", tangential, rule, fix)
    elif whole + _SURE * error < 0.5 * friction:
        rule = f"is the whole force coefficient, less than half of the friction on a smooth plate, {friction:.2g}"
        faults.add(where, whole, rule, off)


def coefficient_notes(run: LoadCellRun, means: RunMeans) -> list[str]:
    """Return notes on mean coefficients that are possible, but not for a usual plate or wing."""
    notes, sine = [], abs(math.sin(math.radians(means.alpha_deg)))
    most = min(_CAMBER_LIFT + 2 * math.pi * sine, MAX_DRAG)
    if abs(means.normal) > most + _SURE * means.normal_se:
        angle = "; is the angle in radians?" if abs(means.alpha_deg) <= math.pi else ""
        notes.append(
            f"{run.name}: C_N is {means.normal:.3g} at {means.alpha_deg:.3g} degrees, more than a thin aerofoil "
            f"has (2 pi sin alpha, and {_CAMBER_LIFT:g} for camber); check units, angle and zero{angle}"
        )
    moment = float(means.mean[2])
    behind = moment * means.normal < 0 and abs(means.alpha_deg) <= 90 and sine > _STEEP
    arm, camber = _ARM_BEHIND if behind else _ARM
    if abs(moment) > arm * abs(means.normal) + camber + _SURE * float(means.se[2]):
        notes.append(
            f"{run.name}: the moment, C_M {moment:.3g}, is too large for a normal force of C_N "
            f"{means.normal:.3g} on the plate: is it about mid-chord, and in N m?"
        )
    return notes
