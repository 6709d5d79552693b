"""What the browser tests do on a page of the explorer again and again."""

from urllib.parse import parse_qs, urlparse

import pytest

STABLE = "ship=series60-cb60&speed=7.5&heading=30&wave_length=150&wave_height=4"


def filled(page):
    """Wait until every cell of the map is known; the tab that compares has another."""
    page.wait_for_function(
        "document.querySelectorAll('.map .q-cell').length === 740 && !document.querySelector('.map .q-awaited')"
    )


def faded_in(page):
    """Wait until a dialog stands there whole: half transparent, its colours are others."""
    page.wait_for_timeout(500)  # until it has begun to
    page.wait_for_function(
        "!document.querySelector('[class*=-enter-]') && document.getAnimations().every(one => one.playState !== 'running')"
        " && [...document.querySelectorAll('.q-dialog__inner, .q-dialog__inner > *')].every("
        "one => getComputedStyle(one).opacity === '1')"
    )


def sentence(page):
    return page.inner_text(".says h1")


def link(page):
    return {key: values[0] for key, values in parse_qs(urlparse(page.url).query).items()}


def slider(key):
    """Selector of the thumb of a dial's slider, which takes the arrow keys."""
    return f"#slider-{key}[tabindex], #slider-{key} [tabindex]"


def serious(page):
    """What axe finds on a page that is serious or critical, in words."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-core comes with the extra `dev`")
    found = axe.Axe().run(page).response["violations"]
    return [
        f"{one['id']}: {one['nodes'][0]['html'][:120]}" for one in found if one["impact"] in ("serious", "critical")
    ]
