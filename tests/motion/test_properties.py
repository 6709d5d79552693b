"""Symmetries and limits every solution must respect."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from quartering.conventions import CUBIC_MONOMIALS, InputError
from quartering.motion.equations.model import Model
from quartering.motion.equations.terms import parse, term_table
from quartering.motion.status import Status
from quartering.motion.steady.motion import steady_motion
from tests.reference import DYNAMICS, model_of

numbers = st.floats(-1.0, 1.0, allow_nan=False)


@st.composite
def models(draw, strength=0.1):
    damping = [draw(st.floats(0.05, 1.0)) for _ in range(3)]
    terms = {"Y_v": -damping[0], "K_p": -damping[1], "N_r": -damping[2], "K_phi": -1.0}
    for row in "YKN":
        for monomial in CUBIC_MONOMIALS:
            terms[f"{row}_{monomial}"] = strength * draw(numbers)
    terms["K_phiphiphi"] = strength * draw(numbers)
    force = [0.1 * draw(numbers) for _ in range(6)]
    return Model(np.eye(3), terms, draw(st.floats(0.3, 2.0)), force[:3], force[3:])


@settings(max_examples=40, deadline=None, derandomize=True)
@given(models())
def test_reversing_the_wave_reverses_the_motion(model):
    """(y, t) -> (-y, t + T/2) leaves the equations as they are: [H71] eq. (3) has odd terms only."""
    motion = steady_motion(model, 3)
    mirror = steady_motion(Model(model.inertia, model.terms, model.frequency, -model.force_cos, -model.force_sin), 3)
    np.testing.assert_allclose(mirror.cos, -motion.cos, atol=1e-12)
    np.testing.assert_allclose(mirror.sin, -motion.sin, atol=1e-12)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(models(), st.floats(0.2, 5.0))
def test_changing_the_unit_of_time_changes_nothing(model, factor):
    """Froude scaling of time: t -> factor t multiplies each coefficient by its power of 1/time."""
    scaled = {}
    for name, value in model.terms.items():
        factors = parse(name)[1].powers
        scaled[name] = value * factor ** (factors[0] + factors[2] + factors[3] - 2)
    other = Model(
        model.inertia, scaled, model.frequency / factor, model.force_cos / factor**2, model.force_sin / factor**2
    )
    first, second = steady_motion(model, 3), steady_motion(other, 3)
    np.testing.assert_allclose(second.cos, first.cos, atol=1e-11)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(models(strength=0.2))
def test_small_waves_give_the_linear_response(model):
    """Linear limit: the difference from the linear solution falls with the square of the wave height."""

    def relative(factor):
        terms = model.terms
        full = steady_motion(
            Model(np.eye(3), terms, model.frequency, factor * model.force_cos, factor * model.force_sin)
        )
        linear_terms = {k: v for k, v in terms.items() if parse(k)[1].degree == 1}
        linear = steady_motion(
            Model(np.eye(3), linear_terms, model.frequency, factor * model.force_cos, factor * model.force_sin)
        )
        return np.abs(full.cos[0] - linear.cos[0]).max() / factor

    assert relative(1e-3) <= 1.1e-2 * relative(1e-2) + 1e-13


@settings(max_examples=20, deadline=None, derandomize=True)
@given(models(strength=0.3), st.integers(0, 10**6))
def test_the_inertia_form_does_not_matter(model, seed):
    """Multiplying inertia, terms and forces by one matrix leaves the accelerations alone ([H71] eq. (3))."""
    mix = np.eye(3) + 0.3 * np.random.default_rng(seed).uniform(-1, 1, (3, 3))
    terms: dict[str, float] = {}
    for name, value in model.terms.items():
        row, _ = parse(name)
        for k, letter in enumerate("YKN"):
            key = letter + name[1:]
            terms[key] = terms.get(key, 0.0) + mix[k, row] * value
    mixed = Model(mix, terms, model.frequency, mix @ model.force_cos, mix @ model.force_sin)
    np.testing.assert_allclose(steady_motion(mixed, 3).cos, steady_motion(model, 3).cos, atol=1e-11)


@pytest.mark.parametrize("name", ["A_roll_only", "B_ship_moderate", "D_fold_strong"])
def test_error_falls_geometrically_with_the_number_of_harmonics(name):
    """Convergence: harmonic balance of a smooth system; reference state of the orbit in 40-digit arithmetic."""
    case = DYNAMICS["cases"][name]
    model, exact = model_of(case), np.array(case["solutions"][0]["orbit"]["state0"])
    errors = [np.abs(steady_motion(model, h).state(0.0) - exact).max() for h in (3, 5, 7, 9, 11)]
    ratios = np.array(errors[1:]) / np.array(errors[:-1])
    assert (ratios < 0.1).all(), errors
    assert errors[-1] < 1e-9


def test_without_motion_the_status_says_what_to_do():
    softening = {"Y_v": -1.0, "N_r": -1.0, "K_phi": -1.0, "K_phiphiphi": 1.0, "K_p": -0.01}
    motion = steady_motion(Model(np.eye(3), softening, 0.9, (0, 5.0, 0), (0, 0, 0)), 3, fixed=True)
    if motion.status.ok:  # the polynomial has far solutions beyond the vanishing angle: they must be found honestly
        assert motion.residual < 1e-10
    else:
        assert np.isnan(motion.cos).all()
        assert "lower wave" in motion.status.advice


def test_nan_coefficients_are_refused_at_the_door():
    with pytest.raises(InputError, match="finite"):
        term_table({"K_p": float("nan")})


@pytest.mark.parametrize("frequency", [0.0, -0.3, float("nan")])
def test_encounter_frequency_must_be_positive(frequency):
    with pytest.raises(InputError, match="encounter frequency"):
        Model(np.eye(3), {"K_phi": -1.0}, frequency, (0, 0, 0), (0, 0, 0))


@pytest.mark.parametrize(("name", "hint"), [("K_qpp", "K_"), ("Z_ppp", "_ppp"), ("K_pppp", "K_ppp"), ("N_", "N_")])
def test_unknown_terms_name_the_nearest(name, hint):
    with pytest.raises(InputError, match=hint):
        parse(name)


def test_singular_inertia_is_refused():
    with pytest.raises(InputError, match="singular"):
        Model(np.ones((3, 3)), {"K_phi": -1.0}, 1.0, (0, 0, 0), (0, 0, 0))


def test_status_enum_advises_for_every_outcome():
    assert all(len(status.advice) > 20 for status in Status)
