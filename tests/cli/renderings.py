# SPDX-License-Identifier: GPL-3.0-or-later
"""Says whether a page looks the same in all its files.

usage: renderings.py PAGE.png FILE.pdf FILE.svg

The program's own picture of a page, what Poppler draws of the first page of the PDF, and what Inkscape draws of the
SVG, all at 150 dots an inch: of their dots less than one in a thousand differ by more than DIFFERENT in any colour.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

DOTS = "150"
DIFFERENT = 96  # of 255; less is how each of the programs smooths an edge, and where in a dot it begins
MOST = 0.001


def dots(file):
    return numpy.asarray(Image.open(file).convert("RGB")).astype(int)


def share_that_differs(one, other):
    if max(abs(a - b) for a, b in zip(one.shape, other.shape)) > 1:
        return 1.0
    height, width = (min(a, b) for a, b in zip(one.shape[:2], other.shape[:2]))
    return (abs(one[:height, :width] - other[:height, :width]).max(2) > DIFFERENT).mean()


def main(png, pdf, svg):
    own = dots(png)
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        of_pdf = pathlib.Path(folder) / "pdf"
        of_svg = pathlib.Path(folder) / "svg.png"
        subprocess.run(["pdftocairo", "-r", DOTS, "-png", "-singlefile", pdf, of_pdf], check=True)
        subprocess.run(["inkscape", svg, "--export-type=png", "--export-background=white",
                        "--export-background-opacity=1", f"--export-dpi={DOTS}", f"--export-filename={of_svg}"],
                       check=True, capture_output=True)
        for name, file in ((pdf, of_pdf.with_suffix(".png")), (svg, of_svg)):
            share = share_that_differs(own, dots(file))
            print(f"{name}: {100 * share:.4f} % of the dots differ from {png}")
            faults += int(share >= MOST)
    return faults


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
