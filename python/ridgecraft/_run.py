# SPDX-License-Identifier: GPL-3.0-or-later
"""unfold() and run(): made from base/option_table.cpp by tests/cli/generated_files_test.cpp."""

from __future__ import annotations

from typing import Any, Callable, Literal, Optional, Sequence, Union

import numpy.typing as npt

from . import _core
from ._core import Nets, Paper

Progress = Callable[[str, float], Any]


def unfold(
    vertices: npt.ArrayLike,
    faces: Any,
    *,
    size: Optional[Union[float, str]] = None,
    height: Optional[Union[float, str]] = None,
    width: Optional[Union[float, str]] = None,
    depth: Optional[Union[float, str]] = None,
    up: Optional[Literal["x", "y", "z"]] = None,
    scale: Optional[Union[float, str]] = None,
    unit: Optional[str] = None,
    simplify: Optional[Union[int, str]] = None,
    hours: Optional[Union[float, str]] = None,
    tabs: Optional[Union[bool, Literal["auto", "one-side", "alternate", "both", "slots", "none"]]] = None,
    tab_height: Optional[Union[float, str]] = None,
    tab_angle: Optional[Union[float, str]] = None,
    border_tabs: Optional[bool] = None,
    all_tabs: Optional[bool] = None,
    keep_bodies: Optional[bool] = None,
    skins: Optional[Literal["outer", "middle", "both"]] = None,
    concavity: Optional[Union[float, str]] = None,
    fold_linear: Optional[bool] = None,
    unite: Optional[bool] = None,
    whole: bool = False,
    title: str = "model",
    threads: int = 0,
    seed: int = 1,
    time_limit: Optional[float] = None,
    progress: Optional[Progress] = None,
) -> Nets:
    """Unfolds a model into nets without overlap, without pages: pieces may be as large as they like.

    Bodies stay as they are, faces are kept and there are no tabs, unless asked for. Lengths are mm.

    size: Largest extent of the finished model: 150mm, 20cm, 8in; a number alone means mm (150mm, or what its folds and
        pages need between 100mm and 400mm).
    height: Instead of size: from the foot of the finished model to its top, as its guide shows it.
    width: The same from its left to its right.
    depth: The same from its back to its front.
    up: The axis of the file that points up, where the guide has the model lie (as the file says, or else as it stands
        best).
    scale: Instead of size: 1:50, 0.5 or 30% of the size that the file's numbers give in unit.
    unit: Unit of the file's numbers: mm, cm, m, in, ft (what the file says, else mm); used with scale.
    simplify: How many faces to keep: auto simplifies a model whose edges would be too short to fold, keep never does, a
        number simplifies to that many (auto).
    hours: How long building it may take: with simplify auto a model that takes longer, or has too many short edges, is
        simplified; by default one with long edges is left as it is up to 10 hours (4).
    tabs: Which side of a cut gets the glue tab: that with more room behind it; along a seam of two pieces always the
        same piece, or one after the other, as far as there is room; both, to be glued to each other; arrows that go
        into slits of the neighbour, without glue, where there is room for them; neither (auto).
    tab_height: Height of the glue tabs (5mm); also by length of edge: 4mm,20mm:5mm,60mm:8mm is 4 mm, from 20 mm on 5,
        from 60 mm on 8.
    tab_angle: Side angle of the glue tabs, 90 for rectangles; steeper where an edge is short (45). By length of edge in
        the same way: 60,20mm:45.
    border_tabs: Tabs also at borders of open models, which are glued to nothing of the model.
    all_tabs: Split pieces further until every edge with a face wide enough behind it has a glue tab.
    keep_bodies: Leave bodies that touch or run into each other as they are, hidden faces and all; without it they
        become one outer skin.
    skins: Walls thinner than 3 mm become a sheet: their outer skin, or one in the middle of the wall; both leaves
        inside and outside (outer).
    concavity: How far a part may be from convex, as a share of the radius of the model's bounding sphere (0.1).
    fold_linear: For sheets that fold themselves: every piece folds up with all creases moving together and no face
        running through another; pieces are split where no net does.
    unite: the contrary of keep_bodies.
    whole: don't cut the model into parts first, and cut a flat region before a piece is added.
    title: what pages and files call the model.
    time_limit: seconds after which searches end with the best they have. Raises OutOfTime where there is nothing yet.

    The result has passed its check: lengths, overlaps, coverage, joins and refolding.
    """
    options = {
        "size": size,
        "height": height,
        "width": width,
        "depth": depth,
        "up": up,
        "scale": scale,
        "unit": unit,
        "simplify": simplify,
        "hours": hours,
        "tabs": tabs,
        "tab_height": tab_height,
        "tab_angle": tab_angle,
        "border_tabs": border_tabs,
        "all_tabs": all_tabs,
        "keep_bodies": keep_bodies,
        "skins": skins,
        "concavity": concavity,
        "fold_linear": fold_linear,
    }
    if unite is not None:
        options["keep_bodies"] = not unite
    return _core.unfold(vertices, faces, options, (whole, title), (threads, seed, time_limit, progress))


def run(
    vertices: npt.ArrayLike,
    faces: Any,
    *,
    size: Optional[Union[float, str]] = None,
    height: Optional[Union[float, str]] = None,
    width: Optional[Union[float, str]] = None,
    depth: Optional[Union[float, str]] = None,
    up: Optional[Literal["x", "y", "z"]] = None,
    scale: Optional[Union[float, str]] = None,
    unit: Optional[str] = None,
    simplify: Optional[Union[int, str]] = None,
    hours: Optional[Union[float, str]] = None,
    strict: Optional[bool] = None,
    sheet: Optional[str] = None,
    margin: Optional[Union[float, str]] = None,
    pack: Optional[Literal["fast", "good"]] = None,
    grain: Optional[Literal["any", "long", "short"]] = None,
    tabs: Optional[Union[bool, Literal["auto", "one-side", "alternate", "both", "slots", "none"]]] = None,
    tab_height: Optional[Union[float, str]] = None,
    tab_angle: Optional[Union[float, str]] = None,
    border_tabs: Optional[bool] = None,
    tab_shadow: Optional[bool] = None,
    all_tabs: Optional[bool] = None,
    hide_folds: Optional[Union[float, str]] = None,
    numbers: Optional[Literal["inside", "tabs", "outside", "back"]] = None,
    duplex: Optional[Literal["long", "short"]] = None,
    ink: Optional[Literal["colour", "pale", "lines"]] = None,
    details: Optional[Literal["auto", "lines", "shade", "none"]] = None,
    dpi: Optional[Union[float, str]] = None,
    keep_bodies: Optional[bool] = None,
    skins: Optional[Literal["outer", "middle", "both"]] = None,
    concavity: Optional[Union[float, str]] = None,
    pieces: Optional[Literal["few", "parts", "small"]] = None,
    rolled: Optional[Literal["auto", "never", "always"]] = None,
    max_faces: Optional[Union[int, str]] = None,
    weigh: Optional[Sequence[str]] = None,
    fold_linear: Optional[bool] = None,
    unite: Optional[bool] = None,
    whole: bool = False,
    title: str = "model",
    threads: int = 0,
    seed: int = 1,
    time_limit: Optional[float] = None,
    progress: Optional[Progress] = None,
) -> Paper:
    """Turns a model into pages of paper, as the program does. Lengths are mm, angles degrees.

    size: Largest extent of the finished model: 150mm, 20cm, 8in; a number alone means mm (150mm, or what its folds and
        pages need between 100mm and 400mm).
    height: Instead of size: from the foot of the finished model to its top, as its guide shows it.
    width: The same from its left to its right.
    depth: The same from its back to its front.
    up: The axis of the file that points up, where the guide has the model lie (as the file says, or else as it stands
        best).
    scale: Instead of size: 1:50, 0.5 or 30% of the size that the file's numbers give in unit.
    unit: Unit of the file's numbers: mm, cm, m, in, ft (what the file says, else mm); used with scale.
    simplify: How many faces to keep: auto simplifies a model whose edges would be too short to fold, keep never does, a
        number simplifies to that many (auto).
    hours: How long building it may take: with simplify auto a model that takes longer, or has too many short edges, is
        simplified; by default one with long edges is left as it is up to 10 hours (4).
    strict: Write nothing, with exit code 9, where the model can't be folded by hand at this size.
    sheet: A0 to A7, B0 to B6, letter, legal, tabloid and others, -landscape added to turn it, or a size such as
        300x200mm (A4).
    margin: What the printer can't reach, on all four sides (10mm).
    pack: How long a search for fewer sheets takes: hundredths of a second, or tenths (fast).
    grain: Lay pieces so that most of their folds run along the sheet's long or short side, as the paper's grain does:
        folds across it crack. Takes more sheets at times (any).
    tabs: Which side of a cut gets the glue tab: that with more room behind it; along a seam of two pieces always the
        same piece, or one after the other, as far as there is room; both, to be glued to each other; arrows that go
        into slits of the neighbour, without glue, where there is room for them; neither (auto).
    tab_height: Height of the glue tabs (5mm); also by length of edge: 4mm,20mm:5mm,60mm:8mm is 4 mm, from 20 mm on 5,
        from 60 mm on 8.
    tab_angle: Side angle of the glue tabs, 90 for rectangles; steeper where an edge is short (45). By length of edge in
        the same way: 60,20mm:45.
    border_tabs: Tabs also at borders of open models, which are glued to nothing of the model.
    tab_shadow: Thin lines on the faces behind which tabs come to lie.
    all_tabs: Split pieces further until every edge with a face wide enough behind it has a glue tab.
    hide_folds: Draw no line where the surface is folded by less than this (3).
    numbers: Where the numbers of edges stand: on the pieces and their tabs; on tabs, and next to the piece at edges
        without one; next to the pieces; on the back of the paper, which the PDF gets pages for (inside).
    duplex: With numbers back: over which edge the printer turns the sheets (long).
    ink: Print the model's colours and pictures, print them as light tints, or print lines alone (colour; lines with a
        machine's preset).
    details: Print what simplification takes from the model's shape: edges that the paper has no fold for, as thin grey
        lines; its hollows, as shade; or nothing; auto draws lines on models without pictures (auto).
    dpi: Dots an inch of printed pictures (300).
    keep_bodies: Leave bodies that touch or run into each other as they are, hidden faces and all; without it they
        become one outer skin.
    skins: Walls thinner than 3 mm become a sheet: their outer skin, or one in the middle of the wall; both leaves
        inside and outside (outer).
    concavity: How far a part may be from convex, as a share of the radius of the model's bounding sphere (0.1).
    pieces: few: as few pieces as paper and overlap allow; parts: those of the model, crumbs joined to their neighbours;
        small: small ones (parts).
    rolled: Roll walls that are round one way, instead of folding them line by line: where that is less work, never, or
        wherever the sheet can be bent so, round 3 mm and more (auto; never with pieces few).
    max_faces: Most flat faces of one piece (few: any, parts: 80, small: 24).
    weigh: How much a property of nets counts when the best ones are chosen, in mm of seam. May be given for several
        terms: seam=1: a mm of seam to glue; bare=6: a mm of seam without room for a tab; slits=3: a mm of seam that
        hardly opens; mirror=1.5: a mm of seam whose image, mirrored or turned, is none; open=0.1: a mm of seam on
        smooth places; borders=0.7: a mm of fold where colours, materials or objects of the model meet; compact=5: a cm2
        inside a piece's hull that is no paper; outline=0.5: the square of a piece's outline, over 1000 mm; thin=0.5: a
        mm by which what hangs on a neck is wider than three times the neck; pieces=360: a piece; parts=50: a further
        part in a piece; small=1200: a piece under 30 mm; panels=800: the square of a piece's flat faces, over 80.
    fold_linear: For sheets that fold themselves: every piece folds up with all creases moving together and no face
        running through another; pieces are split where no net does.
    unite: the contrary of keep_bodies.
    whole: don't cut the model into parts first, and cut a flat region before a piece is added.
    title: what pages and files call the model.
    time_limit: seconds after which searches end with the best they have. Raises OutOfTime where there is nothing yet.

    The result has passed its check: lengths, overlaps, coverage, joins and refolding.
    """
    options = {
        "size": size,
        "height": height,
        "width": width,
        "depth": depth,
        "up": up,
        "scale": scale,
        "unit": unit,
        "simplify": simplify,
        "hours": hours,
        "strict": strict,
        "sheet": sheet,
        "margin": margin,
        "pack": pack,
        "grain": grain,
        "tabs": tabs,
        "tab_height": tab_height,
        "tab_angle": tab_angle,
        "border_tabs": border_tabs,
        "tab_shadow": tab_shadow,
        "all_tabs": all_tabs,
        "hide_folds": hide_folds,
        "numbers": numbers,
        "duplex": duplex,
        "ink": ink,
        "details": details,
        "dpi": dpi,
        "keep_bodies": keep_bodies,
        "skins": skins,
        "concavity": concavity,
        "pieces": pieces,
        "rolled": rolled,
        "max_faces": max_faces,
        "weigh": weigh,
        "fold_linear": fold_linear,
    }
    if unite is not None:
        options["keep_bodies"] = not unite
    return _core.run(vertices, faces, options, (whole, title), (threads, seed, time_limit, progress))
