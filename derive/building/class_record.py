"""The record of the class of a set: the seed and the students of the last run of `derive class`."""

from __future__ import annotations

import json
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from derive.building.files import write
from derive.building.set_names import set_folder
from derive.errors import Complaint, Misused, did_you_mean

RECORD = ".class.json"  # in the set's folder of outputs, so that it stays if the folders of the class are removed


@dataclass(frozen=True)
class ClassRecord:
    """The seed and the students of a class; `students` maps each code to the name of the student."""

    set_id: str
    seed: str
    students: Mapping[str, str]

    @classmethod
    def read(cls, root: Path, set_id: str) -> ClassRecord | None:
        """Return the record; None if its file is missing or not valid."""
        try:
            kept = json.loads((set_folder(root, set_id) / RECORD).read_bytes())
            students = {str(code): str(name) for code, name in kept["students"].items()}
            return cls(set_id, str(kept["seed"]), students)
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            return None

    def save(self, root: Path) -> None:
        kept = {"seed": self.seed, "students": dict(self.students)}
        write(set_folder(root, self.set_id) / RECORD, json.dumps(kept, ensure_ascii=False, indent=1) + "\n")

    def check_seed(self, seed: str | None, help_line: str) -> None:
        """Report an error if the class was made with a different seed."""
        if seed is not None and seed != self.seed:
            made = f"the seed `{self.seed}`" if self.seed else "no seed"
            message = f"the class of `{self.set_id}` was made with {made}, not with `{seed}`"
            raise Misused(Complaint("seed", message, help=help_line))

    def code_of(self, student: str) -> str | None:
        """Return the code of the student with this code or name; None if there is no such student, or if several
        students have this name."""
        wanted = _comparable(student)
        for code in self.students:
            if _comparable(code) == wanted:
                return code
        named = self.codes_with_name(student)
        return named[0] if len(named) == 1 else None

    def codes_with_name(self, student: str) -> list[str]:
        wanted = _comparable(student)
        return [code for code, name in self.students.items() if _comparable(name) == wanted]

    def unknown(self, student: str) -> Complaint:
        """Return the error about an answer whose student is not named, is not in the class, or has a name that several
        students have."""
        if not student.strip():
            message = f"the answer does not name a student of the class of `{self.set_id}`, so its variant is unknown"
            return Complaint("no-such-student", message, help="give the code of the student")
        shown = student if len(student) <= 40 else f"{student[:40]} ..."
        if several := self.codes_with_name(student):
            message = f"several students of the class of `{self.set_id}` have the name `{shown}`"
            return Complaint("no-such-student", message, help=f"give the code of the student: {', '.join(several)}")
        help_line = did_you_mean(student, [*self.students, *self.students.values()])
        return Complaint(
            "no-such-student",
            f"the class of `{self.set_id}` has no student with the code or the name `{shown}`",
            help=help_line or f"look up the code in the roster or in `build/{self.set_id}/class/answers.csv`",
        )


def _comparable(text: str) -> str:
    """Return a code or a name in a form that does not depend on case, extra spaces, or the encoding of accents."""
    return " ".join(unicodedata.normalize("NFC", text).split()).casefold()


def class_to_grade(root: Path, set_id: str, seed: str | None, students: Mapping[str, str] | None) -> ClassRecord | None:
    """Return the class whose answers are graded; None if no class has been made and no roster is given.

    seed       the stated seed, which must be the seed of the class. If there is no class and no roster, a seed is an
               error
    students   the names of the students in a roster, by their codes; None if no roster is given
    """
    made = ClassRecord.read(root, set_id)
    if made is not None:
        made.check_seed(seed, "leave out `--seed`")
        return made if students is None else ClassRecord(set_id, made.seed, students)
    if students is not None:
        return ClassRecord(set_id, seed or "", students)
    if seed is not None:
        message = f"no class of `{set_id}` has been made here, so its codes are unknown"
        raise Misused(Complaint("no-class", message, help="give the roster of the class with `--roster`"))
    return None
