"""
Figs. 14-19: radii of gyration
==============================

What the distribution of weight does: roll, stability and yaw over heading for several radii of gyration, Series 60 CB
0.60 (14-16) and the Mariner (17-19). For the Mariner the sway-yaw coefficients are measured but the lines are a
stand-in: stretched Series 60.

What holds for both ships: a larger radius in roll lowers the roll frequency, so resonance moves to headings nearer to
following seas. The stability index falls, because the same damping works on more inertia. A larger radius in yaw
lowers yaw, by 8 % for 12 % more radius, and hardly changes the index.

What the index does not see: the largest Floquet exponent is not that of roll at headings below 45 deg, where the slow
sway-yaw modes decide, nor next to resonance, where it rises steeply towards a fold while K2 even falls.
"""

# %%
# Series 60, CB 0.60: roll.
from quartering.conventions import written
from quartering.study.paper.conditions import FROUDE
from quartering.study.paper.sets import gyradii_of
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

for quantity, ds in gyradii_of("series60-cb60", FROUDE).items():
    for i in range(ds.sizes["loading"]):
        one = ds.isel(loading=i)
        largest, index = float(one["exponent"].max()), float(one["index"].min())
        size = f"{written(quantity)} {float(one[quantity]):5.2f} m"
        print(f"{size}: least index {index:.4f}, largest Floquet exponent {largest:+.4f} 1/s")

shown(draw_figure(14))

# %%
# Stability: K2 above; below, its growth rate K2/(2 n2) (marks) beside the largest Floquet exponent (lines).
shown(draw_figure(15))

# %%
# Yaw.
shown(draw_figure(16))

# %%
# Mariner: roll.
shown(draw_figure(17))

# %%
# Mariner: stability.
shown(draw_figure(18))

# %%
# Mariner: yaw.
shown(draw_figure(19))
