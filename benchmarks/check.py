"""Has this library lost speed? Its ratios to the rivals beside those recorded for the same kind of processor.

    python benchmarks/check.py             # measures the rivals that need no other package, and compares
    python benchmarks/check.py --record    # writes what it measures as that of this kind of processor

A ratio below 80 % of the recorded one fails. Ratios and not times: what the machine does to one it does to the other.
They stand in `recorded_ratios.json`, by kind of processor; one that is not there has nothing to be compared with, and says so.
The median of several turns decides; the least and the most are told, as on a busy machine they scatter.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[_name] = "1"  # before anybody counts the cores

import argparse
import json
import sys
from pathlib import Path

RECORDED = Path(__file__).with_name("recorded_ratios.json")
SHARE = 0.8
"""Of a recorded ratio, below which it is lost."""
RIVALS = ("numba, every harmonic", "numba, odd harmonics", "numba, drag by strips", "numba, phasors")
"""Those that need no package beside the library's own."""


def compared(found, recorded, share=SHARE):
    """Sentences on each ratio that is recorded, and how many of them are lost.

    ``found`` and ``recorded``: ratio by "job: rival".
    """
    sentences, lost = [], 0
    for name, before in recorded.items():
        if name not in found:
            sentences.append(f"LOST {name}: not measured, recorded {before:.2f}")
            lost += 1
            continue
        kept = found[name] / before
        lost += kept < share
        word = "LOST" if kept < share else "kept"
        sentences.append(f"{word} {name}: {found[name]:.2f}, {kept:.0%} of the recorded {before:.2f}")
    return sentences, lost


def ratios_of(results):
    """Median ratios by "job: rival"."""
    return {
        f"{job}: {name}": ratio["median"]
        for job, result in results["jobs"].items()
        for name, ratio in result["ratios"].items()
        if name in RIVALS
    }


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--record", action="store_true", help="write the ratios as those of this kind of processor")
    parser.add_argument("--turns", type=int, default=7)
    parser.add_argument("--results", metavar="FILE", help="of `beside_rivals.py --json`, in place of measuring")
    options = parser.parse_args(arguments)
    if options.results:
        results = json.loads(Path(options.results).read_text())
    else:
        import beside_rivals

        results = beside_rivals.measured(turns=options.turns, others=False)
    found, kind = ratios_of(results), results["processor"]
    every = json.loads(RECORDED.read_text()) if RECORDED.exists() else {}
    print(f"{kind}; {results['load']:.1f} programs a core wanted to run")
    spoilt = [job for job, result in results["jobs"].items() if not result["accuracy_kept"]]
    if spoilt:
        print(f"not of equal accuracy: {', '.join(spoilt)}; these ratios mean nothing")
        return 1
    if options.record:
        every[kind] = {name: round(value, 2) for name, value in found.items()}
        RECORDED.write_text(json.dumps(every, indent=2, sort_keys=True) + "\n")
        print(f"recorded in {RECORDED.name}: {every[kind]}")
        return 0
    if kind not in every:
        print(f"nothing is recorded for this kind of processor in {RECORDED.name}; --record writes {found}")
        return 0
    sentences, lost = compared(found, every[kind])
    print("\n".join(sentences))
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
