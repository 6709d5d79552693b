"""
Figs. 20, 21: metacentric height
================================

The paper says that less GM lowers roll at one heading and raises it at another, and costs stability. **Both hold.**
From 0.81 m to 0.49 m roll more than doubles at 45 deg and falls to a third at 60: the peak moves with the roll
frequency. The stability index falls at every heading. So the comfort of one course is paid for on another, and with
stability.
"""

# %%
# Roll at four headings.
from quartering.study.paper.sets import heights_of
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

ds = heights_of("series60-cb60")["gm"]
for i in range(ds.sizes["loading"]):
    one = ds.isel(loading=i)
    rolls = ", ".join(f"{float(one['roll'].sel(heading=h)):4.1f} at {h}" for h in (45, 60, 75, 90))
    print(
        f"GM {float(one['gm']):.2f} m: roll [deg] {rolls}; index at 30 deg {float(one['index'].sel(heading=30)):.4f} 1/s"
    )

shown(draw_figure(20))

# %%
# Stability: K2, and its growth rate beside the largest Floquet exponent. Nothing here is unstable; below 45 deg the
# slow sway-yaw modes, which do not feel GM, are nearer to it than roll.
shown(draw_figure(21))
