"""What follows from the hull alone is found once for it, however often a verdict asks."""

import sys

import pytest

import quartering as qt
from quartering.hull import hydrostatics
from quartering.hull.lines import immersed
from quartering.hull.righting import heeled
from quartering.hydro.strip import ends, moments
from quartering.study.condition.examine import examine, facts

OF_THE_HULL = {
    "particulars": hydrostatics._floating,
    "strips": immersed.strips,
    "section table": moments.section_table,
    "integrals over the hull": moments.hull_moments,
    "ends": ends.end_effect,
}


@pytest.fixture
def emptied():
    """Nothing remembered anywhere: a memory of what follows from these would hide that they are asked for."""
    for name, module in list(sys.modules.items()):
        if name.startswith("quartering"):
            for one in vars(module).values():
                if hasattr(one, "cache_clear"):
                    one.cache_clear()


@pytest.mark.usefixtures("emptied")
def test_a_verdict_finds_what_follows_from_the_hull_once():
    """Counted along the verdict of a ship as the command gives it, and of the same hull loaded otherwise."""
    one, wave = qt.ship("series60-cb60"), qt.Wave("1.2L", "4 m", ship=qt.ship("series60-cb60"))
    facts(examine(one, wave, 7.5, 30.0), [])
    assert {name: of.cache_info().misses for name, of in OF_THE_HULL.items()} == dict.fromkeys(OF_THE_HULL, 1)
    heeled_at = heeled.cross_curve.cache_info()
    assert heeled_at.misses == heeled_at.currsize  # each set of angles once
    facts(examine(one.with_(gm=1.2, gyradius_roll="0.38 B"), wave, 7.5, 60.0), [])
    assert {name: of.cache_info().misses for name, of in OF_THE_HULL.items()} == dict.fromkeys(OF_THE_HULL, 1)
