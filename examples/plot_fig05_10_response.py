"""
Figs. 5-10: response over heading
=================================

Steady motion of two ships of Series 60 by the paper's method, over heading, for waves of 0.75, 1 and 1.5 ship lengths
and one steepness.

The paper finds two peaks of roll: one in beam seas, where the wave's moment is largest, and one in quartering seas,
where the frequency of encounter meets that of roll. **The quartering peak is there**, for both ships and all waves, a
few degrees beyond the heading at which the two frequencies are equal, because the righting arm stiffens with roll.
**The beam-sea peak is not**: in the shortest wave a low hump stands at 111 deg, no more. Another page (two roll
peaks) tells why.
"""

# %%
# Where roll peaks, and where the frequencies meet.
import numpy as np

import quartering as qt
from quartering.study.condition.resonance import resonant_headings
from quartering.study.paper.curves import response_curves
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

for name in ("series60-cb60", "series60-cb70"):
    ds = response_curves(qt.ship(name).with_(velocities="absolute", drag="cubic", ends="strips", righting="polynomial"))
    for i, length in enumerate(ds["wave_length"].values):
        one = ds.isel(wave_length=i)
        peak = int(np.argmax(one["roll"].values))
        print(
            f"{name}, wave {length:.0f} m: roll {float(one['roll'][peak]):.1f} deg at {float(one['heading'][peak]):.0f} deg;"
            f" frequencies meet at {resonant_headings(one)[0]:.0f} deg"
        )

# %%
# CB 0.60: sway (amplitude of the integrated sway velocity, the paper's x1), roll, yaw.
shown(draw_figure(5))

# %%
# Roll. The large marks on the axis are the headings of resonance.
shown(draw_figure(6))

# %%
# Yaw has its own hump near 43 deg, from the yaw moment, and a second one where roll is large and drives it.
shown(draw_figure(7))

# %%
# CB 0.70: the fuller ship rolls less in these waves, at headings a few degrees nearer to following seas.
shown(draw_figure(8))

# %%
# Roll.
shown(draw_figure(9))

# %%
# Yaw.
shown(draw_figure(10))
