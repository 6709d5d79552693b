"""How the documentation is built: `make docs`. Neither building nor reading it needs a network."""

import sys
import warnings
from importlib.metadata import version as version_of
from importlib.util import find_spec
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_extensions"))

from gallery_sources import titled_copies  # noqa: E402

project = "quartering"
author = "The quartering developers"
copyright = "the quartering developers, MIT licence"
version = release = version_of("quartering")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
    "aligned_docstrings",
    "equations",
    "generated_pages",
    "page_examples",
]
source_suffix = {".rst": "restructuredtext", ".md": "markdown"}
exclude_patterns = ["_extensions", "**/sg_execution_times.rst", "sg_execution_times.rst", "gallery/README.rst"]
default_role = "code"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings say more: shapes and units
napoleon_google_docstring = False
napoleon_use_rtype = False

warnings.filterwarnings("ignore", message=".*non-interactive.*", category=UserWarning)  # plt.show() of the examples
warnings.formatwarning = lambda message, *_: f"note: {message}\n"  # no folder of the machine in what examples print
# One example stands on three-dimensional panels: without Capytaine its script is shown and not run.
RUN = r"plot_" if find_spec("capytaine") else r"plot_(?!roll_excitation)"
sphinx_gallery_conf = {
    "examples_dirs": [titled_copies(HERE.parent)],
    "gallery_dirs": ["gallery"],
    "filename_pattern": RUN,
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "remove_config_comments": True,
    "show_memory": False,
    "show_signature": False,
    "download_all_examples": False,
    "min_reported_time": 3600,
    "plot_gallery": "True",
    "reset_modules": ("matplotlib", "gallery_sources.in_its_place"),
}

html_theme = "sphinx_book_theme"
html_title = f"quartering {version}"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["quartering.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "show_toc_level": 2,
    "home_page_in_toc": True,
    "use_download_button": False,
    "use_fullscreen_button": False,
    "show_navbar_depth": 1,
    "navbar_persistent": [],
}
html_last_updated_fmt = None
