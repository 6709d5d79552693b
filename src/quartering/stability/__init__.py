"""Is that motion stable: first-order indices, Floquet multipliers, verdict.

The room shares its name with its main act: ``quartering.stability(model, motion)`` gives the `Verdict`, so the module itself
can be called.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from quartering.motion.equations.model import Model
    from quartering.motion.steady.motion import Motion
    from quartering.stability.verdict import Verdict


class _Room(ModuleType):
    def __call__(self, model: Model, motion: Motion) -> Verdict:
        from quartering.stability.verdict import stability

        return stability(model, motion)


sys.modules[__name__].__class__ = _Room
