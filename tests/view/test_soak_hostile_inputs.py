"""Fifteen hundred inputs broken on purpose, at every door: each is read, told or refused, in bounded time and memory.

Authority: by definition; where a change has a known right answer (a barge of closed form, a database made from strips), an
answer that is neither right nor told is a fault.
"""

import json
import subprocess
import sys
from collections import Counter

import pytest

from tests.view.hostile_inputs import KINDS, MEANING

pytestmark = [
    pytest.mark.soak,
    pytest.mark.skipif(sys.platform == "win32", reason="processor time is limited by a signal"),
]

RUNS, EACH = 5, 300
MEMORY = 2048
"""Memory a process may take [MB]."""


@pytest.mark.parametrize("run", range(RUNS))
def test_nothing_is_a_traceback_hangs_or_passes_in_silence(run):
    command = [sys.executable, "-m", "tests.view.hostile_inputs", str(run * EACH), str(EACH)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    found = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(found) == EACH
    faults = [f"{number} {kind} {outcome}: {fault}" for number, kind, outcome, fault, _ in found if fault]
    assert not faults, "\n".join(faults)
    assert max(most for *_, most in found) < MEMORY
    passed = Counter(kind for _, kind, outcome, *_ in found if outcome in ("answered", "told"))
    unread = {kind.__name__ for kind in KINDS if kind not in MEANING} - passed.keys()
    assert not unread, f"all noise refused: {unread}"
