"""Worked solutions of mechanics problems: derived, checked line by line, typeset."""

import os
from pathlib import Path

# SymPy forgets all but the last 1,000 results of each of its functions; a derivation of ours has more. It reads this
# when it is first imported.
os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")

FOLDER = Path(__file__).parent
