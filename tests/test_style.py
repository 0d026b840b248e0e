"""Words that our texts avoid: texts for users have none of them, and their number in the code only falls."""

from __future__ import annotations

from tests.style import PROSE, counts, files, uses

MOST_IN_CODE = 45  # terms of the field may be among them


def test_what_users_read_has_none_of_these_words() -> None:
    """The generated pages quote the code, so they are counted with it."""
    pages = [path for path in files(*PROSE) if path.name not in {"errors.md", "rules.md", "yaml.md"}]
    assert [(path.name, *use) for path in pages if path.suffix == ".md" for use in uses(path)] == []


def test_in_the_code_their_number_only_falls() -> None:
    assert sum(counts("derive").values()) <= MOST_IN_CODE
