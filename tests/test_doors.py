"""Whatever is given to the public functions: one message; and ships, models and results go to other processes."""

import copy
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

import quartering as qt
from quartering.hull.file.yaml_text import read_yaml

SHIP, WAVE = qt.ship("wigley"), qt.Wave(80.0, 2.0)
MODEL = qt.equations(SHIP, WAVE, 5.0, 60.0)
MOTION = qt.steady_motion(MODEL)
RECORDS = {
    "ship": SHIP, "model": MODEL, "coefficients": qt.coefficients(SHIP, 0.8, 5.0), "motion": MOTION,
    "verdict": qt.stability(MODEL, MOTION),
}  # fmt: skip


@pytest.mark.parametrize(
    "way", [copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))], ids=["deepcopy", "pickle"]
)
@pytest.mark.parametrize("name", RECORDS)
def test_a_record_is_the_same_after_a_copy(name, way):
    other = way(RECORDS[name])
    assert type(other) is type(RECORDS[name])
    assert repr(other) == repr(RECORDS[name])
    if name == "ship":
        assert qt.hydrostatics(other) == qt.hydrostatics(SHIP)
        with pytest.raises(TypeError):
            other.overrides["K_ppp"] = 1.0


CALLS = {
    "equations": lambda one: qt.equations(one, WAVE, 5.0, 60.0),
    "wave": lambda one: qt.equations(SHIP, one, 5.0, 60.0),
    "steady_motion": lambda one: qt.steady_motion(one),
    "simulate": lambda one: qt.simulate(one, 10.0),
    "irregular": lambda one: qt.irregular(one, 10.0),
    "stability": lambda one: qt.stability(MODEL, one),
    "stability of": lambda one: qt.stability(one, MOTION),
    "hydrostatics": lambda one: qt.hydrostatics(one),
    "righting_arm": lambda one: qt.righting_arm(one, [10.0]),
    "coefficients": lambda one: qt.coefficients(one, 0.8, 5.0),
    "hydrodynamics": lambda one: qt.hydrodynamics(one, [0.5]),
    "section_coefficients": lambda one: qt.section_coefficients(one, [0.5]),
    "wave_forces": lambda one: qt.wave_forces(SHIP, one),
    "ship": lambda one: qt.ship(one),
    "basin": lambda one: qt.basin(one, [10.0], [0.0]),
    "hill_exponents": lambda one: qt.hill_exponents(MODEL, one),
    "kramers_kronig": lambda one: qt.kramers_kronig(one),
    "retardation": lambda one: qt.retardation([0.5, 1.0], one, [1.0]),
    "read_capytaine": lambda one: qt.read_capytaine("no.nc", one),
    "guidance": lambda one: qt.guidance(one, 2.0, 8.0),
    "direct_assessment": lambda one: qt.direct_assessment(one, 5.0),
    "direct_assessment by": lambda one: qt.direct_assessment(SHIP, 5.0, hours=one if one != 3.0 else "x"),
    "design_point": lambda one: qt.design_point(one, qt.Sea(hs=2, tp=8), 5.0, 20.0),
    "design_point in": lambda one: qt.design_point(SHIP, one, 5.0, 20.0),
    "lyapunov": lambda one: qt.lyapunov(one, qt.Sea(hs=2, tp=8), 5.0),
    "largest_roll": lambda one: qt.largest_roll(one, 10.0),
    "long_term": lambda one: qt.long_term(one),
    "write_wamit": lambda one: qt.write_wamit(one, "x", SHIP),
}


@pytest.mark.parametrize("given", [None, [1, 2], 3.0, "x", {}], ids=repr)
@pytest.mark.parametrize("name", CALLS)
def test_an_argument_of_another_kind_is_refused_in_one_message(name, given):
    with pytest.raises(qt.InputError):
        CALLS[name](given)


@pytest.mark.parametrize(
    "call",
    [
        lambda: SHIP.with_(gm=10**400),
        lambda: SHIP.with_(gm=1e-308),
        lambda: SHIP.with_(roll_damping="100.1 %"),
        lambda: SHIP.with_(water_density=1),
        lambda: SHIP.with_(values={"K_ppp": 10**400}),
        lambda: qt.Wave(10**400, 2.0),
        lambda: qt.equations(SHIP, WAVE, 10**400, 60.0),
        lambda: qt.equations(SHIP, WAVE, 5.0, 1e300),
        lambda: qt.equations(SHIP, WAVE, 5.0, 400.0),
        lambda: qt.equations(SHIP, WAVE, np.nan, 60.0),
    ],
)
def test_a_number_without_sense_is_refused(call):
    with pytest.raises(qt.InputError):
        call()


NUMBERS = {
    "coefficients": lambda one: qt.coefficients(SHIP, one, 5.0),
    "coefficients at": lambda one: qt.coefficients(SHIP, 0.8, one),
    "encounter_frequency": lambda one: qt.encounter_frequency(0.5, one, 60.0),
    "hydrodynamics": lambda one: qt.hydrodynamics(SHIP, one),
    "hydrodynamics6": lambda one: qt.hydrodynamics6(SHIP, one),
    "responses": lambda one: qt.responses(SHIP, WAVE, one),
    "responses to": lambda one: qt.responses(SHIP, WAVE, 5.0, one),
    "righting_arm": lambda one: qt.righting_arm(SHIP, one),
    "section_coefficients": lambda one: qt.section_coefficients(SHIP.hull.sections[3], one),
    "wave_forces": lambda one: qt.wave_forces(SHIP, WAVE, one),
    "surf_riding_map": lambda one: qt.surf_riding_map(SHIP, one, 0.05),
    "parametric_map": lambda one: qt.parametric_map(SHIP, "1.0L", one, [5.0]),
    "parametric_map at": lambda one: qt.parametric_map(SHIP, "1.0L", [2.0], one),
    "limiting_kg": lambda one: qt.limiting_kg(SHIP, one, levels=["pure_loss.level1"]),
    "sweep": lambda one: qt.sweep(SHIP, one, 60.0, 80.0, 2.0),
    "sweep of": lambda one: qt.sweep(SHIP, 5.0, 60.0, one, 2.0),
    "basin": lambda one: qt.basin(MODEL, one, [0.0]),
    "retardation": lambda one: qt.retardation(one, [0.0, 1.0], [1.0]),
    "failure_rate_at": lambda one: qt.failure_rate_at(5.0, [6.0, 7.0, 8.0], one, [1e3, 1e3, 1e3]),
    "failure_rate_at after": lambda one: qt.failure_rate_at(5.0, [6.0, 7.0, 8.0], [30, 60, 90], one),
    "decay_record": lambda one: qt.decay_record(one, one),
    "Section": lambda one: qt.Section(one, [4.0, 0.0]),
    "Propulsion": lambda one: qt.Propulsion(one, diameter=2.6, thrust=(0.36, -0.28, -0.12)),
    "Propulsion of": lambda one: qt.Propulsion([0.0, 1e3], diameter=one, thrust=(0.36, -0.28, -0.12)),
    "Wave": lambda one: qt.Wave(period=one, height=2.0),
    "Model": lambda one: qt.Model(one, {"K_phi": -1.0}, 1.0, (0, 0.1, 0), (0, 0, 0)),
    "Model under": lambda one: qt.Model(np.eye(3), {"K_phi": -1.0}, 1.0, one, (0, 0, 0)),
    "Model at": lambda one: qt.Model(np.eye(3), {"K_phi": -1.0}, one if one != 1e300 else "x", (0, 0.1, 0), (0, 0, 0)),
}
RADIATION = qt.hydrodynamics(SHIP, np.linspace(0.1, 3.0, 12))
NO_NUMBERS = [b"5", True, np.datetime64("2020-01-01"), 10**400, 1e300, [], {}, object(), [[1.0, 2.0], [3.0]], 1 + 2j]


@pytest.mark.parametrize("given", NO_NUMBERS, ids=lambda one: type(one).__name__)
@pytest.mark.parametrize("name", NUMBERS)
def test_what_is_no_number_or_without_sense_is_refused_wherever_several_may_stand(name, given):
    with pytest.raises(qt.InputError):
        NUMBERS[name](given)


WORDS = {
    "branch": lambda one: qt.branch(MODEL, one),
    "edge": lambda one: qt.edge(MODEL, one),
    "broaching_branch": lambda one: qt.broaching_branch(SHIP, WAVE, 9.0, one),
    "tornado": lambda one: qt.tornado(SHIP, WAVE, 5.0, 60.0, parameters=one),
    "limiting_kg": lambda one: qt.limiting_kg(SHIP, levels=one),
    "paper_ship": lambda one: qt.paper_ship(one),
    "equations": lambda one: qt.equations(SHIP, WAVE, 5.0, 60.0, one),
    "wave_forces": lambda one: qt.wave_forces(SHIP, WAVE, form=one),
    "polar": lambda one: qt.polar(SHIP, WAVE, [5.0], [60.0], form=one),
    "gm_in_waves": lambda one: qt.gm_in_waves(SHIP, WAVE, balance=one),
    "righting_arm": lambda one: qt.righting_arm(SHIP, [10.0], WAVE, balance=one),
    "responses": lambda one: qt.responses(SHIP, WAVE, place=one),
    "sea_response": lambda one: qt.sea_response(SHIP, qt.Sea(hs=2, tp=8), 5.0, place=one),
    "sensitivity": lambda one: qt.sensitivity(SHIP, WAVE, 5.0, 60.0, harmonics=one if one != 3.0 else "x"),
    "factors": lambda one: qt.sweep(SHIP, 5.0, 60.0, 80.0, 2.0, factors=one if one else 1.0),
    "values": lambda one: qt.sweep(SHIP, 5.0, 60.0, 80.0, 2.0, values=one if one else 1.0),
    "kramers_kronig": lambda one: qt.kramers_kronig(RADIATION, added_mass_infinite=one),
    "terms": lambda one: qt.Model(np.eye(3), one if one else 1.0, 1.0, (0, 0.1, 0), (0, 0, 0)),
    "measured": lambda one: SHIP.with_(measured=one),
    "loading_case": lambda one: SHIP.with_(loading_case=one),
    "spreading": lambda one: qt.Sea(hs=2, tp=8, spreading=one if one != 3.0 else "x"),
    "spectrum": lambda one: qt.Sea(hs=2, tp=8, spectrum=one),
    "edge limits": lambda one: qt.edge(MODEL, ("frequency", "excitation"), limits=one),
    "read_capytaine": lambda one: qt.read_capytaine(one, SHIP),
    "read_wamit": lambda one: qt.read_wamit(one, SHIP),
    "read_decay": lambda one: qt.read_decay(one),
}


@pytest.mark.parametrize(
    "given", [3.0, [], {}, b"gm", "", ["gm", 2], [["gm"]], object()], ids=lambda one: type(one).__name__
)
@pytest.mark.parametrize("name", WORDS)
def test_what_is_no_word_no_file_or_no_place_is_refused(name, given):
    with pytest.raises(qt.InputError):
        WORDS[name](given)


@pytest.mark.parametrize(
    "call",
    [
        lambda: qt.Wave(1e300, 2.0),
        lambda: qt.gm_in_waves(SHIP, WAVE, positions=10**9),
        lambda: qt.design_point(SHIP, qt.Sea(hs=2, tp=8), 5.0, 20.0, windows=10**400),
        lambda: qt.simulate(MODEL, 10.0, [[1.0, 2.0], [3.0]]),
        lambda: qt.simulate(MODEL, 10.0, speed=5.0),
        lambda: qt.simulate(MODEL, 10.0, heading=60.0),
        lambda: qt.failure_rate_at(5.0, [6.0, 7.0, 8.0], [30, 60, 90], [1e3, 1e3, 1e3], confidence=2.0),
    ],
)
def test_a_size_without_sense_is_refused_before_anything_is_made(call):
    with pytest.raises(qt.InputError):
        call()


def test_aliases_of_aliases_are_refused_before_they_grow(tmp_path):
    """9 to the power of 11 values; nothing is expanded."""
    lines = ["a0: &a0 {x: 1}"]
    lines += [f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9)}]" for k in range(1, 12)]
    path = tmp_path / "a.yaml"
    path.write_text("\n".join(lines))
    with pytest.raises(qt.InputError, match="stand for more than"):
        read_yaml(path)
    path.write_text("a: &a [*a]")
    with pytest.raises(qt.InputError, match="stands inside what it names"):
        read_yaml(path)
    path.write_text("a: &a {x: 1}\nb: *a\nc: {<<: *a, y: 2}\n")
    assert read_yaml(path)["c"] == {"x": 1, "y": 2}


def command(*words, **environment):
    code = "from quartering.view.cli import main; main()"
    line = f'"{sys.executable}" -c "{code}" {" ".join(words)}'
    return subprocess.run(
        line, shell=True, capture_output=True, text=True, env={**os.environ, **environment}, check=False
    )


def test_a_closed_output_and_a_number_of_threads_that_is_none_are_one_line():
    closed = command("ships", ">&-")
    assert (closed.returncode, closed.stderr.count("\n")) == (2, 1)
    assert "standard output is closed" in closed.stderr
    threads = command("ships", NUMBA_NUM_THREADS="abc")
    assert (threads.returncode, threads.stdout) == (2, "")
    assert "NUMBA_NUM_THREADS='abc'" in threads.stderr
