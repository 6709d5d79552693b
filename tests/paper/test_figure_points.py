"""Points read from the printed figures: the format is read, what is wrong is named, and they stand where they should."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

from quartering.conventions import InputError
from quartering.study.paper.points import COLUMNS, Point, read_points
from quartering.view.plots import style
from quartering.view.plots.paper_figures import FIGURES
from quartering.view.plots.paper_points import draw_points

HEAD = "# source: made up in a test\n"
README = Path(__file__).parents[1] / "data" / "paper" / "README.md"


def folder_with(tmp_path, text, name="fig06.csv"):
    (tmp_path / name).write_text(text)
    return tmp_path


def test_points_are_read_with_their_errors(tmp_path):
    text = HEAD + "quantity,series,x,y,x_error,y_error\nroll,measured,30,4.5,1,\nroll,measured,45,9,,0.5\n"
    found = read_points(folder_with(tmp_path, text), FIGURES)
    assert found == {6: [Point("roll", "measured", 30, 4.5, 1, 0), Point("roll", "measured", 45, 9, 0, 0.5)]}


@pytest.mark.parametrize(
    ("text", "name", "said"),
    [
        ("quantity,series,x,y\nroll,a,1,2\n", "fig06.csv", "source"),
        (HEAD + "quantity,series,x\nroll,a,1\n", "fig06.csv", "y is missing"),
        (HEAD + "quantity,series,x,y,z\nroll,a,1,2,3\n", "fig06.csv", "'z' is unknown"),
        (HEAD + "quantity,series,x,y\nroll,a,1,two\n", "fig06.csv", 'line 3: y = "two"'),
        (HEAD + "quantity,series,x,y\nroll,a,1\n", "fig06.csv", "line 3: 3 cells"),
        (HEAD + "quantity,series,x,y,y_error\nroll,a,1,2,-1\n", "fig06.csv", 'y_error = "-1"'),
        (HEAD + "quantity,series,x,y\n", "fig24.csv", "no figure 24"),
        (HEAD, "other.csv", "fig06.csv"),
    ],
)
def test_what_is_wrong_in_a_file_is_named(tmp_path, text, name, said):
    with pytest.raises(InputError, match=re.escape(said)):
        read_points(folder_with(tmp_path, text, name), FIGURES)


def test_points_stand_in_the_panel_of_their_quantity():
    figure = plt.Figure()
    left, right = figure.subplots(1, 2)
    left.set_gid("k2")
    right.set_gid("growth")
    draw_points(figure, [Point("growth", "measured", 30.0, -0.02, 1.0, 0.005)], 15)
    assert not left.containers
    (bars,) = right.containers
    assert bars[0].get_xydata().tolist() == [[30.0, -0.02]]
    assert right.get_legend().get_texts()[0].get_text() == "paper: measured"
    with pytest.raises(InputError, match="it has k2, growth"):
        draw_points(figure, [Point("roll", "measured", 1, 2)], 15)
    style.title(figure, "x")


def test_the_folder_documents_the_format_and_holds_no_points():
    text = README.read_text()
    assert ",".join(COLUMNS) in text
    assert list(README.parent.glob("*.csv")) == []
