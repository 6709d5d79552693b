"""Reference numbers that several rooms are tested against, and how to read them as models."""

import csv
import json
from pathlib import Path

import numpy as np

from quartering.conventions import CUBIC_MONOMIALS
from quartering.motion.equations.model import Model
from quartering.motion.status import Status
from quartering.motion.steady.motion import Motion

HERE = Path(__file__).parent
DYNAMICS = json.loads((HERE / "dynamics.json").read_text())
COUPLED = json.loads((HERE / "coupled_system.json").read_text())
CASES = [(name, i) for name, case in DYNAMICS["cases"].items() for i in range(len(case["solutions"]))]


def model_of(case: dict) -> Model:
    """The model of one reference case."""
    given = case["input"]
    raw = given["form"] == "raw"
    terms = {}
    for k, row in enumerate("YKN"):
        terms |= {f"{row}_{s}": given["lin"][k][j] for j, s in enumerate("vpr")}
        terms |= {f"{row}_{m}": given["cub"][k][j] for j, m in enumerate(CUBIC_MONOMIALS)}
        if not raw:
            terms |= {f"{row}_phi": given["phi"][k], f"{row}_phiphiphi": given["phi3"][k]}
    if raw:
        terms |= {"K_phi": given["Kphi"], "K_phiphiphi": given["Kphi3"]}
    inertia = np.array(given["M"]) if raw else np.eye(3)
    return Model(inertia, terms, given["w"], given["ec"], given["es"], given["e0"])


def coupled_model(frequency: float) -> Model:
    """The synthetic coupled system at one frequency."""
    terms, cos, sin = {}, [], []
    for row in "YKN":
        given = dict(COUPLED["system"][row])
        cos.append(given.pop("c"))
        sin.append(given.pop("s"))
        terms |= {f"{row}_{name}": value for name, value in given.items()}
    return Model(np.eye(3), terms, frequency, cos, sin)


def motion_of(model: Model, orders: tuple[int, ...], cos: list, sin: list) -> Motion:
    """A motion given by its harmonics."""
    return Motion(
        model.frequency, orders, np.array(cos), np.array(sin), np.zeros(3), Status.CONVERGED, 0.0, "reference"
    )


def complexes(pairs: list) -> np.ndarray:
    """[[re, im], ...] as a sorted complex array."""
    array = np.array(pairs)
    return np.sort_complex(array[:, 0] + 1j * array[:, 1])


def table(name: str) -> list[dict[str, str]]:
    """Rows of a table beside this file; the lines that begin with # say where its numbers come from."""
    lines = (HERE / name).read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))
