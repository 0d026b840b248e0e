"""Worked solutions of mechanics problems: derived, checked line by line, typeset."""

import os
import sys

# `python -m derive` without `-P` puts the working folder first on the path. A file in this folder with the name of a
# module, such as random.py, would then be imported in place of the module.
if sys.argv[:1] == ["-m"] and not sys.flags.safe_path and sys.path:
    if os.path.realpath(sys.path[0]) != os.path.dirname(os.path.dirname(os.path.realpath(__file__))):
        del sys.path[0]

# By default SymPy caches only the last 1,000 results of each of its functions; a derivation needs more. SymPy reads
# this variable at its first import.
os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")

FOLDER = os.path.dirname(__file__)  # a string, so that `derive --help` need not import pathlib
