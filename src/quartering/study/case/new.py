"""The text of a case file to begin from."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from quartering.options import choice_axes, loading_axes

# JSON schema of the case file, for editors.
SCHEMA: Final = Path(__file__).with_name("case.schema.json")


def starting_case(name: str) -> str:
    """Text of a case file to begin from, with a comment on every line.

    name: of a built-in ship, or path of a ship file
    """
    rows = (
        (f"ship: {name}", "built-in name, or path of a ship file beside this one"),
        (
            "speed: 0.15..0.25 Fn step 0.05",
            'm/s, kn, km/h or Fn; a value, a list [0, 5, 10] or a range "0..18 kn step 1"',
        ),
        ("heading: 0..180 deg step 5", "0 following, 90 beam, 180 head sea"),
        ("wave_length: 0.4..2.3 L count 20", "m or L (the ship's length), or a period: 8 s"),
        ("wave_height: [1 m, 2 m, 3 m]", "crest to trough; or steepness: [1/50, 1/30], up to 1/7"),
        ("loading:                           # every combination is computed; leave out what stays", ""),
        (
            "  gm: [0.6 m, 0.8 m, 1.0 m, 1.2 m]",
            f"or {', '.join(name for name in (*loading_axes(), *choice_axes()) if name != 'gm')}",
        ),
        ("# factors:", "on coefficients; `values:` gives them"),
        ("#   K_ppp: [0.5, 1, 2]", "half, as it is, and twice the cubic roll damping"),
        ("harmonics: 1", "of the steady motion: 1 is the paper's method; 3, 5, .. harmonic balance"),
        ("form: stf", "diffraction: stf, relative-motion, paper-corrected or paper"),
        ("modes: three", "sway, roll and yaw; six: heave and pitch too"),
        ("# sea: {hs: [4, 6], tp: 8..14 count 4}", "irregular seas, in place of wave_length and wave_height"),
        ("# with: {linear: strip}", "other options of the ship, one value each: docs/options.md"),
    )
    head = [f"# yaml-language-server: $schema={SCHEMA}", "# A study: quartering sweep <this file> -o <folder>"]
    return "\n".join([*head, *(f"{left:<35}# {note}" if note else left for left, note in rows)]) + "\n"
