"""
Is my bat's film trimmed?
=========================

You filmed a bat in level flight and digitised its wings. If the model moves wings and body as in the film, do the
air loads carry the weight and overcome the drag? If they do not, the film, the model, or the animal's numbers are
wrong, and any force computed from the film is wrong as well.
"""

# %%
# No film of an animal comes with wingbeat, so we film a wingbeat that we know: an orbit of the bat at 6 m/s, in
# 80 frames with noise of one degree. With a film of your own, write ``film = read_film("film.csv")``.
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import wingbeat as wb
from wingbeat._base.style import BLUE, VERMILION
from wingbeat.experiment import fit_body_path, fit_film, synthetic_film
from wingbeat.results.flight import carry

bat = wb.load_species("bat")
known = wb.solve_orbit(wb.OrbitProblem(bat, speed=6.0), starts=2)
assert known.status is wb.Status.CONVERGED
film = synthetic_film(known.wingbeat, frames=80, noise_deg=1.0, seed=1, columns=("flap_deg", "pitch_deg"))
seen = known.dataset.interp(phase=film.phase)
body = {
    "body_x_m": seen["x"].values,
    "body_z_m": seen["z"].values,
    "body_pitch_deg": np.degrees(seen["body_pitch"]),
}
film = replace(film, columns={**film.columns, **{name: np.array(values) for name, values in body.items()}})

# %%
# Move wings and body as filmed. The missing force is the force that the motion needs in addition to air loads and
# weight. The second film is the first with all pitch angles five degrees too high, as after an error of
# calibration.
pitched = replace(film, columns={**film.columns, "pitch_deg": film.columns["pitch_deg"] + 5.0})
model = wb.FlightModel(bat.vehicle, "su-fan", bat.air)


def missing(film):
    """Return the missing force upward and forward through a beat, as shares of the weight, and their means."""
    beat = fit_film(film)
    species = wb.filmed_species(beat, bat)
    flight = carry(model, species.wingbeat, fit_body_path(beat))
    weight = flight.summary["weight"]
    series = [flight.dataset[name] / weight for name in ("missing_force_z", "missing_force_x")]
    return flight.phase, series, [flight.summary[f"missing_force_{axis}_mean"] for axis in "zx"]


found = {"as filmed": missing(film), "pitch 5 deg too high": missing(pitched)}

# %%
# Dashed lines are means over the beat. A trimmed film has means near zero.
figure, panels = plt.subplots(1, 2, figsize=(7.2, 3.2), sharex=True, layout="constrained")
for (name, (phase, series, means)), color in zip(found.items(), (BLUE, VERMILION), strict=True):
    for axes, values, mean in zip(panels, series, means, strict=True):
        axes.plot(phase, values, color=color, label=name)
        axes.axhline(mean, color=color, linestyle="--", linewidth=1)
for axes, direction in zip(panels, ("upward", "forward"), strict=True):
    axes.set(xlabel="phase [beats]", ylabel=f"missing force {direction} / weight [-]")
    axes.spines[["top", "right"]].set_visible(False)
handles, labels = panels[0].get_legend_handles_labels()
figure.legend(handles, labels, loc="outside upper center", ncols=2, frameon=False)

# %%
# The answer:
for name, (_, _, (up, forward)) in found.items():
    print(f"{name}: {up:+.0%} of the weight is missing upward and {forward:+.0%} forward")
assert np.hypot(*found["as filmed"][2]) < np.hypot(*found["pitch 5 deg too high"][2])
