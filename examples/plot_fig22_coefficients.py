"""
Fig. 22: K2 against the change of each coefficient
==================================================

The paper changes one coefficient at a time and finds K2 most sensitive to the cubic roll damping K_ppp; half of it
makes its CB 0.60 model unstable.

**Not so here.** With coefficients estimated from the hull, K_ppp is small beside the linear damping K_p, and K2
hardly feels it; nothing within +-100 % makes the ship unstable. The linear damping matters most, then the terms
through which sway and yaw damp roll, K_pvv and K_prr. Where K_prr has been turned round (right, an invented value) it decides:
20 % less of it, or 30 % more K_p, restores stability. Whether the paper's K_ppp was larger than
ours cannot be known: it is not printed.
"""

# %%
# Slopes at the ship as estimated: change of the growth rate per 10 % of each coefficient.
import quartering as qt
from quartering.study.paper.conditions import speed_of, wave_of
from quartering.study.paper.curves import coefficient_curves
from quartering.study.paper.sets import COEFFICIENTS
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

ship = qt.ship("series60-cb60").with_(velocities="absolute", drag="cubic", ends="strips", righting="polynomial")
curves = coefficient_curves(ship, COEFFICIENTS, [0.0, 10.0], wave_of(ship, 1.5, 1 / 20), speed_of(ship), heading=30.0)
for name in COEFFICIENTS:
    rate, exponent = (curves[kind].sel(coefficient=name).diff("change").item() for kind in ("index", "exponent"))
    print(f"{name:6s} K2/(2 n2) {-rate:+.5f}, Floquet {exponent:+.5f} 1/s per 10 %")

shown(draw_figure(22))
