"""What wingbeat is held against: Su et al. 2023, measured motions of wings, measured flights, a vortex lattice.

>>> import wingbeat_evidence as evidence
>>> evidence.shipped_cases()[0].parent.name
'dragonfly-azuma1988-1'
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
