"""The documentation's settings: MyST pages, one executed notebook, theorems and proofs. Warnings are errors (`-W`)."""

project = "canon"
author = "the canon authors"
copyright = author  # noqa: A001 - sphinx's name for it

extensions = ["myst_nb", "sphinx_proof"]
exclude_patterns = ["_build", "jupyter_execute", ".jupyter_cache", "performance/*.py", "**.ipynb_checkpoints"]
html_theme = "alabaster"
html_title = "canon"

myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True
