"""
Fig. 23: Duffing's equation
===========================

Appendix C of the paper tries its method on Duffing's equation: Struble's formula (C-3), the modified method (C-4),
and Hsu's (C-5). Here they stand beside the exact motion: harmonic balance to the 11th harmonic, followed through its
fold, with its stability.

The modified method is much better than Struble's away from the natural frequency, as the paper says. It gives the
*fundamental*. (C-5) is not its rival but the same method with the third harmonic, and what its P is depends on where:
the *peak* away from resonance, the *fundamental* on the backbone curve, there to one order more than (C-4).
"""

# %%
# Numbers at a few frequencies; a minus sign means opposite in phase to the force.
from quartering.study.paper.duffing import duffing_table
from quartering.study.paper.sets import DUFFING
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

for frequency in (0.6, 1.0, 1.3, 1.6):
    for row in duffing_table(**DUFFING, frequency=frequency):
        formulas = ", ".join(f"{name} {row[name]:+.4f}" for name in ("C-3", "C-4", "C-5"))
        state = "stable" if row["stable"] else "unstable"
        print(f"{frequency}: fundamental {row['fundamental']:+.4f}, peak {row['peak']:+.4f}, {state}; {formulas}")

shown(draw_figure(23))
