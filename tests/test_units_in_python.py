"""Every public function takes text with a unit, and refuses a bad argument in the words of the table."""

import numpy as np
import pytest

import quartering as qt

RECORD = "tests/data/kvlcc2_roll_decay.csv"
SHIP, WAVE, KNOT = qt.ship("wigley"), qt.Wave("80 m", "2 m"), 1852 / 3600
SQUARE = qt.Section(y=[0, 5, 5], z=[4, 4, 0])
MODEL = qt.Model(
    np.eye(3), {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": -0.2, "K_p": -0.04}, 1.2, (0, 0.1, 0), (0, 0, 0)
)

TWO_WAYS = {
    "hydrodynamics": (
        lambda f, u: qt.hydrodynamics(SHIP, f, u).damping, (["0.1 Hz"], "10kn"), ([0.2 * np.pi], 10 * KNOT)
    ),
    "hydrodynamics6": (
        lambda f, p: qt.hydrodynamics6(SHIP, f, 0.0, reference=p).added_mass, (["0.1 Hz"], ("0.1 L", "0.5 T")),
        ([0.2 * np.pi], (10.0, 3.125)),
    ),
    "coefficients": (
        lambda f, u: qt.coefficients(SHIP, f, u).linear, ("0.1 Hz", "10kn"), (0.2 * np.pi, 10 * KNOT)
    ),
    "section_coefficients": (
        lambda f, d: qt.section_coefficients(SQUARE, f, density=d).a22, (["0.1 Hz"], "1 t/m3"), ([0.2 * np.pi], 1000.0)
    ),
    "righting_arm": (lambda a: qt.righting_arm(SHIP, a), (["10 deg", "0.2 rad"],), ([10.0, np.degrees(0.2)],)),
    "encounter_frequency": (
        qt.encounter_frequency, ("0.1 Hz", ["10kn"], "1 rad"), (0.2 * np.pi, [10 * KNOT], np.degrees(1.0))
    ),
    "simulate": (
        lambda d, s, dt: qt.simulate(MODEL, d, s, dt)["roll"], ("0.1 min", (0, "5 deg", "1 deg/s", 0), "5 s"),
        (6.0, (0, np.radians(5), np.radians(1), 0), 5.0),
    ),
    "irregular": (
        lambda f, p, d, dt, most: qt.irregular(MODEL, f, [[0, 0.03, 0]], p, d, step=dt, limit=most).roll_peak,
        (["0.1 Hz"], [["30 deg"]], "1 min", "2 s", "90 deg"),
        ([0.2 * np.pi], [[np.pi / 6]], 60.0, 2.0, np.pi / 2),
    ),
    "branch": (
        lambda pair: qt.branch(MODEL, limits=pair, harmonics=1).frequency, (("0.15 Hz", "0.2 Hz"),),
        ((0.3 * np.pi, 0.4 * np.pi),),
    ),
    "roll_decay": (
        lambda u: qt.roll_decay(SHIP, RECORD, speed=u).roll_damping, ("2 kn",), (2 * KNOT,)
    ),
    "compare_forces": (
        lambda n, mu, u: qt.compare_forces(SHIP, n, mu, u).amplitude, (["0.8L"], ["1 rad"], "5kn"),
        ([80.0], [np.degrees(1.0)], 5 * KNOT),
    ),
    "Sea": (
        lambda hs, tp, mu: (sea := qt.Sea(hs=hs, tp=tp, heading=mu)) and [sea.hs, sea.tp, sea.heading],
        ("400 cm", "0.2 min", "1 rad"), (4.0, 12.0, np.degrees(1.0)),
    ),
    "sea_response": (
        lambda u, mu: qt.sea_response(SHIP, qt.Sea(hs=1, tp=8), u, mu).roll_rms, ("10kn", ["1 rad"]),
        (10 * KNOT, [np.degrees(1.0)]),
    ),
    "guidance": (
        lambda hs, tz, u, mu: qt.guidance(SHIP, hs, tz=tz, speed=u, heading=mu).roll_rms,
        ("100..200 cm step 50", ["0.1 min"], "10 kn", ["1 rad"]),
        ([1.0, 1.5, 2.0], [6.0], [10 * KNOT], [np.degrees(1.0)]),
    ),
    "Autopilot": (lambda *g: list(vars(qt.Autopilot(*g)).values()), (1, "0.1 min", "2 s"), (1.0, 6.0, 2.0)),
    "Loading": (
        lambda *g: list(vars(qt.Loading(*g)).values()), ("100 cm", "5.1 m", 3.0, 25.0, "5 %", "1 t/m3"),
        (1.0, 5.1, 3.0, 25.0, 0.05, 1000.0),
    ),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore::quartering.RangeWarning")
@pytest.mark.parametrize("name", TWO_WAYS)
def test_text_with_a_unit_is_the_number_in_si(name):
    call, text, number = TWO_WAYS[name]
    np.testing.assert_allclose(call(*text), call(*number), rtol=1e-9)


REFUSED = {
    "hydrodynamics": (lambda: qt.hydrodynamics(SHIP, [-1.0]), "frequency = -1 rad/s; it is from 0 rad/s to 10000 rad/s"),
    "hydrodynamics6": (lambda: qt.hydrodynamics6(SHIP, ["1 s"]), 'frequency = 1 s; unit "s" is not known'),
    "coefficients": (lambda: qt.coefficients(SHIP, "x", 5.0), "frequency = 'x'; that is no finite number"),
    "section": (lambda: qt.section_coefficients(SQUARE, [1.0], density=-1), r"density = -1 kg/m3; it is above 0 kg/m3"),
    "righting_arm": (lambda: qt.righting_arm(SHIP, [100]), "heel = 100 deg; it is from -90 deg to 90 deg"),
    "encounter": (lambda: qt.encounter_frequency(0.5, 5.0, 400), "heading = 400 deg; .*did you mean 40 deg"),
    "simulate": (lambda: qt.simulate(MODEL, "10 m"), 'duration = 10 m; unit "m" is not known for a time'),
    "start": (lambda: qt.simulate(MODEL, 10, (0, "5 kn", 0, 0)), 'roll = 5 kn; unit "kn" is not known'),
    "irregular": (
        lambda: qt.irregular(MODEL, [0.5], [[0, 1, 0]], [[0]], 10, step=-1), "step = -1 s; it is above 0 s"
    ),
    "limits": (lambda: qt.branch(MODEL, limits=(-1, 1)), "limits of frequency: frequency = -1 rad/s; it is above 0"),
    "one limit": (lambda: qt.branch(MODEL, limits=3), "limits = 3 of frequency; they are two"),
    "points": (lambda: qt.branch(MODEL, points=0), "points = 0; it is a whole number of 2 or more"),
    "branch": (lambda: qt.branch(None), "ship_or_model = None is no Ship or Model"),
    "edge": (lambda: qt.edge(MODEL, "frequency"), "two of each are needed"),
    "edge of": (lambda: qt.edge(3), "ship_or_model = 3 is no Ship or Model"),
    "vary": (lambda: qt.vary(None, WAVE, 5, 60, {"gm": [1, 2]}), "ship = None is no Ship"),
    "parameters": (lambda: qt.vary(SHIP, WAVE, 5, 60, ["gm"]), "it is a mapping"),
    "sweep": (lambda: qt.sweep("wigley", 5, 60, 80, 2), "ship = 'wigley' is no Ship"),
    "tornado": (lambda: qt.tornado(SHIP, WAVE, 5, 60, change=5), "change = 5; .*did you mean 5 %"),
    "all_motions": (lambda: qt.all_motions(SHIP), "is no Model"),
    "compare_forces": (lambda: qt.compare_forces(SHIP, [80], [60], bem=3), "bem = 3 is no Dataset"),
    "bem_forces": (lambda: qt.bem_forces(SHIP, ["80 kg"]), 'wave_length = 80 kg; unit "kg" is not known'),
    "bem_hydrodynamics": (lambda: qt.bem_hydrodynamics(SHIP, [0.0]), "frequency = 0 rad/s; it is above 0 rad/s"),
    "panels": (lambda: qt.bem_forces(SHIP, [80.0], panels=3), "panels = 3; they are two numbers"),
    "roll_decay": (lambda: qt.roll_decay(SHIP, RECORD, speed=-1), "speed = -1 m/s; it is from 0 m/s to 100 m/s"),
    "record": (lambda: qt.roll_decay(SHIP, 3), "record = 3 is no DecayRecord or str or Path"),
    "read_decay": (lambda: qt.read_decay(RECORD, time_factor=0), "time_factor = 0; it is above 0"),
    "polar": (lambda: qt.polar(SHIP, 3, [5], [60]), "wave = 3 is no Wave"),
    "guidance": (lambda: qt.guidance(SHIP, -1, 8), "hs = -1 m; it is above 0 m"),
    "guidance over": (lambda: qt.guidance(SHIP, 1, "8 m"), 'tp = 8 m; unit "m" is not known for a time'),
    "guidance beside": (lambda: qt.guidance(SHIP, 1, 8, swell=3), "swell = 3 is no Sea; give one, its heading the angle off"),
    "assessment": (lambda: qt.direct_assessment(SHIP, "8 s"), 'speed = 8 s; unit "s" is not known for a speed'),
    "guidance by": (lambda: qt.guidance(SHIP, 1, 8, judge="rate", threshold=2), "threshold = 2; it is above 0 and at most 1"),
    "Autopilot": (lambda: qt.Autopilot(-1), "autopilot_gain = -1; it is from 0 to 100"),
    "Loading": (lambda: qt.Loading("1 kg", 1, 1, 1), 'gm = 1 kg; unit "kg" is not known for a length'),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_an_argument_that_cannot_be_is_refused_with_its_range(name):
    call, words = REFUSED[name]
    with pytest.raises(qt.InputError, match=words):
        call()
