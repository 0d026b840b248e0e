"""`figure:` of a problem: which files are accepted, and what an SVG may have."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest

from derive.building.own_figures import INSTALL
from derive.building.solution import rendered
from derive.course.own_figure import LARGEST, OwnFigure, shapes_of
from derive.course.problem import load_problem
from derive.errors import Complaint, Misused, Rejected
from tests.course.test_variants import BEAD

SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
SVG = f'<svg {SPACES} width="80" height="40">{{}}</svg>'
SHAPES = SVG.format('<rect width="80" height="40" fill="#c33"/><use href="#a"/>')
PNG = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", 40, 20)


def course(root: Path, figure: str, **files: bytes | str) -> Path:
    """Write a course whose problem has this figure; `cart_svg` is the content of `cart.svg`."""
    folder = root / "problems" / "week1"
    folder.mkdir(parents=True)
    (folder / "set.yaml").write_text("course: A\ntitle: B\nproblems: [bead]\n")
    (folder / "bead.yaml").write_text(BEAD.replace("VARIANTS", f"figure: {figure}"))
    for name, content in files.items():
        data = content.encode() if isinstance(content, str) else content
        (folder / name.replace("_", ".")).write_bytes(data)
    return root


def figure(root: Path, written: str, **files: bytes | str) -> OwnFigure:
    found = load_problem(course(root, written, **files), "week1/bead").figure
    assert found is not None
    return found


def error(root: Path, written: str, **files: bytes | str) -> Complaint:
    with pytest.raises(Rejected) as caught:
        figure(root, written, **files)
    (complaint,) = caught.value.complaints
    assert complaint.place and complaint.place.line == 5
    return complaint


@pytest.mark.parametrize(("name", "content"), [("cart.svg", SHAPES), ("cart.png", PNG), ("cart.PDF", b"%PDF-1.5\n")])
def test_a_figure_is_a_file_next_to_the_problem(tmp_path: Path, name: str, content: str | bytes) -> None:
    found = figure(tmp_path, f"{{file: {name}, alt: A cart, width: 4 cm}}", **{name.replace(".", "_"): content})
    assert (found.path, found.key, found.width) == (f"problems/week1/{name}", "cart", 4.0)


@pytest.mark.parametrize(
    ("written", "files", "message"),
    [
        ("{file: none.png, alt: A}", {}, "there is no file `problems/week1/none.png`"),
        ("{file: cart.gif, alt: A}", {"cart_gif": b""}, "is not a PDF, SVG or PNG file"),
        ("{file: cart.png, alt: A}", {"cart_png": SHAPES}, "is not a PNG file"),
        ("{file: cart.pdf, alt: A}", {"cart_pdf": PNG}, "is not a PDF file"),
        ("{file: cart.svg, alt: A}", {"cart_svg": PNG}, "is not an SVG file"),
        ("{file: cart.svg, alt: A}", {"cart_svg": "<html/>"}, "is not an SVG file"),
        ("{file: cart.svg, alt: A}", {"cart_svg": b" " * (LARGEST + 1)}, "is larger than 2 MB"),
        ("{file: big.png, alt: A}", {"big_png": PNG[:16] + b"\0\0\xff\xff" * 2}, "more than 16 million pixels"),
        ("{file: cart.svg}", {"cart_svg": SHAPES}, "needs `alt`"),
        ("{file: cart.svg, alt: ''}", {"cart_svg": SHAPES}, "must be text"),
        ("{file: ../../../x.png, alt: A}", {}, "is outside of the course"),
        ("{file: /etc/passwd.png, alt: A}", {}, "is outside of the course"),
        ("{file: system.svg, alt: A}\ndrawings: {system: {at: a}}", {"system_svg": SHAPES}, "has the name of one of"),
        ("{file: cart.svg, alt: A, width: 40 cm}", {"cart_svg": SHAPES}, "must be from 1 to 15 cm"),
    ],
)
def test_any_other_file_is_an_error_with_its_line(
    tmp_path: Path, written: str, files: dict[str, bytes | str], message: str
) -> None:
    assert message in error(tmp_path, written, **files).message


def test_a_missing_file_is_one_error_although_prose_mentions_the_figure(tmp_path: Path) -> None:
    root = course(tmp_path, "{file: cart.svg, alt: A, caption: B}\nnote: See <<figure cart>>.")
    with pytest.raises(Rejected) as caught:
        rendered(root, "week1/bead", only=("text",))
    assert [each.code for each in caught.value.complaints] == ["figure"]


def test_a_link_does_not_lead_out_of_the_course(tmp_path: Path) -> None:
    (tmp_path / "secret.png").write_bytes(PNG)
    root = course(tmp_path / "course", "{file: cart.png, alt: A}")
    (root / "problems" / "week1" / "cart.png").symlink_to(tmp_path / "secret.png")
    with pytest.raises(Rejected, match="outside of the course"):
        load_problem(root, "week1/bead")


@pytest.mark.parametrize(
    "inside",
    [
        "<script>alert(1)</script>",
        '<rect onclick="alert(1)"/>',
        '<foreignObject><p xmlns="http://www.w3.org/1999/xhtml">x</p></foreignObject>',
        '<h:iframe xmlns:h="http://www.w3.org/1999/xhtml" src="https://example.org"/>',
        '<image href="https://example.org/a.png"/>',
        '<image xlink:href="file:///etc/passwd"/>',
        '<use href="other.svg#a"/>',
        '<image href="data:image/svg+xml;base64,AAAA"/>',
        '<a href="javascript:alert(1)"><rect/></a>',
        '<set attributeName="href" to="https://example.org"/>',
        "<style>@import 'https://example.org/a.css';</style>",
        "<style>rect { fill: url(https://example.org/a) }</style>",
        '<rect style="fill: u\\72l(https://example.org/a)"/>',
        "<rect fill=\"url('https://example.org/a#b')\"/>",
    ],
)
def test_an_svg_has_no_script_and_no_reference_to_another_file(inside: str) -> None:
    assert shapes_of(SVG.format(f"<g>{inside}</g>").encode())[1]


def test_an_svg_keeps_its_shapes_and_loses_the_data_of_editors() -> None:
    inside = (
        '<metadata>secret</metadata><sodipodi:namedview xmlns:sodipodi="http://s" href="https://example.org"/>'
        '<linearGradient id="a"/><rect fill="url(#a)" i:label="secret" xmlns:i="http://i"/><text>cart</text>'
    )
    head = '<?xml version="1.0"?><?xml-stylesheet href="https://example.org"?>'
    doctype = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    shapes, wrong = shapes_of(f"{head}{doctype}<!-- secret -->{SVG.format(inside)}".encode())
    assert wrong == ""
    text = shapes.decode()
    assert "secret" not in text and "example.org" not in text and "w3.org/Graphics" not in text
    assert "<text>cart</text>" in text and 'fill="url(#a)"' in text
    entities = '<!DOCTYPE svg [<!ENTITY a "aaaa">]>' + SVG.format("&a;")
    assert shapes_of(entities.encode())[1] == "defines entities"


def test_the_page_shows_the_figure_before_the_drawings(tmp_path: Path) -> None:
    written = "{file: cart.svg, alt: A cart of mass <<m>>, caption: The cart.}"
    root = course(tmp_path, written, cart_svg=SHAPES)
    page = rendered(root, "week1/bead", only=("text", "markdown", "html", "latex", "notebook", "fragment"))
    assert "[figure: A cart of mass m]\nFigure 1. The cart." in page.texts["text"]
    assert "![A cart of mass m](bead-cart.svg)" in page.texts["markdown"]
    assert "problems/week1/cart.svg" in page.inputs
    assert (
        r"bead-cart.pdf" in page.latex and r"bead-cart.pdf" in page.sheet and "bead-cart.pdf" in page.texts["fragment"]
    )
    assert 'problem.drawing(\\"cart\\")' in page.texts["notebook"]


def test_without_the_converter_the_error_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "typst", None)
    with pytest.raises(Misused) as caught:
        rendered(course(tmp_path, "{file: cart.svg, alt: A}", cart_svg=SHAPES), "week1/bead", draws=True)
    assert caught.value.complaints[0].help == INSTALL and caught.value.complaints[0].place


@pytest.mark.parametrize("kind", ["svg", "png"])
def test_the_files_of_a_figure_are_a_pdf_and_an_svg_of_its_size(tmp_path: Path, kind: str) -> None:
    pytest.importorskip("typst")
    from io import BytesIO

    from PIL import Image
    from pypdf import PdfReader
    from resvg_py import svg_to_bytes

    image = BytesIO()
    Image.new("RGB", (60, 30), (204, 51, 51)).save(image, "PNG", dpi=(72, 72))
    content = {"cart_svg": SHAPES, "cart_png": image.getvalue()}[f"cart_{kind}"]
    root = course(tmp_path, f"{{file: cart.{kind}, alt: A <cart>}}", **{f"cart_{kind}": content})
    files = dict(rendered(root, "week1/bead", draws=True, only=()).files)
    box = PdfReader(BytesIO(files["bead-cart.pdf"])).pages[0].mediabox
    assert (float(box.width), float(box.height)) == pytest.approx((60, 30), abs=0.1)
    svg = files["bead-cart.svg"].decode()
    assert svg.startswith('<svg role="img" ') and "<title>A &lt;cart&gt;</title>" in svg
    shown = Image.open(BytesIO(bytes(svg_to_bytes(svg_string=svg, dpi=96)))).convert("RGB")
    assert shown.getpixel((shown.width // 2, shown.height // 2)) == (204, 51, 51)
    assert files == dict(rendered(root, "week1/bead", draws=True, only=()).files), "equal input gives equal bytes"
