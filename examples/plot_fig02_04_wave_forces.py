"""
Figs. 2-4: wave forces over heading
===================================

The paper computes the pressure of the undisturbed wave on the hull (Froude-Krylov) and corrects it, strip by strip,
for the way the hull disturbs the wave. Its Figs. 2, 3 and 4 show sway force, roll moment and yaw moment over heading
with and without that correction.

What agrees: sway force is largest in beam seas, yaw moment has two humps,
in quartering and in bow seas, and the pressure alone gives a roll moment that is largest in beam seas.

What does not: the printed correction has the wrong sign of the wave slope (see the errata page). In beam seas of the
ship's length it leaves nearly four times the roll moment of the corrected one. With the sign put right the correction
takes moment *away* there, and the roll moment has two humps, near 60 and 125 deg, with a dip between them.
"""

# %%
# Both forms of the correction, and a third with the speed of the ship in it (Salvesen, Tuck and Faltinsen).
import quartering as qt
from quartering.study.paper.conditions import speed_of
from quartering.view.plots.paper_figures import draw_figure
from quartering.view.plots.style import shown

ship = qt.ship("series60-cb60").with_(velocities="absolute", drag="cubic", ends="strips", righting="polynomial")
forces = qt.compare_forces(ship, [ship.hull.length], [60.0, 90.0, 120.0], speed_of(ship)).isel(wave_length=0)
for form in ("froude-krylov", "stf", "paper", "paper-corrected"):
    one = forces.sel(form=form, mode="roll")
    moments = (one["amplitude"].values / 1e6).round(2)
    print(f"roll moment at 60, 90, 120 deg [MN m/m]: {moments}  {form}: {one['meaning'].item()}")

# %%
# Sway force: diffraction more than doubles it.
shown(draw_figure(2))

# %%
# Roll moment: what is left of two large parts that nearly cancel in beam seas. It depends on where G is, so on the
# assumed GM.
shown(draw_figure(3))

# %%
# Yaw moment.
shown(draw_figure(4))
