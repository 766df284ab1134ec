"""What the actuators of an orbit spend, recomputed from its dataset."""

import numpy as np
import pytest

import wingbeat as wb


def spends_what_it_says(orbit):
    """Hold each part of the power account against loads and speeds of the dataset; return the means."""
    data, model = orbit.dataset, orbit.problem.model
    means = {name: part["mean"] for name, part in wb.power_account(data)["spent"].items()}
    assert sum(means.values()) == pytest.approx(orbit.record()["mean_actuator_power"], rel=1e-9)
    assert abs(means["inertial"]) < 1e-3 * means["profile"]
    drag = 2.0 * (data["drag"] * data["strip_speed"]).sum("station")
    np.testing.assert_allclose(data["profile_power"], drag, rtol=0, atol=1e-10 * float(drag.max()))
    speed = np.hypot(data["u"], data["w"])
    parasite = 0.5 * model.air.density * model.vehicle.body.drag_area * speed**3
    np.testing.assert_allclose(data["parasite_power"], parasite, rtol=1e-12, atol=0)
    forward, up = model.induced_flow or (0.0, 0.0)
    wings = 2.0 * data["strip_force"].sum("station")
    induced = -(forward * wings.sel(axis="x") + up * wings.sel(axis="z"))
    np.testing.assert_allclose(data["induced_power"], induced, rtol=0, atol=1e-10)
    assert (means["unsteady"] != 0.0) == (orbit.problem.aero.unsteady != "none")
    return means
