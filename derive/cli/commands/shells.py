"""`derive completion`: the script by which a shell completes names and options."""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path


def completion(arguments: argparse.Namespace) -> int:
    """Print the script for a shell; the script for fish contains the path of this program if the shell does not find
    `derive`."""
    from argcomplete.shell_integration import shellcode

    own = None if arguments.shell != "fish" or shutil.which("derive") else str(Path(sys.argv[0]).absolute())
    print(shellcode(["derive"], shell=arguments.shell, argcomplete_script=own))
    return 0
