"""In templates, unknown names are errors, and code is not run."""

from __future__ import annotations

import pytest
from jinja2 import UndefinedError
from jinja2.exceptions import SecurityError

from derive.page.template import environment


def test_names_are_filled_and_braces_are_text() -> None:
    assert environment().from_string(r"\frac{<< a >>}{{b}}<# nothing #>").render(a=1) == r"\frac{1}{{b}}"


def test_a_name_without_a_value_is_an_error() -> None:
    with pytest.raises(UndefinedError):
        environment().from_string("<< unheard_of >>").render(a=1)


@pytest.mark.parametrize("reaching", ["a.__class__.__mro__", "a.__init__.__globals__", "names.append(a)"])
def test_a_template_reads_what_it_is_given_and_changes_nothing(reaching: str) -> None:
    with pytest.raises(SecurityError):
        environment().from_string(f"<< {reaching} >>").render(a=1, names=[])
