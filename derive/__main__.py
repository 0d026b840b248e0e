"""`python -P -m derive` is the command `derive`."""

from __future__ import annotations

import sys

from derive.cli.options import main

sys.exit(main())
