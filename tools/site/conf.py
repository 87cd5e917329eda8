"""Sphinx's configuration; `python -m tools.site` passes it the folder of pages."""

import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

import rsoccer  # noqa: E402
from tools.site import api, docstrings  # noqa: E402  (the path is set just above)

project = "rSoccer"
author = "The rSoccer maintainers"
copyright = author
version = release = rsoccer.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3

templates_path: list[str] = []
html_theme = "furo"
html_title = f"rSoccer {release}"
html_static_path = [str(Path(__file__).parent / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b6b3a", "color-brand-content": "#0b6b3a"},
    "dark_css_variables": {"color-brand-primary": "#6fd39b", "color-brand-content": "#6fd39b"},
}
pygments_style = "default"
pygments_dark_style = "github-dark"
copybutton_exclude = ".linenos, .gp, .go"

# A name in backticks links to what is documented under it, and else is shown as code.
default_role = "py:obj"
nitpicky = True
nitpick_ignore_regex = [
    ("py:obj", ".*"),
    ("py:.*", r"(?!rsoccer\.).*"),  # other packages have sites of their own
    ("py:.*", docstrings.private()),
    ("py:class", r"rsoccer\..*\.[A-Z]"),  # type variables, which have no page
]
python_use_unqualified_type_names = True
toc_object_entries_show_parents = "hide"
maximum_signature_line_length = 88

autodoc_default_options = {
    "members": True,
    "member-order": "bysource",
    "ignore-module-all": True,  # each object stands once, in the module that defines it
    "show-inheritance": True,
}
autodoc_mock_imports = [*sorted(api.LIBRARIES.values()), "tensordict"]
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
napoleon_numpy_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False


def setup(app: object) -> None:
    """Connect what prepares docstrings and signatures."""
    docstrings.connect(app)
