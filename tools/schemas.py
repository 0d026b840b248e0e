"""Write the JSON schemas of problem and reference files, which editors use, from the keys that the readers know."""

from pathlib import Path

from derive.course.editors import problem_schema, reference_schema

TEMPLATES = Path(__file__).parent.parent / "templates"


def main() -> None:
    (TEMPLATES / "problem.schema.json").write_text(problem_schema(), encoding="utf-8")
    (TEMPLATES / "reference.schema.json").write_text(reference_schema(), encoding="utf-8")


if __name__ == "__main__":
    main()
