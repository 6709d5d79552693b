"""What functions ask for beside a ship and its condition: one table, in the records and the words of the options.

A further argument is one line here; `quartering.hull.told` reads numbers and text by it.
"""

from __future__ import annotations

from typing import Final

from quartering.option_checks import Option

_ARGUMENTS = (
    Option("frequency", "frequency", "of motion", low=0, high=1e4, usual="0.6 rad/s", hint="fold a negative one to |omega|"),
    Option("excitation", "ratio", "share of the wave force", low=0, usual=1.0),
    Option("heel", "angle", "to starboard", low=-90, high=90, usual="40 deg", hint="less than 90 to either side"),
    Option("limit", "roll angle", "roll that counts as capsize", low=0, above=True, usual="90 deg"),
    Option("phase", "roll angle", "of a component of a sea", usual=0.0),
    Option("duration", "time", "of a motion", low=0, above=True, usual="300 s"),
    Option("step", "time", "between samples", low=0, above=True, usual="0.2 s"),
    Option("tolerance", "ratio", "relative error of one step", low=0, usual=1e-9),
    Option("sway_velocity", "speed", "at the start", usual=0.0),
    Option("roll", "roll angle", "at the start", usual="5 deg"),
    Option("roll_rate", "rate", "at the start", usual=0.0),
    Option("yaw_rate", "rate", "at the start", usual=0.0),
    Option("yaw", "roll angle", "off course, at the start", usual=0.0),
    Option("rudder_angle", "roll angle", "at the start", usual=0.0),
    Option("change", "ratio", "of one value at a time", low=0, above=True, high=1, usual=0.1, hint="less than 1"),
    Option("margin", "growth rate", "at which disturbances must die out at least", low=0, high=100, usual=0.0),
    Option("density", "density", "of the water", low=0, above=True, usual="1025 kg/m3"),
    Option("time_factor", "ratio", "on the times of a record", low=0, above=True, usual=1.0,
           hint="of a model of 1:68 sqrt(68)"),
    Option("position", "ratio", "of the crest, share of a wave length from midship, the way the wave runs", low=-1, high=1,
           usual=0.0),
    Option("hs", "length", "significant wave height of a sea", low=0, above=True, high=30, usual="6 m"),
    Option("tp", "time", "period of the peak of a sea", low=1, high=40, usual="11 s"),
    Option("tz", "time", "mean zero-crossing period of a sea", low=0.7, high=35, usual="8.5 s"),
    Option("gamma", "ratio", "peak enhancement of a spectrum", low=1, high=20, usual=3.3),
    Option("sharpness", "ratio", "lambda of a wave system of Ochi and Hubble", low=0.5, above=True, high=50, usual=1.0),
    Option("hours", "ratio", "that largest motions are of", low=0, above=True, high=1e5, usual=3.0),
    Option("failures", "ratio", "counted", low=0, high=1e12, usual=100.0),
    Option("exposure", "ratio", "hours until failure or end", low=0, above=True, high=1e12, usual=1000.0),
    Option("confidence", "ratio", "of an interval", low=0, above=True, high=0.9999, usual=0.95),
    Option("course", "angle", "of a ship, clockwise from north", low=-360, high=360, usual="45 deg"),
    Option("reference_x", "length", "of a point, forward of midship", usual="0 m"),
    Option("reference_z", "length", "of a point, below the calm plane", usual="0 m"),
)  # fmt: skip

ARGUMENTS: Final[dict[str, Option]] = {one.name: one for one in _ARGUMENTS} | {
    "signed_frequency": Option(
        "frequency", "frequency", "encounter frequency of either sign", low=-1e4, high=1e4, usual="0.6 rad/s"
    ),
    "simulated_hours": Option("hours", "ratio", "to simulate, at the least", low=0, above=True, high=1e7, usual=32.0),
    "felt_limit": Option(
        "acceleration_limit", "ratio", "lateral acceleration of a failure [m/s2]", low=0, above=True, usual=9.81
    ),
    "roll_level": Option("roll", "angle", "level that roll passes", low=0, above=True, high=90, usual="40 deg"),
    "safety_factor": Option(
        "threshold",
        "ratio",
        "factor on the mean largest motion of three hours, against the limit of a failure",
        low=1,
        high=10,
        usual=2.0,
    ),
    "rate_limit": Option(
        "threshold", "ratio", "rate of failures that is allowed [1/s]", low=0, above=True, high=1, usual=1e-6
    ),
    "precision": Option(
        "precision",
        "ratio",
        "half width of the interval of a rate over what it adds to the sum",
        low=0,
        above=True,
        high=1,
        usual=0.2,
    ),
    "left_out_share": Option(
        "share", "ratio", "of what matters, that cells left out may add up to", low=0, high=0.5, usual=0.01
    ),
    "until": Option(
        "until",
        "ratio",
        "relative standard error of roll at which a simulation stops",
        low=0,
        above=True,
        high=1,
        usual=0.01,
    ),
    "wave_frequency": Option(
        "frequency", "frequency", "of a wave, or of motion", low=0, above=True, high=1e4, usual="0.6 rad/s"
    ),
}
"""Arguments of public functions by name; some names have another range elsewhere, or are too common to be options."""
