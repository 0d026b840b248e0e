"""Write the JSON schemas with which text editors check the files that authors write."""

from pathlib import Path

from derive.course.editors import SCHEMAS

TEMPLATES = Path(__file__).parent.parent / "templates"


def main() -> None:
    for name, schema in SCHEMAS.items():
        (TEMPLATES / name).write_text(schema(), encoding="utf-8")


if __name__ == "__main__":
    main()
