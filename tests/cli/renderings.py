# SPDX-License-Identifier: GPL-3.0-or-later
"""Says whether a page looks the same in all its files.

usage: renderings.py PAGE.png FILE.pdf FILE.svg

The program's own picture of a page, what Poppler draws of the first page of the PDF, and what Inkscape draws of the
SVG, all at 150 dots an inch: of their dots less than one in a thousand differ by more than DIFFERENT in any colour. The
words of the SVG are in a font of whoever shows it, so it is compared where no word is near.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

DOTS = "150"
DIFFERENT = 96  # of 255; less is how each of the programs smooths an edge, and where in a dot it begins
MOST = 0.001
HALO_MM = 3.0  # as far as the letters of two fonts are apart


def dots(file):
    return numpy.asarray(Image.open(file).convert("RGB")).astype(int)


def drawn(svg, text, folder):
    """What Inkscape draws of an SVG."""
    source, picture = folder / f"{svg}.svg", folder / f"{svg}.png"
    source.write_text(text, encoding="utf-8")
    subprocess.run(["inkscape", source, "--export-type=png", "--export-background=white", "--export-background-opacity=1",
                    f"--export-dpi={DOTS}", f"--export-filename={picture}"], check=True, capture_output=True)
    return dots(picture)


def without_words(svg, folder):
    """An SVG without its words, and where these are not: they are drawn once more with broad strokes."""
    text = pathlib.Path(svg).read_text(encoding="utf-8")
    bare = drawn("bare", re.sub(r"<text.*?</text>", "", text, flags=re.DOTALL), folder)
    broad = drawn("broad", text.replace("<text ", f'<text style="stroke:#f0f;stroke-width:{HALO_MM}" '), folder)
    return bare, (bare == broad).all(2)


def share_that_differs(one, other, where=None):
    if max(abs(a - b) for a, b in zip(one.shape, other.shape)) > 1:
        return 1.0
    height, width = (min(a, b) for a, b in zip(one.shape[:2], other.shape[:2]))
    differs = abs(one[:height, :width] - other[:height, :width]).max(2) > DIFFERENT
    return (differs & where[:height, :width] if where is not None else differs).mean()


def main(png, pdf, svg):
    own = dots(png)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run(["pdftocairo", "-r", DOTS, "-png", "-singlefile", pdf, folder / "pdf"], check=True)
        shares = {pdf: share_that_differs(own, dots(folder / "pdf.png")),
                  svg: share_that_differs(own, *without_words(svg, folder))}
    for file, share in shares.items():
        print(f"{file}: {100 * share:.4f} % of the dots differ from {png}")
    return int(sum(share >= MOST for share in shares.values()))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
