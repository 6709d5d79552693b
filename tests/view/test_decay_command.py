"""`quartering decay`: the file it writes, what it leaves alone, what it says, and what it refuses."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import yaml

import quartering as qt
from quartering.hull.file.changed import changed_text
from quartering.hydro.damping.natural_roll import free_roll
from quartering.hydro.decay.equation import free_decay
from quartering.hydro.decay.free_roll import free_damping

DATA = Path(__file__).parents[1] / "data"
S60 = qt.ship("series60-cb60")


def samples(zeta=0.02, d=0.4, first=12.0, swings=20):
    """Time [s] and angle [deg] of a decay with known damping at the frequency of the Series 60."""
    n2 = free_roll(S60).frequency
    t = np.linspace(0.0, swings * np.pi / n2, 30 * swings)
    return t, np.degrees(free_decay(t, (np.radians(first), 0.0), n2, zeta, quadratic=d))


def record(path, header="time_s,roll_deg", mark=",", comma=False, rows=None):
    t, phi = samples() if rows is None else rows
    header = header.replace(",", mark) if header.count(",") == 1 else header
    lines = [f"{a:.4f}{mark}{b:.5f}" for a, b in zip(t, phi, strict=True)]
    text = "\n".join([*([header] if header else []), *lines]) + "\n"
    path.write_text(text.replace(".", ",") if comma else text)


def test_it_writes_a_ship_that_decays_as_the_record(run, tmp_path):
    """Authority: the damping put into the record."""
    record(tmp_path / "record.csv")
    assert run("new", "series60-cb60", "my.yaml").exit_code == 0
    result = run("decay", "record.csv", "--ship", "my.yaml", "-o", "damped.yaml", "--picture", "decay.png")
    assert result.exit_code == 0, result.stderr
    assert (tmp_path / "decay.png").stat().st_size > 10_000
    damped = qt.ship(tmp_path / "damped.yaml")
    roll = free_damping(damped)
    assert roll.ratio == pytest.approx(0.02, abs=3e-5)
    assert roll.quadratic == pytest.approx(0.4, abs=2e-3)
    assert damped.provenance["roll_damping"].startswith(
        "measured: decay record record.csv, 0.02 of critical, less the waves"
    )
    sources = {entry.name: entry for entry in qt.coefficients(damped, 0.5, 0.0).table()}
    assert sources["K_p|p|"].kind == "measured"
    assert sources["K_p|p|"].source.startswith("measured: decay record record.csv, d = 0.4 1/rad, less the drag")
    words = " ".join(result.stdout.split())
    for needed in (
        "ship has already",
        "The ship has already: waves of the strips",
        "% of critical; drag of the sections",
        "C_D 0.8",
        "in place of 0.05 of critical",
    ):
        assert needed in words, needed


def test_everything_else_of_the_file_stays(run, tmp_path):
    record(tmp_path / "record.csv")
    run("new", "series60-cb60", "my.yaml")
    assert run("decay", "record.csv", "--ship", "my.yaml", "-o", "damped.yaml").exit_code == 0
    before, after = ((tmp_path / name).read_text().splitlines() for name in ("my.yaml", "damped.yaml"))
    gone = [line for line in before if line not in after]
    assert len(gone) == 1
    assert gone[0].lstrip().startswith("roll_damping:")
    old, new = (yaml.safe_load((tmp_path / name).read_text()) for name in ("my.yaml", "damped.yaml"))
    assert set(new) - set(old) == {"coefficients", "provenance"}
    assert {**new["loading"], "roll_damping": 0} == {**old["loading"], "roll_damping": 0}


def test_json_holds_both_parts(run, tmp_path):
    record(tmp_path / "record.csv")
    facts = json.loads(run("decay", "record.csv", "--ship", "series60-cb60", "--json").stdout)
    linear, quadratic = facts["parts"][:2]
    assert linear["has"] + linear["added"] == pytest.approx(linear["now"], rel=1e-9)
    assert linear["now"] == pytest.approx(linear["record"], rel=1e-9)
    assert quadratic["has"] == facts["drag"]
    assert quadratic["now"] == pytest.approx(0.4, abs=2e-3)
    assert facts["notes"] == facts["files"] == []


def test_radians_semicolons_model_time_and_further_columns_are_read(run, tmp_path):
    t, phi = samples()
    record(tmp_path / "deg.csv")
    record(tmp_path / "rad.csv", "t [s]; phi [rad]", "; ", rows=(t, np.radians(phi)))
    record(tmp_path / "model.csv", "time,roll", "\t", rows=(t / np.sqrt(25.0), phi))
    lines = [
        "n,time,heave,roll_deg",
        *(f"{k},{a:.4f},0.0,{b:.5f}" for k, (a, b) in enumerate(zip(t, phi, strict=True))),
    ]
    (tmp_path / "more.csv").write_text("\n".join(lines))
    found = [
        json.loads(run("decay", *words, "--ship", "series60-cb60", "--json").stdout)["roll_damping"]
        for words in (
            ["deg.csv"],
            ["rad.csv"],
            ["model.csv", "--unit", "deg", "--scale", "25"],
            ["more.csv", "--columns", "2,4"],
        )
    ]
    assert found == pytest.approx([found[0]] * 4, rel=2e-3)


def test_a_decay_without_quadratic_damping_adds_none_and_says_so(run, tmp_path):
    record(tmp_path / "record.csv", rows=samples(0.02, 0.0))
    result = run("decay", "record.csv", "--ship", "series60-cb60", "-o", "damped.yaml")
    assert result.exit_code == 0
    assert "no K_p|p| is added" in result.stderr
    assert "coefficients" not in yaml.safe_load((tmp_path / "damped.yaml").read_text())


GROWING = np.linspace(0.0, 100.0, 800)


@pytest.mark.parametrize(
    ("make", "words", "said"),
    [
        (lambda p: record(p), [], "no ship is named"),
        (lambda p: record(p), ["--ship", "no.yaml"], "neither a file nor a built-in ship"),
        (lambda p: record(p, "time,roll"), ["--ship", "box"], "is the angle in deg or rad?"),
        (lambda p: record(p, ""), ["--ship", "box"], "is the angle in deg or rad?"),
        (
            lambda p: record(p, rows=np.array([1000.0, 1.0])[:, None] * samples()),
            ["--ship", "box"],
            "is the time in ms?",
        ),
        (lambda p: record(p, comma=True), ["--ship", "box"], "decimal commas"),
        (lambda p: record(p, "a,b,roll_deg", ",0,"), ["--ship", "box"], "has 3 columns (a, b, roll_deg)"),
        (lambda p: record(p), ["--ship", "box", "--columns", "1"], "--columns"),
        (lambda p: record(p), ["--ship", "box", "--columns", "1,3"], "it has 2"),
        (lambda p: record(p), ["--ship", "box", "--unit", "grad"], "--unit"),
        (lambda p: record(p), ["--ship", "box", "--scale", "0"], "--scale"),
        (lambda p: record(p), ["--ship", "box", "--speed", "-3"], "from 0 m/s"),
        (lambda p: record(p, rows=samples(swings=2)), ["--ship", "box"], "three full swings"),
        (
            lambda p: record(p, rows=(GROWING, np.exp(0.02 * GROWING) * np.cos(0.5 * GROWING))),
            ["--ship", "box"],
            "the swings grow",
        ),
        (lambda p: p.write_text(""), ["--ship", "box"], "holds no samples"),
        (lambda p: p.write_bytes(b"\xff\xfe\x00"), ["--ship", "box"], "cannot be read as text"),
        (lambda p: p.with_name("other.csv").write_text("t,deg"), ["--ship", "box"], "cannot be read"),
        (lambda p: record(p), ["--ship", "box", "-o", "out.txt"], "must end in .yaml"),
        (lambda p: record(p), ["--ship", "box", "-o", "there.yaml"], "not overwritten"),
        (lambda p: record(p), ["--ship", "box", "-o", "no/out.yaml"], "no folder"),
        (lambda p: record(p), ["--ship", "box", "--picture", "out.bmp"], "must end in .png"),
    ],
)
def test_bad_input_is_one_message_and_writes_nothing(run, tmp_path, make, words, said):
    make(tmp_path / "record.csv")
    (tmp_path / "there.yaml").write_text("mine")
    before = sorted(tmp_path.iterdir())
    out = [] if "-o" in words else ["-o", "damped.yaml"]
    result = run("decay", "record.csv", *words, *out)
    assert result.exit_code == 2
    assert said in result.stderr
    assert result.stderr.count("quartering:") == 1
    assert sorted(tmp_path.iterdir()) == before
    assert (tmp_path / "there.yaml").read_text() == "mine"


def test_a_ship_of_files_is_written_beside_them_only(run, tmp_path):
    """The ship Anthineas as model-tested: particulars, offsets and decay, through the command and into a map's ship."""
    for name in ("anthineas.yaml", "anthineas_offsets.csv", "anthineas_roll_decay.csv"):
        shutil.copy(DATA / name, tmp_path / name)
    (tmp_path / "away").mkdir()
    refused = run("decay", "anthineas_roll_decay.csv", "--ship", "anthineas.yaml", "-o", "away/damped.yaml")
    assert refused.exit_code == 2
    assert "into the same folder" in refused.stderr
    result = run("decay", "anthineas_roll_decay.csv", "--ship", "anthineas.yaml", "-o", "damped.yaml")
    assert result.exit_code == 0
    assert "waves of the strips" in result.stdout
    damped = qt.ship(tmp_path / "damped.yaml")
    assert damped.hull.x.size == qt.ship(tmp_path / "anthineas.yaml").hull.x.size
    # xdyn's own analysis of the same tests: 0.034 of critical at 5 deg
    assert free_damping(damped).equivalent(np.radians(5.0)) == pytest.approx(0.034, rel=0.05)


@pytest.mark.parametrize(
    "text",
    [
        "base: box\n",
        "base: box\nloading: {gm: 1.2 m}\n",
        "base: box\nloading: {}\n",
        "base: box\nloading:\n  gm: 1.2 m # GM\n  roll_damping: 0.07 # old\n",
        "base: box\nloading:\n  roll_damping:\n    value: 0.07\n    source: guess   # mine\n  gm: 1.2 m\nname: last\n",
        "base: box\nloading:\n  roll_damping: {value: 5 %, status: assumed, source: guess}\n  gm: 1.2 m",
        'base: box\ncoefficients:\n  K_ppp: -1.0\n  "K_p|p|": -5.0e6\nprovenance: {lines: mine}\n',
        "{base: box, loading: {gm: 1.2 m}}\n",
        "base: box\nloading: &a {gm: 1.2 m}\nprovenance:\n  lines: &b mine\n  gm: *b\n",
    ],
)
def test_values_are_put_into_any_way_of_writing_a_ship_file(tmp_path, text):
    path = tmp_path / "my.yaml"
    path.write_text(text)
    values = {
        "loading": {"roll_damping": 0.031},
        "coefficients": {"K_p|p|": -1.25e6},
        "provenance": {"roll_damping": 'measured: "x", less 2'},
    }
    old, new = yaml.safe_load(text), yaml.safe_load(changed_text(str(path), values, tmp_path / "new.yaml"))
    assert new == {**old, **{group: {**(old.get(group) or {}), **own} for group, own in values.items()}}


def test_every_table_of_the_loading_says_what_there_is_in_all(run):
    """Authority: the free roll, held to its closed form in tests/hydro/test_shipdecay.py."""
    hull = " ".join(run("hull", "series60-cb60").stdout.split())
    row = hull.partition("roll damping in all, of critical │ ")[2]
    assert float(row.split()[0]) == pytest.approx(free_damping(S60).ratio, rel=1e-3)
    assert "at rest with the waves of the strips" in row
    table = " ".join(run("coefficients", "series60-cb60", "--speed", "0").stdout.split())
    assert "Added roll damping 5 % of critical; in a free roll at rest with the waves of the strips" in table
    assert f"{100 * free_damping(S60).ratio:.3g} %, at 10 deg with the drag" in table
    ahead = " ".join(run("coefficients", "series60-cb60", "--speed", "8").stdout.split())
    assert "in a free roll at 8 m/s with the waves of the strips" in ahead
    assert "and lift" in ahead


def test_a_model_record_of_a_tanker_is_read_at_full_scale(run):
    """KVLCC2 at SSPA, 1:68 (head of the file): published mean period of the swings 20.98 s, that of small ones 0.4 % longer."""
    words = ["--ship", "s175", "--scale", "68", "--json"]
    result = run("decay", DATA / "kvlcc2_roll_decay.csv", *words)
    facts = json.loads(result.stdout)
    assert facts["period"] == pytest.approx(20.98, rel=0.005)
    assert "its period is 21.1 s and that of" in result.stderr  # a record of another ship is told by its period
    assert len(facts["notes"]) == result.stderr.count("note:")
