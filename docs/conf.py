"""The documentation's settings. Warnings are errors (`-W`), notebooks are executed, and nothing is fetched:
formulas are set by a copy of MathJax, and links into other projects' pages come from `intersphinx.toml`.
"""

import importlib.util
import os
import re
import shutil
import sys
import tomllib
import zipfile
import zlib
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(HERE.parent), os.environ.get("PYTHONPATH")]))
os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")  # else every notebook's kernel warns of frozen modules

from jupyter_client.manager import KernelManager  # noqa: E402

import canon  # noqa: E402

if hasattr(KernelManager, "transport_encryption"):  # with keys of its own a kernel has nothing to warn of
    KernelManager.transport_encryption.default_value = "auto"

project = "canon"
author = "the canon authors"
copyright = author  # noqa: A001 - sphinx's name for it
version = release = canon.__version__

extensions = [
    "myst_nb",
    "sphinx_proof",
    "sphinx.ext.autodoc",
    "sphinx.ext.intersphinx",
    "sphinx.ext.mathjax",
    "sphinx_copybutton",
]
exclude_patterns = ["_build", "jupyter_execute", ".jupyter_cache", "**/.ipynb_checkpoints"]
nitpicky = False

html_theme = "pydata_sphinx_theme"
html_title = "canon"
html_static_path = ["_static"]
html_css_files = ["canon.css"]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {
    "logo": {"text": "canon"},
    "navbar_align": "left",
    "header_links_before_dropdown": 7,
    "show_prev_next": True,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
html_sidebars = {"index": []}

myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True
nb_output_stderr = "error"  # a cell that warns fails the build
nb_number_source_lines = False

autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88

copybutton_exclude = ".linenos, .gp, .go"
copybutton_prompt_text = "$ "

mathjax_path = "mathjax/tex-chtml-full.js"
mathjax3_config = {"options": {"enableMenu": False}, "tex": {"inlineMath": [["\\(", "\\)"], ["$", "$"]]}}
MATHJAX = ("tex-chtml-full.js", "output/chtml/fonts/woff-v2")
"""What a page needs of the copy of MathJax: one program, and its fonts."""


def copy_mathjax(app, error):
    """Put MathJax beside the pages, so that formulas need no network."""
    if error is not None or app.builder.format != "html":
        return
    spec = importlib.util.find_spec("sphinx-mathjax-offline")
    assert spec is not None
    assert spec.origin is not None
    source = Path(spec.origin).parent / "static" / "mathjax"
    target = Path(app.outdir) / "_static" / "mathjax"
    for name in MATHJAX:
        copy = shutil.copytree if (source / name).is_dir() else shutil.copy
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        copy(source / name, target / name, **({"dirs_exist_ok": True} if copy is shutil.copytree else {}))


def inventories(folder):
    """Write an inventory for each project of `intersphinx.toml`; return what `intersphinx_mapping` says of them."""
    folder.mkdir(parents=True, exist_ok=True)
    mapping = {}
    for name, told in tomllib.loads((HERE / "intersphinx.toml").read_text(encoding="utf-8")).items():
        head = f"# Sphinx inventory version 2\n# Project: {name}\n# Version: \n"
        head += "# The remainder of this file is compressed using zlib.\n"
        lines = [
            f"{object} py:{role} 1 {page} -\n"
            for role, pages in told["names"].items()
            for object, page in pages.items()
        ]
        (folder / f"{name}.inv").write_bytes(head.encode() + zlib.compress("".join(lines).encode()))
        mapping[name] = (told["url"], str(folder / f"{name}.inv"))
    return mapping


intersphinx_mapping = inventories(HERE.parent / "build" / "inventories")


def small_checkers(path):
    """Write an archive of the small checkers with their tables, to be downloaded as one."""
    folder = HERE.parent / "canon" / "checker"
    names = ("alone*", "counterexample*", "refutations.py", "lie_invariants.py")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(file for name in names for file in folder.glob(name) if file.is_file()):
            archive.writestr(zipfile.ZipInfo(f"small-checkers/{file.name}", (1980, 1, 1, 0, 0, 0)), file.read_bytes())


small_checkers(HERE.parent / "build" / "small-checkers.zip")

INLINE = re.compile(r"(``.+?``|`[^`]+`|\*\*[\w ,]+:?\*\*)")


def restructured(app, what, name, obj, options, lines):
    """A docstring's Markdown as reStructuredText: code is marked, and nothing else is markup by accident."""
    text = "\n".join(lines)
    parts = INLINE.split(text)
    for k, part in enumerate(parts):
        if k % 2 == 0:
            parts[k] = re.sub(r"([*|]|(?<=\w)_(?=\W|$)|\\)", r"\\\1", part)
        elif part.startswith("`") and not part.startswith("``"):
            parts[k] = f"``{part.strip('`')}``"
    lines[:] = "".join(parts).split("\n")


def setup(app):
    """What Sphinx calls."""
    app.connect("autodoc-process-docstring", restructured)
    app.connect("build-finished", copy_mathjax)
