"""From load-cell records to a coefficient model, and from a film to a wingbeat, with their uncertainty.

`__init__.pyi` says where every name lives. A name is loaded when it is first used: `wingbeat orbit`, which may need
a film, then starts 0.15 s sooner.

>>> import wingbeat as wb
>>> film = wb.experiment.synthetic_film(wb.load_species("pigeon").wingbeat, frames=60, noise_deg=0.0)
>>> round(wb.experiment.fit_film(film).numbers["flap_amplitude"], 3)
0.785
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
