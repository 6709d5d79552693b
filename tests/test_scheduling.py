"""The order in which files are begun names files that are there, and is the order in which they are dealt out."""

from collections import OrderedDict
from pathlib import Path
from types import SimpleNamespace

import pytest

pytest.importorskip("xdist", reason="how tests are dealt out to several processes is that of pytest-xdist")

from tests.scheduling import EXPLORER, LONGEST_FIRST, LongestFirst

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("name", [name for name in LONGEST_FIRST if name != EXPLORER])
def test_what_is_begun_first_is_there(name):
    file, _, rest = name.partition("::")
    assert (ROOT / file).exists()
    if rest:
        test, page = rest.removesuffix("]").split("[")
        assert f"def {test}(" in (ROOT / file).read_text()
        assert (ROOT / "docs" / page).exists()


def test_named_files_come_first_then_the_one_of_most_tests():
    given = []
    dealt = SimpleNamespace(
        workqueue=OrderedDict(
            (name, dict.fromkeys(range(count), False))
            for name, count in (("few.py", 1), ("many.py", 9), (LONGEST_FIRST[3], 1), (EXPLORER, 2))
        )
    )
    dealt._turn = lambda name: LongestFirst._turn(dealt, name)
    while dealt.workqueue:
        given.append(min(dealt.workqueue, key=dealt._turn))
        del dealt.workqueue[given[-1]]
    assert given == [EXPLORER, LONGEST_FIRST[3], "many.py", "few.py"]
