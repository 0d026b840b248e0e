"""A problem's script: imported as it stands, its failures told by its own lines."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from derive.algebra.kinds import ANNOTATIONS
from derive.course.script import imported_script, run
from derive.errors import Complaint, Rejected, Unverified

SCRIPT = '''\
"""A script for the tests."""

from derive.given import AngularSpeed, Mass


def solve(mass: Mass, rate: AngularSpeed):
    return mass, rate
'''


def body(*lines: str) -> str:
    return SCRIPT.replace("    return mass, rate\n", "".join(f"    {line}\n" for line in lines))


def solved(folder: Path, text: str) -> object:
    file = folder / "block.py"
    file.write_text(text, encoding="utf-8")
    return run(imported_script(file, "problems/hw9/block.py", "derive_problem_test"), {"mass": (1, 1, 2), "rate": 3})


@pytest.mark.parametrize(
    ("script", "line", "said"),
    [
        (body("return 1 / 0"), 7, "ZeroDivisionError: division by zero"),
        (body("x = 1", "return (1 +"), 8, "not Python"),
        (body("return rte"), 7, "did you mean `rate`?"),
        (body("return mass.cuont"), 7, "did you mean `count`?"),
        (body("return Angle"), 7, "write `from derive.given import Angle` above"),
        (body("raise SystemExit(0)"), 7, "it called exit"),
        (body("return solve(mass, rate)"), 7, "RecursionError"),
        (body("raise KeyboardInterrupt"), 7, "KeyboardInterrupt"),
        (body("raise GeneratorExit"), 7, "GeneratorExit"),
        (body("raise type('Own', (BaseException,), {})('mine')"), 7, "Own: mine"),
        (body("raise type('Mute', (Exception,), {'__str__': None})"), 7, "Mute: an exception that has no message"),
        ("raise KeyboardInterrupt\n\n\ndef solve(): ...\n", 1, "KeyboardInterrupt"),
        (body("é = 'é'; raise KeyError(é)"), 7, "KeyError"),
        (SCRIPT.replace("Speed, Mass", "Spede, Mass"), 3, "did you mean `AngularSpeed`?"),
        (SCRIPT.replace("def solve", "def sovle"), 6, "rename `sovle`"),
        (SCRIPT.replace("mass: Mass", "mass"), 6, "`mass` has no kind"),
        (SCRIPT.replace("mass: Mass", "mass: 'Mas'"), 6, "did you mean `Mass`?"),
        (SCRIPT.replace("mass: Mass", "*mass: Mass"), 6, "`mass` cannot be given by name"),
        (SCRIPT + "solve = None\n", 6, "not a function"),
        ("", 1, "no function `solve`"),
        ("x = '\x00'\n", 1, "not Python"),
        ("raise ValueError('at import')\n\n\ndef solve(): ...\n", 1, "ValueError: at import"),
        ("import nowhere\n\n\ndef solve(): ...\n", 1, "No module named 'nowhere'"),
    ],
)
def test_a_failing_script_is_told_by_its_own_line(script: str, line: int, said: str, tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        solved(tmp_path, script)
    (complaint,) = caught.value.complaints
    assert complaint.place is not None
    assert (complaint.code, complaint.place.path, complaint.place.line) == ("script", "problems/hw9/block.py", line)
    assert said in f"{complaint.message} {complaint.help}"
    assert str(tmp_path) not in complaint.message


def test_the_caret_is_under_what_failed_even_after_letters_of_two_bytes(tmp_path: Path) -> None:
    with pytest.raises(Rejected) as caught:
        solved(tmp_path, body("é = 'é'; return 1 / 0"))
    place = caught.value.complaints[0].place
    assert place is not None
    assert place.text[place.column - 1 :][: place.width] == "1 / 0"


REFUSING = body('raise Unverified(Complaint("routes", "they disagree"PLACE))').replace(
    "from derive.given", "from derive.errors import Complaint, Place, Unverified\nfrom derive.given"
)


def refusal(folder: Path, text: str) -> Complaint:
    with pytest.raises(Unverified) as caught:
        solved(folder, text)
    return caught.value.complaints[0]


def test_a_refusal_by_a_verb_stands_at_the_line_of_the_script(tmp_path: Path) -> None:
    place = refusal(tmp_path, REFUSING.replace("PLACE", "")).place
    assert place is not None
    assert (place.path, place.line) == ("problems/hw9/block.py", 8)


def test_a_refusal_that_has_a_place_gains_a_note_of_the_script(tmp_path: Path) -> None:
    complaint = refusal(tmp_path, REFUSING.replace("PLACE", ", Place('x.yaml', 2)"))
    assert complaint.place is not None
    assert complaint.place.path == "x.yaml"
    assert complaint.notes == ("the script calls the verb at problems/hw9/block.py:8",)


def test_what_a_script_prints_spoils_no_output(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    solved(tmp_path, body("print('aside')", "return 1").replace("def solve", "print('loading')\n\n\ndef solve"))
    printed = capsys.readouterr()
    assert (printed.out, printed.err) == ("", "loading\naside\n")


def test_a_script_says_what_it_asks_for_and_where(tmp_path: Path) -> None:
    file = tmp_path / "block.py"
    file.write_text(
        "from __future__ import annotations\n" + SCRIPT.replace("rate: AngularSpeed", "rate: AngularSpeed = 7")
    )
    script = imported_script(file, "problems/hw9/block.py", "derive_problem_test")
    assert [(p.name, p.kind, p.required) for p in script.parameters] == [
        ("mass", ANNOTATIONS["Mass"], True),
        ("rate", ANNOTATIONS["AngularSpeed"], False),
    ]
    assert script.parameters[1].note == "`solve()` asks for it at problems/hw9/block.py:7"
    assert script.returns.line == 8


def test_a_script_can_define_dataclasses(tmp_path: Path) -> None:
    point = "from dataclasses import dataclass\n\n\n@dataclass\nclass Point:\n    x: int\n\n\n"
    script = "from __future__ import annotations\n" + point + body("return Point(1).x").partition('"""\n')[2]
    assert solved(tmp_path, script) == 1
    assert "derive_problem_test" in sys.modules
