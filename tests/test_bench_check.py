"""The check of speed against recorded ratios: it fails on a lowered one. Nothing is timed here."""

import json
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture
def check(monkeypatch, tmp_path):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    sys.modules.pop("check", None)
    import check

    monkeypatch.setattr(check, "RECORDED", tmp_path / "recorded_ratios.json")
    yield check
    sys.modules.pop("check", None)


def results(path, ratio, *, kept=True, processor="a made-up processor"):
    """A file as `beside_rivals.py --json` writes it, with one rival."""
    job = {"ratios": {"numba, odd harmonics": {"median": ratio, "least": ratio, "most": ratio}}, "accuracy_kept": kept}
    path.write_text(json.dumps({"processor": processor, "load": 0.1, "jobs": {"cubic": job}}))
    return str(path)


def test_a_ratio_below_four_fifths_of_the_recorded_one_fails_and_is_named(check, tmp_path, capsys):
    file = tmp_path / "results.json"
    assert check.main(["--record", "--results", results(file, 4.0)]) == 0
    # 80 % of 4 is 3.2
    assert check.main(["--results", results(file, 3.21)]) == 0
    assert "kept cubic: numba, odd harmonics: 3.21" in capsys.readouterr().out
    assert check.main(["--results", results(file, 3.19)]) == 1
    assert "LOST cubic: numba, odd harmonics: 3.19" in capsys.readouterr().out


def test_a_recorded_ratio_that_was_not_measured_fails(check):
    sentences, lost = check.compared({}, {"cubic: numba, odd harmonics": 4.0})
    assert lost == 1
    assert "not measured" in sentences[0]


def test_results_of_unequal_accuracy_fail_however_large_the_ratio(check, tmp_path, capsys):
    file = tmp_path / "results.json"
    check.main(["--record", "--results", results(file, 4.0)])
    assert check.main(["--results", results(file, 40.0, kept=False)]) == 1
    assert "mean nothing" in capsys.readouterr().out


def test_another_kind_of_processor_has_nothing_to_be_compared_with_and_says_so(check, tmp_path, capsys):
    file = tmp_path / "results.json"
    check.main(["--record", "--results", results(file, 4.0)])
    assert check.main(["--results", results(file, 1.0, processor="another")]) == 0
    assert "nothing is recorded" in capsys.readouterr().out


def test_what_is_recorded_in_the_repository_can_be_read():
    every = json.loads((BENCHMARKS / "recorded_ratios.json").read_text())
    assert every
    assert all(value > 0 for ratios in every.values() for value in ratios.values())
