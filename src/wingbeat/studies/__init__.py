"""Studies: many orbit problems planned, solved in pieces that survive, and kept in one file.

`__init__.pyi` says where each name lives; a name is loaded when it is first used.

>>> import wingbeat as wb
>>> speeds = {"speed": {"grid": [8.0, 9.0, 10.0]}}
>>> len(wb.studies.plan_study(species="bat", vary=speeds, store="bat.study.sqlite"))
3
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
