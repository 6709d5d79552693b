"""Rung by rung in irregular seas: processor time of each method, and the linear one beside waveresponse in the same run.

Series 60, CB 0.60, at rest, short-crested seas at 37 headings. waveresponse (extra `bench`) is given this library's transfer
function of roll on the same frequencies and directions, so that both sum the same numbers: it checks root mean square and mean
period. It knows no forward speed and no nonlinear term.

Usage: python benchmarks/sea.py
"""

import time
from importlib.util import find_spec

import numpy as np

import quartering as qt
from quartering.loads.sea.cells import wave_cells
from quartering.motion.sea.closure import linear_response
from quartering.motion.sea.equations import equations_of_ship, free_roll_of

SHIP, SEA = qt.ship("series60-cb60"), qt.Sea(hs=4, tp=10, spreading=10)
HEADINGS = np.linspace(0.0, 180.0, 37)


def by_waveresponse():
    """Roll RMS [deg] and mean period [s] at every heading, processor time of one, and the same by this library's cells."""
    from waveresponse import RAO, WaveSpectrum, calculate_response

    frequency, damping = free_roll_of(SHIP, 0.0)
    cells = wave_cells([SEA], 0.0, frequency, damping)
    roll = linear_response(equations_of_ship(SHIP, cells))[1].reshape(cells.sigma.size, cells.heading.size)
    both = np.concatenate([cells.heading, 360.0 - cells.heading[-2:0:-1]])
    whole = np.concatenate([roll, -roll[:, -2:0:-1]], axis=1)
    convention = {"freq_hz": False, "degrees": True, "clockwise": True, "waves_coming_from": False}
    rao = RAO(cells.sigma, both, whole, **convention)
    apart = np.radians((both + 180.0) % 360.0 - 180.0)
    spread = np.abs(np.cos(apart / 2)) ** (2 * SEA.partitions[0].spreading)
    spread /= spread.sum() * np.radians(both[1])
    low, high = SEA.partitions[0].band
    inside = (cells.sigma > low) & (cells.sigma < high)
    density = np.where(inside, SEA.density(cells.sigma), 0.0)[:, None] * spread * np.radians(1.0)
    wave = WaveSpectrum(cells.sigma, both, density, **convention)
    found, begin = [], time.process_time()
    for heading in HEADINGS:
        response = calculate_response(rao, wave, -heading, heading_degrees=True)
        found.append((np.degrees(response.std()), response.tz))
    return np.array(found).T, (time.process_time() - begin) / HEADINGS.size


def main():
    for method in ("linear", "closure"):
        qt.sea_response(SHIP, SEA, 0.0, HEADINGS[:2], method=method)
        begin = time.process_time()
        found = qt.sea_response(SHIP, SEA, 0.0, HEADINGS, method=method)
        whole = time.process_time() - begin
        seas = [qt.Sea(hs=hs, tp=10, spreading=10) for hs in np.linspace(2.0, 4.0, 5)]
        begin = time.process_time()
        qt.sea_response(SHIP, seas, 0.0, HEADINGS, method=method)
        each = (time.process_time() - begin - whole) / (4 * HEADINGS.size)
        print(
            f"{method:10s} {1e3 * each:8.2f} ms a sea and heading; forces of the speed {whole - each * HEADINGS.size:.2f} s"
        )
        if method == "linear" and find_spec("waveresponse"):
            (rms, period), taken = by_waveresponse()
            own = found["roll_rms"].values, found["roll_period"].values
            apart = [np.abs(one / other - 1).max() for one, other in zip((rms, period), own, strict=True)]
            print(
                f"waveresponse {1e3 * taken:6.2f} ms; RMS apart by {apart[0]:.1e}, mean period by {apart[1]:.1e} at most"
            )
    qt.irregular(SHIP, SEA, 0.0, 60.0)
    begin = time.process_time()
    qt.irregular(SHIP, SEA, 0.0, 60.0, hours=1000)
    print(f"simulation {time.process_time() - begin:8.2f} s for 1,000 h")
    qt.design_point(SHIP, SEA, 0.0, 20.0, 60.0, windows=1024)
    begin = time.process_time()
    qt.design_point(SHIP, SEA, 0.0, 20.0, 60.0)
    print(f"design point {time.process_time() - begin:6.2f} s with 4,096 windows")


if __name__ == "__main__":
    main()
