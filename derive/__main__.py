"""`python -P -m derive` runs the command `derive`."""

from __future__ import annotations

import sys

from derive.cli.options import main

sys.exit(main())
