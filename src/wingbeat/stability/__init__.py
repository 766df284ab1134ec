"""Stability of orbits: linear maps from beat to beat, their modes, feedback that holds them, gusts and manoeuvres.

`__init__.pyi` says where each name lives; a name is loaded when it is first used.

>>> import wingbeat as wb
>>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
>>> round(wb.stability.linearise(orbit).spectral_radius, 2)
1.35
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
