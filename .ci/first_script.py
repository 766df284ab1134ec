"""What a new user's first script does. `.ci/try_release` runs it where only the built package is installed."""

from pathlib import Path

import wingbeat as wb
import wingbeat_evidence as evidence
import wingbeat_explorer

assert "site-packages" in wb.__file__, f"not the installed package: {wb.__file__}"
assert wb.__version__
assert "site-packages" in wingbeat_explorer.__file__

pigeon = wb.load_species("pigeon")
orbit = wb.solve_orbit(wb.OrbitProblem(pigeon, speed=12.0), starts=1, seed=0)
assert orbit.status.value == "converged", orbit.message
orbit.save("first.nc")
again = wb.load_orbit("first.nc")
assert again.wingbeat.frequency == orbit.wingbeat.frequency
assert Path("first.nc").stat().st_size > 0

assert wb.linearise(orbit).A.shape == (4, 4)
assert len(evidence.shipped_cases()) > 1
