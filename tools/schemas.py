"""Write the JSON schemas of the author's files, which text editors use, from the keys that the readers accept."""

from pathlib import Path

from derive.course.editors import SCHEMAS

TEMPLATES = Path(__file__).parent.parent / "templates"


def main() -> None:
    for name, schema in SCHEMAS.items():
        (TEMPLATES / name).write_text(schema(), encoding="utf-8")


if __name__ == "__main__":
    main()
