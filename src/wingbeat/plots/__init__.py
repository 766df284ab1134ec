"""Figures: of wingbeats, flights, stability, gusts, curves, fits, measured motions and second opinions; saving.

>>> import wingbeat as wb
>>> pigeon = wb.load_species("pigeon")
>>> model = wb.FlightModel(pigeon.vehicle, "su-fan")
>>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=1)
>>> figure = wb.plots.wingbeat_page(flight.dataset)  # wb.plots.save_figure writes it to a file
>>> len(figure.axes) > 0
True
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
