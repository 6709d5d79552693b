"""The scoreboard as a user meets it."""

import json

import pytest
from typer.testing import CliRunner

from quartering.study.paper import scoreboard
from quartering.view.cli import app


@pytest.fixture
def _two_claims(monkeypatch):
    """The first two of them, which cost little."""
    monkeypatch.setattr(scoreboard, "CLAIMS", scoreboard.CLAIMS[:2])


def measured(*words):
    """What the command ends with."""
    return CliRunner().invoke(app, ["figures", "--scoreboard", *map(str, words)])


@pytest.mark.usefixtures("_two_claims")
def test_table_names_claim_answer_and_evidence_and_the_page_is_written(tmp_path):
    printed = measured("-o", tmp_path / "board.md").stdout
    assert "2 claims over ground, as the paper: 1 holds, 1 holds in part" in " ".join(printed.split())
    assert "wave force" in printed
    assert "| Figs. 2-4 | holds | without it the error is" in (tmp_path / "board.md").read_text()


@pytest.mark.usefixtures("_two_claims")
def test_json_has_a_row_a_claim():
    rows = json.loads(measured("--json").stdout)["claims"]
    assert [row["answer"] for row in rows] == ["holds", "holds in part"]
    assert all(row["evidence"] and row["where"] and row["through_water"]["evidence"] for row in rows)


def test_another_ending_is_refused_before_the_work(tmp_path):
    refused = measured("-o", tmp_path / "board.txt")
    assert refused.exit_code == 2
    assert "must end in" in refused.stderr
