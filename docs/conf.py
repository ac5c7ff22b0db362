"""The site: every page of docs/ as it stands in the repository, with navigation, rendered equations and the API.

``make docs`` builds it into out/site; warnings are errors. The source folder is the repository's root, so that links
between pages, to benchmarks/ and to CHANGELOG.md are the same here and in a checkout.
"""

from __future__ import annotations

import inspect
import re
from dataclasses import is_dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from docutils import nodes
from docutils.utils import new_document
from docutils.utils.math import latex2mathml

from symgen import __version__, load
from symgen.base.settings import Settings, setting_names

if TYPE_CHECKING:
    from sphinx.application import Sphinx

ROOT = Path(__file__).resolve().parents[1]

# -- navigation --------------------------------------------------------------------------------------------------------

#: The sidebar: caption -> pages, relative to the root. A page of docs/ that stands nowhere else comes last in "Guides";
#: pages in a folder with a README stand below that README.
NAVIGATION = {
    "Start": (
        "docs/tutorial",
        "docs/edit",
        "docs/tutorial-space",
        "docs/tutorials/README",
        "docs/gallery/README",
        "examples/README",
        "docs/findings/README",
        "docs/paper/README",
    ),
    "Guides": ("docs/howto/README", "docs/results", "docs/stress", "docs/sweeps"),
    "Theory": ("docs/theory/README", "docs/methods", "docs/integrators", "docs/joint-coordinates"),
    "Analyses": (
        "docs/equilibrium",
        "docs/modes",
        "docs/linearise",
        "docs/kinematics",
        "docs/inverse",
        "docs/functions",
    ),
    "Reference": (
        "docs/file-format/README",
        "docs/drawing",
        "docs/player",
        "docs/command-line",
        "docs/options",
        "docs/python",
        "docs/api",
    ),
    "Development": (
        "docs/extending",
        "docs/development/README",
        "CONTRIBUTING",
        "docs/decisions/README",
        "docs/tables/README",
        "benchmarks/README",
        "CHANGELOG",
    ),
}


def _navigation() -> dict[str, list[str]]:
    """Return the sidebar, with what stands nowhere else after the guides."""
    found = {caption: list(pages) for caption, pages in NAVIGATION.items()}
    named = {page for pages in NAVIGATION.values() for page in pages}
    own = [f"docs/{path.stem}" for path in sorted((ROOT / "docs").glob("*.md")) if path.stem != "README"]
    found["Guides"] += [page for page in own if page not in named]
    return found


def _toctree(pages: list[str], caption: str = "", glob: bool = False) -> str:
    options = [f":caption: {caption}"] if caption else []
    options += [":glob:"] if glob else []
    return "\n".join(["", ":::{toctree}", ":hidden:", *options, "", *pages, ":::", ""])


def _navigate(app: Sphinx, docname: str, content: list[str]) -> None:
    """Append the navigation to the pages that have pages below them; in a checkout they read as plain Markdown."""
    path = Path(docname)
    if docname == root_doc:
        content[0] += "".join(_toctree([f"/{p}" for p in pages], caption) for caption, pages in _navigation().items())
    elif path.name == "README":
        below = any(p.name != "README.md" for p in (ROOT / path.parent).glob("*.md"))
        folders = [f"{p.parent.name}/README" for p in sorted((ROOT / path.parent).glob("*/README.md"))]
        content[0] += _toctree([*(["[!R]*"] if below else []), *folders], glob=True)


#: Folders whose pages are found by their titles alone, so that guides come first in the search: what programs write,
#: and what is for who changes symgen.
BY_TITLE = ("docs/tables/", "docs/gallery/", "docs/decisions/", "docs/development/", "benchmarks/")


def _index_titles(app: Sphinx) -> None:
    """Leave the words of such pages out of the search; `nosearch` would leave out their titles too."""
    index = getattr(app.builder, "index_page", None)

    def index_page(name: str, doctree: nodes.document, title: str) -> None:
        if name.startswith(BY_TITLE):
            doctree = new_document("")
            doctree += nodes.section("", nodes.title("", title))
        index(name, doctree, title)

    if index is not None:
        app.builder.index_page = index_page


# -- equations ---------------------------------------------------------------------------------------------------------


#: Brackets round a matrix are drawn by the style sheet: without a font for mathematics browsers do not stretch them.
_BRACKETS = re.compile(r"<mo>\[</mo>\s*<mtable>(.*?)</mtable>\s*<mo>\]</mo>", re.DOTALL)


def _inline(translator: Any, node: nodes.math) -> None:
    translator.body.append(latex2mathml.tex2mathml(node.astext()))
    raise nodes.SkipNode


def _block(translator: Any, node: nodes.math_block) -> None:
    """Write an equation as MathML, which browsers draw themselves: no script, nothing from elsewhere."""
    inside = latex2mathml.tex2mathml(node.astext(), as_block=True)
    inside = _BRACKETS.sub(r'<mtable class="matrix">\1</mtable>', inside)
    translator.body.append(f'<div class="math">{inside}</div>\n')
    raise nodes.SkipNode


# -- the API -----------------------------------------------------------------------------------------------------------

#: The one entry that lists all settings of a run; others name theirs.
SETTINGS_AT = "symgen.Model.simulate"


def _short_signature(app: Sphinx, obj: Any, bound: bool) -> None:
    """Write settings as ``**changes``: with all their types, one signature would fill a screen."""
    shown = getattr(obj, "__signature__", None)
    own = [] if shown is None else list(shown.parameters.values())
    rest = [p for p in own if p.kind is not p.KEYWORD_ONLY or p.name not in setting_names()]
    if len(own) - len(rest) > 1:
        rest += [inspect.Parameter("changes", inspect.Parameter.VAR_KEYWORD)]
        obj.__signature__ = shown.replace(parameters=rest)


def _name_settings(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Name the settings of an entry in one sentence, and list them in one place."""
    if "**changes" not in lines or name == SETTINGS_AT:
        return
    end = begin = lines.index("**changes")
    named = re.compile(rf"({'|'.join(setting_names())}) : ")
    while begin >= 2 and named.match(lines[begin - 2]):
        begin -= 2
    if begin == end:
        return
    names = ", ".join(f"``{line.split(' : ')[0]}``" for line in lines[begin:end:2])
    lines[end + 1] = lines[end + 1].replace("as listed above", f"as for `{SETTINGS_AT}`: {names}")
    del lines[begin:end]


def _without_fields(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str | None, returned: str | None
) -> tuple[str, str | None] | None:
    """Leave out the constructors of results: their fields are listed below, and nobody calls them."""
    if what == "class" and is_dataclass(obj) and obj is not Settings and app.env.docname == "docs/api":
        return "", None
    return signature and (signature.replace("<factory>", "{}"), returned)  # what does not parse is set in one line


#: Fields that share a sentence; Sphinx would take all but the last for a type.
_SHARED = re.compile(r"(?<=^:ivar )(?:\w+, )+\w+(?=:)|(?<=^:vartype )(?:\w+, )+\w+(?=:)")


def _whole_sentences(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Give back to a first sentence what napoleon took for a type, since it stands before a colon."""
    lines[:] = [_SHARED.sub(lambda found: found.group().replace(", ", ","), line) for line in lines]
    begin = ":type: "
    if what in ("attribute", "data", "property") and lines and (last := lines[-1] or lines[-2]).startswith(begin):
        while lines.pop() != last:
            pass
        lines[0] = f"{last.removeprefix(begin)}: {lines[0]}"


def _play(app: Sphinx, error: Exception | None) -> None:
    """Write the live page that stands at the head of the site."""
    if error is None and app.builder.format == "html":
        load("four-bar").simulate().view().save(Path(app.outdir) / "four-bar.html")


def setup(app: Sphinx) -> None:
    """Connect what is written here."""
    app.connect("build-finished", _play)
    app.connect("source-read", _navigate)
    app.connect("builder-inited", _index_titles)
    app.connect("autodoc-before-process-signature", _short_signature)
    app.connect("autodoc-process-signature", _without_fields)
    app.connect("autodoc-process-docstring", _name_settings, priority=400)  # before napoleon reads it
    app.connect("autodoc-process-docstring", _whole_sentences, priority=600)
    app.add_html_math_renderer("mathml", inline_renderers=(_inline, None), block_renderers=(_block, None))


# -- Sphinx ------------------------------------------------------------------------------------------------------------

project = "symgen"
author = "The symgen developers"
project_copyright = "The symgen developers, BSD 3-Clause"
version = release = __version__

root_doc = "docs/README"
source_suffix = {".md": "markdown"}
include_patterns = ["docs/**", "benchmarks/**", "examples/README.md", "CONTRIBUTING.md", "CHANGELOG.md"]
exclude_patterns = [".*", "out", "build", "dist", "generated", "tests", "symgen", "templates", "**/__pycache__"]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_click", "sphinx_copybutton"]

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 4
myst_fence_as_directive = ["math"]

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 80
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_custom_sections = [("Class attributes", "params_style")]
default_role = "py:obj"
smartquotes = False  # an apostrophe is a derivative here
copybutton_prompt_text = "$ "

html_theme = "furo"
html_title = f"symgen {__version__}"
html_math_renderer = "mathml"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_extra_path = ["_extra"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#005a8f", "color-brand-content": "#005a8f"},
    "dark_css_variables": {"color-brand-primary": "#56B4E9", "color-brand-content": "#56B4E9"},
}
