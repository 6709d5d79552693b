"""Put a report together and write it as one HTML page, or as PDF."""

from __future__ import annotations

from collections import Counter
from datetime import date
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from jinja2 import DictLoader, Environment, StrictUndefined

from quartering.conventions import InputError
from quartering.hull.righting.arm import fitted_to
from quartering.hydro.capsize import capsize_limit
from quartering.motion.status import Status
from quartering.motion.steady.motion import capsize_advice
from quartering.references import cite
from quartering.stability.kind import Kind
from quartering.view.report.client import first_page
from quartering.view.report.conditions import judged, sensitivities, worst_conditions
from quartering.view.report.failure_modes import criteria_section
from quartering.view.report.guidance import guidance
from quartering.view.report.pictures import hull_svg, map_svgs
from quartering.view.report.source import Source, axes_of
from quartering.view.report.tables import coefficients_table, hydrostatics_table, loading_table, provenance_table
from quartering.view.wording import estimated_words, estimates_of, speed_words


def report_page(source: Source, service_speed: float | None = None) -> str:
    """The report as HTML: ship, coefficients, maps, verdicts, sensitivities, sources.

    service_speed: with one the five failure modes are judged too [m/s]
    Returns a whole page, pictures inside it; every text that comes from a file is escaped
    """
    ship, result = source.ship, source.result
    by_roll, by_margin = worst_conditions(source, "roll"), worst_conditions(source, "margin")
    middle = float(result["speed"].values[result["speed"].size // 2])
    coefficients, frequency = coefficients_table(ship, middle)
    return _render(
        "report.html",
        source,
        title=f"{ship.name}: motion and stability in regular oblique waves",
        hydrostatics=hydrostatics_table(ship),
        loading=loading_table(ship),
        provenance=provenance_table(ship),
        coefficients=coefficients,
        coefficients_at=f"{speed_words(middle, ship.hull.length)}, encounter frequency {frequency:.3g} rad/s",
        hull=hull_svg(ship),
        maps=map_svgs(result),
        by_roll=by_roll,
        by_margin=by_margin,
        short=first_page(source, by_roll[0]),
        largest=f"Largest roll of all: {by_roll[0].roll_peak:.3g} deg over a cycle",
        judged=[judged(source, "Least stable motion of all", by_margin[0])],
        sensitivities=sensitivities(source, by_margin[0] if by_margin[0].exponent > 0 else by_roll[0]),
        counts=_counts(source),
        criteria=None if service_speed is None else criteria_section(ship, service_speed),
    )


def guidance_page(source: Source, openings: float | None) -> str:
    """Polar diagrams of speed and heading for every wave height and length, in the form of operational guidance.

    openings: heel at which unprotected openings go under in calm water [deg]
    Returns a whole page, pictures inside it
    """
    return _render(
        "guidance.html",
        source,
        title=f"{source.ship.name}: polar diagrams of roll in regular oblique waves",
        loading=loading_table(source.ship),
        **guidance(source, openings)._asdict(),
    )


def write_pdf(page: str, path: Path) -> None:
    """Write a page as PDF on A4.

    page: HTML
    """
    try:
        from weasyprint import CSS, HTML
        from weasyprint.text.fonts import FontConfiguration
    except (ImportError, OSError) as error:
        raise InputError(
            f"a PDF needs WeasyPrint, which cannot be loaded ({error}); pip install 'quartering[pdf]', "
            "or write .html and print it from a browser"
        ) from None
    fonts = FontConfiguration()  # of the pictures: where it is not installed, it comes with Matplotlib
    letters = CSS(string=_letters(), font_config=fonts)
    HTML(string=page).write_pdf(path, stylesheets=[letters], font_config=fonts)


def _letters() -> str:
    """The font of the pictures, as a style sheet."""
    from matplotlib import get_data_path

    place = Path(get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return f"@font-face {{ font-family: 'DejaVu Sans'; src: url('{place.as_uri()}') }}"


def _render(template: str, source: Source, **content: Any) -> str:
    """Fill a template of the folder ``templates`` with what every page says beside its own content."""
    hull = source.ship.hull
    sizes = {"ship_length": hull.length, "ship_beam": hull.beam, "ship_draught": hull.draught}
    attributes = source.result.attrs
    return filled(
        template,
        ship=source.ship,
        attributes=attributes | sizes,
        estimated=estimated_words(estimates_of(attributes), source.ship.provenance),
        warnings=_warnings(source),
        origin=source.origin,
        digest=source.digest,
        axes=_axes_words(source),
        case=axes_of(source.result),
        citation=cite(source.result).splitlines(),
        **content,
    )


def filled(template: str, **content: Any) -> str:
    """A template of the folder ``templates`` filled, with today's date and the version."""
    folder = files("quartering.view.report") / "templates"
    names = ("report.html", "guidance.html", "seas.html", "page.html", "style.css")
    environment = Environment(
        loader=DictLoader({name: (folder / name).read_text(encoding="utf-8") for name in names}),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(
        version=version("quartering"), today=date.today().isoformat(), **content
    )  # fmt: skip


def _counts(source: Source) -> list[tuple[str, int, str]]:
    """How many conditions have which verdict, and what it means."""
    kinds = Counter(int(k) for k in source.result["verdict"].values.ravel())
    return [(Kind(k).label, n, Kind(k).meaning) for k, n in sorted(kinds.items(), key=lambda pair: -pair[1])]


def _warnings(source: Source) -> list[str]:
    """What is outside the range of the method, and what has no answer."""
    result, made = source.result, []
    fitted = fitted_to(source.ship)
    beyond = int((np.nan_to_num(result["roll_peak"].values) > fitted).sum())
    if beyond:
        made.append(
            f"{beyond} of {result['verdict'].size} conditions roll beyond {fitted:g} deg, where the fit of the righting arm"
            " ends: their size and verdict are extrapolated."
        )
    statuses = Counter(int(s) for s in result["status"].values.ravel())
    limited = capsize_advice(capsize_limit(source.ship))
    for s, n in statuses.items():
        if not Status(s).ok:
            advice = limited if Status(s) is Status.BEYOND_CAPSIZE_LIMIT else Status(s).advice
            made.append(f"{n} conditions without an answer: {advice}.")
    return made


def _axes_words(source: Source) -> list[str]:
    """Each axis of the result: how many values, from where to where."""
    units = {"speed": "m/s", "heading": "deg", "wave_length": "m", "wave_height": "m"}
    words = []
    for name, unit in units.items():
        values = np.unique(source.result[name].values)
        span = f"{values[0]:.4g}" if values.size == 1 else f"{values[0]:.4g} to {values[-1]:.4g}, {values.size} values"
        words.append(f"{name.replace('_', ' ')} {span} [{unit}]")
    if "loading" in source.result.dims:
        words.append(f"{source.result.sizes['loading']} loadings")
    return words
