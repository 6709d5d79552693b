"""
Figs. 12, 13: the unstable motion
=================================

The paper's central case: a model with modified coefficients (Table I) whose motion at a heading of 15 deg is
unstable, by the variational equations (Fig. 12) and by the full equations started with 5 deg of roll (Fig. 13).

The numbers of Table I cannot be used as they are: no unit, inertia or linear coefficient is printed with them. Its
*ratios* can be put on the coefficients estimated for our hull. **With them the motion at 15 deg stays stable.** The
reason is in the size of the yaw term I3 = 0.1 K_vrr + K_prr: in the paper's own numbers the modification turns it from
-0.575 to +3.92, so that yaw feeds roll. Estimated from cross-flow drag it turns too, from -7.7e9 to +1.0e9 kg m2 s, but
what is left is hundreds of times too small to matter there. Near 65 deg, in very steep waves, the ratios do make roll
unstable: see "What makes coupled roll unstable".

The mechanism itself is real: with K_prr turned round and made large enough (an invented value) roll grows, and the
three ways of judging it agree.
"""

# %%
# How much is needed, the other ratios kept, in waves of 1.5 L of steepness 1/20. Between -28 and -30 times the
# estimated K_prr the verdict flips. At -28 the motion is stable to *small* disturbances, and 5 deg of roll still
# capsizes the ship: linear stability is not safety.
import numpy as np

import quartering as qt
from quartering.study.paper.conditions import speed_of, wave_of
from quartering.study.paper.model import feeding_model, modified_model
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

cases = {"Table I ratios": modified_model()} | {
    f"K_prr x {f}": feeding_model(multiplier=f) for f in (-20, -28, -30, -35)
}
for words, ship in cases.items():
    model = qt.equations(ship, wave_of(ship, 1.5, 1 / 20), speed_of(ship), heading=15.0)
    verdict = qt.stability(model, qt.steady_motion(model, 9, start="rest"))
    end = qt.simulate(model, 600.0, (0.0, np.radians(5.0), 0.0, 0.0)).attrs.get("capsize_time")
    fate = "settles" if end is None else f"capsizes after {end:.0f} s"
    print(
        f"{words:15s} K2/(2 n2) {-verdict.index:+.4f}, largest exponent {verdict.exponents[0].real:+.4f} 1/s;"
        f" from 5 deg of roll it {fate}"
    )

# %%
# The variational equations, with the envelopes that K2 and Floquet's theory predict.
shown(draw_figure(12))

# %%
# The full equations. Beyond 40 deg the fitted righting arm is extrapolated: read the end as "capsizes", not as an
# angle.
shown(draw_figure(13))
