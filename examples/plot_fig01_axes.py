"""
Fig. 1: axes and heading
========================

The paper's Fig. 1 defines the axes and the angle to the waves. Everything else hangs on it: a wrong sign here turns a
quartering sea into a bow sea. This library counts the heading as seakeepers do, 0 following to 180 head; the paper's
angle is delta = 180 deg - mu.
"""

# %%
# The wave below comes from the port quarter. Its frequency of encounter is lower than the wave's own, because the
# ship runs away from it.
import numpy as np

import quartering as qt
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

wave_frequency = np.sqrt(9.81 * 2 * np.pi / 121.92)  # a wave of the ship's length, in deep water
for heading in (0, 30, 90, 150, 180):
    met = float(qt.encounter_frequency(wave_frequency, 8.65, heading))
    print(f"heading {heading:3d} deg: wave {wave_frequency:.3f} rad/s, met at {met:.3f} rad/s")

shown(draw_figure(1))
