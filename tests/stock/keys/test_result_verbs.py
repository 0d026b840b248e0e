"""Which keys each verb of `results:` uses: the table, the verbs themselves, the check and the schema agree."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from jsonschema import Draft7Validator

from derive.course.editors import problem_schema
from derive.course.schema import keys_of
from derive.mechanics.in_results import RESULT_VERBS as VERBS
from derive.stock.keys.results import ResultKeys
from tests.stock.described import PENDULUM, complaints, edited

KEYS = [key for key in keys_of(ResultKeys) if key not in VERBS]
HOLDS = {
    "results": "kinetic_energy", "values": "{l: l}", "within": "[0, pi]", "for": "theta", "symbol": "u", "order": "1",
    "is": "'>'", "case": "overdamped", "direction": "x", "about": "tip", "origin": "tip", "root": "2",
    "through": "[l, l]",
}  # fmt: skip
SPARE = [(verb, key) for verb in VERBS for key in KEYS if key not in VERBS[verb].keys]


def result(verb: str, keys: list[str]) -> str:
    of = "[theta, theta]" if verb == "bracket" else "lagrangian"
    return f"{{{', '.join([f'{verb}: {of}', *(f'{key}: {HOLDS.get(key, 0)}' for key in keys)])}}}"


def problem(made: str) -> str:
    return edited(PENDULUM, ("  gravity: g\n", f"  gravity: g\n  results:\n    made: {made}\n"))


def needed(verb: str) -> list[str]:
    return [*VERBS[verb].needs, *VERBS[verb].one_of[:1]]


@pytest.mark.parametrize(("verb", "key"), SPARE)
def test_a_key_that_a_verb_does_not_use_is_an_error_with_its_place(verb: str, key: str, tmp_path: Path) -> None:
    text = problem(result(verb, [*needed(verb), key]))
    (complaint,) = complaints(tmp_path, text)
    assert (complaint.code, complaint.message) == ("unused-key", f"`{key}` has no effect on `{verb}`")
    line = text.splitlines()[complaint.place.line - 1]
    assert line[complaint.place.column - 1 :].startswith(f"{key}:")


@pytest.mark.parametrize(("verb", "key"), [(verb, key) for verb in VERBS for key in VERBS[verb].needs])
def test_a_key_that_a_verb_needs_is_asked_for(verb: str, key: str, tmp_path: Path) -> None:
    keys = [each for each in needed(verb) if each != key]
    (complaint,) = complaints(tmp_path, problem(result(verb, keys)))
    assert (complaint.code, complaint.message) == ("missing-key", f"`{verb}` needs `{key}`")


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ("{put_in: lagrangian}", "`put_in` needs `results` or `values`"),
        ("{solution: motion_theta, for: theta}", "`solution` needs `start` or `values`"),
        ("{where: lagrangian, for: l, bound: 1, results: kinetic_energy}", "`bound` has no effect on a `where`"),
        ("{solution: normal_modes, values: {theta: 0}, start: 0}", "`start` has no effect on a `solution`"),
    ],
)
def test_keys_that_do_not_go_together_are_an_error(made: str, said: str, tmp_path: Path) -> None:
    (complaint,) = complaints(tmp_path, problem(made))
    assert said in complaint.message


@pytest.mark.parametrize("verb", VERBS)
def test_the_schema_allows_what_the_reader_allows(verb: str) -> None:
    rules = json.loads(problem_schema())["allOf"]
    (given,) = (
        rule["then"]["properties"]["given"]
        for rule in rules
        if rule["if"]["properties"]["solve"].get("const") == "system"
    )
    validator = Draft7Validator(given["properties"]["results"]["additionalProperties"])
    holds: dict[str, object] = dict.fromkeys(KEYS, "l")
    holds |= {"within": [0, 1], "through": [0, 1], "values": {"l": "l"}, "direction": "x"}
    of = ["l", "l"] if verb == "bracket" else "lagrangian"

    def fits(keys: list[str]) -> bool:
        return bool(validator.is_valid({verb: of, **{key: holds[key] for key in keys}}))

    assert fits(needed(verb))
    assert not any(fits([*needed(verb), key]) for key in KEYS if key not in VERBS[verb].keys)
    assert not any(fits([each for each in needed(verb) if each != key]) for key in VERBS[verb].needs)
