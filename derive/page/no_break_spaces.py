"""Put no-break spaces between numbers and their units in running text, and remove spaces before a percent sign."""

from __future__ import annotations

import re

from derive.units import UNIT_NAMES

NO_BREAK = "\u00a0"
_READ_AS_WORDS = ("in",)  # "2 in 3 s" is not a length in inches
_WORDS = "(?:second|minute|hour|day|year|metre|kilogram|degree|revolution|radian)s?"
_NAMES = "|".join(sorted((name for name in UNIT_NAMES if name not in _READ_AS_WORDS), key=len, reverse=True))
_UNIT = rf"(?:{_WORDS}|(?:{_NAMES})[\^0-9\u2070-\u207b\u00b2\u00b3\u00b9]*)(?![A-Za-z])"
_GAP = re.compile(rf"(?<=[0-9])\s+(?={_UNIT})")
_WITHIN = re.compile(rf"((?<![0-9])[0-9.]+{NO_BREAK}[A-Za-z]+[\^0-9]*) (?={_UNIT}(?:/|[ ,;.)]|$))")
_PERCENT = re.compile(r"(?<=[0-9])[ \n]+(?=%)")


def unbroken(text: str) -> str:
    """Return text with a no-break space between each number and its unit, and without a plain space before `%`."""
    if not any(character.isdigit() for character in text):
        return text
    return _WITHIN.sub(rf"\1{NO_BREAK}", _GAP.sub(NO_BREAK, _PERCENT.sub("", text)))
