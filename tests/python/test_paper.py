# SPDX-License-Identifier: GPL-3.0-or-later
"""Nets and pages: what the program makes, as values."""

import ast
import json
import re
import subprocess
import textwrap
from pathlib import Path

import numpy as np
import pytest
from conftest import PROGRAM, SAMPLES, read_obj, told

import ridgecraft


def lengths(points, triangles=None):
    corners = points if triangles is None else points[triangles]
    return np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)


@pytest.mark.parametrize("name", ["mug.obj", "heart.obj"])
def test_pages_are_those_of_the_program(name, tmp_path):
    vertices, faces = read_obj(name)
    made = ridgecraft.run(vertices, faces, size=120, title="plain")
    # The module knows of no materials, between which the program keeps borders.
    lines = (SAMPLES / name).read_text().splitlines(keepends=True)
    (tmp_path / "plain.obj").write_text("".join(x for x in lines if "mtl" not in x))
    program = told(tmp_path / "plain.obj", "--size", "120mm", "-o", tmp_path / "plain.fold")
    assert made.page_count == program["pages"]
    assert made.figures["pieces"] == program["pieces"] == len(made.piece_names)
    assert made.figures["parts"] == program["parts"]
    ours, theirs = json.loads(made.fold), json.loads((tmp_path / "plain.fold").read_text())
    assert ours.pop("ridgecraft:model_digest") != theirs.pop("ridgecraft:model_digest")
    assert ours == theirs


def test_every_format_is_written():
    made = ridgecraft.run(*read_obj("heart.obj"))
    assert made.pdf().startswith(b"%PDF")
    assert made.png(0, 30).startswith(b"\x89PNG")
    assert "</svg>" in made.svg(made.page_count - 1)
    assert "EOF" in made.dxf(0)
    for write in (made.svg, made.png, made.dxf):
        with pytest.raises(IndexError, match="there is no page 99"):
            write(99)
    with pytest.raises(ridgecraft.UsageError, match="dots_per_inch"):
        made.png(0, 0)


def test_the_fold_file_passes_the_program_s_check(tmp_path):
    vertices, faces = read_obj("heart.obj")
    made = ridgecraft.run(vertices, faces, title="heart")
    (tmp_path / "heart.fold").write_text(made.fold)
    assert told("verify", tmp_path / "heart.fold")["faces"] == len(made.faces)
    assert json.loads(made.fold)["file_title"] == "heart"


def test_nets_keep_every_length(cross):
    nets = ridgecraft.unfold(*cross, size=90, tabs=True)
    assert not isinstance(nets, ridgecraft.Paper)
    assert np.ptp(nets.vertices, axis=0).max() == pytest.approx(90)
    assert np.allclose(lengths(nets.flat), lengths(nets.vertices, nets.faces), atol=1e-5)
    assert nets.piece.max() + 1 == len(nets.piece_names)
    assert set(nets.edge_uses) == {"fold", "cut"}
    # A tree of folds in each piece, and every other edge is joined.
    folds = nets.edge_uses.count("fold")
    assert folds == len(nets.faces) - len(nets.piece_names)
    assert len(nets.joins) == len(nets.edges) - folds
    assert len(nets.fold_angles) == len(nets.edges)
    for number, edge, tab in nets.joins:
        assert nets.edge_uses[edge] == "cut"
        assert -1 <= tab < len(nets.tabs)
    for face, polygon in nets.tabs:
        assert 0 <= face < len(nets.faces)
        assert polygon.shape[1] == 2


def test_a_flag_counts_where_it_is_false():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    vertices = np.concatenate([corners, corners + 0.5])
    faces = sides + [[v + 8 for v in side] for side in sides]
    apart, united = (ridgecraft.unfold(vertices, faces, size=90, unite=unite) for unite in (False, True))
    assert len(apart.faces) == 24
    assert len(united.faces) > 24


def test_tabs_have_no_height_without_tabs(cube):
    with pytest.raises(ridgecraft.UsageError, match="tab_height"):
        ridgecraft.unfold(*cube, size=90, tab_height=9)
    assert len(ridgecraft.unfold(*cube, size=90).tabs) == 0


@pytest.mark.parametrize("wrong", [{"size": True}, {"margin": True}, {"max_faces": True}])
def test_numbers_are_no_booleans(cube, wrong):
    with pytest.raises(TypeError):
        ridgecraft.run(*cube, **wrong)


def test_faces_know_their_polygons(cube):
    vertices, faces = cube
    nets = ridgecraft.unfold(vertices, faces, scale=10.0)
    assert sorted(nets.polygons.tolist()) == sorted(2 * list(range(6)))
    assert len(nets.piece_names) == 1
    for face, polygon in zip(nets.faces, nets.polygons):
        square = 10.0 * (vertices[faces[polygon]] - 0.5)
        assert all(np.abs(square - nets.vertices[v]).sum(axis=1).min() < 1e-9 for v in face)


def test_whole_bodies_are_one_net():
    vertices, faces = ridgecraft.read(SAMPLES / "gem.stl")
    assert len(ridgecraft.unfold(vertices, faces, whole=True).piece_names) == 1


def test_two_runs_are_equal():
    vertices, faces = read_obj("heart.obj")
    first, second = (ridgecraft.run(vertices, faces, threads=n) for n in (1, 3))
    assert first.pdf() == second.pdf()
    assert first.fold == second.fold


@pytest.mark.parametrize(
    "arguments, kind",
    [
        ({"sheet": "A44"}, ridgecraft.UsageError),
        ({"size": 0}, ridgecraft.UsageError),
        ({"size": float("nan")}, ridgecraft.UsageError),
        ({"size": 100, "scale": 1}, ridgecraft.UsageError),
        ({"scale": -1}, ridgecraft.UsageError),
        ({"margin": 200}, ridgecraft.UsageError),
        ({"simplify": 2}, ridgecraft.UsageError),
        ({"simplify": "much"}, ridgecraft.UsageError),
        ({"pieces": "big"}, ridgecraft.UsageError),
        ({"concavity": 0}, ridgecraft.UsageError),
        ({"tab_height": 0}, ridgecraft.UsageError),
        ({"max_faces": 0}, ridgecraft.UsageError),
        ({"time_limit": 0}, ridgecraft.UsageError),
        ({"time_limit": float("nan")}, ridgecraft.UsageError),
        ({"time_limit": 1e-6}, ridgecraft.OutOfTime),
        ({"scale": 1e9}, ridgecraft.NoNets),
    ],
)
def test_what_can_t_be_is_refused(cube, arguments, kind):
    with pytest.raises(kind):
        ridgecraft.run(*cube, **arguments)


def test_nobody_could_fold_it():
    vertices, faces = read_obj("whale.obj")
    with pytest.raises(ridgecraft.Unbuildable, match="can't be built at"):
        ridgecraft.run(vertices, faces, size=10, simplify="keep", strict=True)


def test_everything_says_what_it_does():
    for name in ridgecraft.__all__:
        if not name.startswith("__"):
            assert getattr(ridgecraft, name).__doc__, name
    for of in (ridgecraft.Nets, ridgecraft.Paper):
        for name in dir(of):
            if not name.startswith("_"):
                assert getattr(of, name).__doc__, name


def test_the_version_is_that_of_the_program():
    words = subprocess.run([PROGRAM, "--version"], check=True, capture_output=True, text=True).stdout.split()
    assert words == ["ridgecraft", ridgecraft.__version__]


def test_the_code_of_the_docs_runs(tmp_path, monkeypatch):
    text = (SAMPLES.parent / "docs/reference/library.md").read_text()
    code = re.search(r"\n    import ridgecraft\n(?:    .*\n|\n)+", text).group()
    monkeypatch.chdir(tmp_path)
    (tmp_path / "samples").symlink_to(SAMPLES)
    exec(textwrap.dedent(code), {})
    assert (tmp_path / "whale.pdf").read_bytes().startswith(b"%PDF")


def test_the_stub_names_everything():
    stub = ast.parse((Path(ridgecraft.__file__).parent / "_core.pyi").read_text())
    told_by_stub = {}
    for node in stub.body:
        if isinstance(node, ast.ClassDef):
            told_by_stub[node.name] = {x.name for x in node.body if isinstance(x, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            told_by_stub[node.name] = set()
    core = ridgecraft._core
    assert set(told_by_stub) == {name for name in dir(core) if not name.startswith("_")}
    assert told_by_stub["Nets"] == {name for name in dir(core.Nets) if not name.startswith("_")}
    assert told_by_stub["Nets"] | told_by_stub["Paper"] == {n for n in dir(core.Paper) if not n.startswith("_")}


def test_a_project_opens_to_the_bytes_of_the_program(tmp_path):
    saved = tmp_path / "house.ridgecraft"
    told(SAMPLES / "house.obj", "--size", "140mm", "--paper", "A5", "--seed", "3", "-o", saved, "-o", tmp_path / "house.fold")
    made = ridgecraft.open_project(saved)
    assert made.fold == (tmp_path / "house.fold").read_text()
    (tmp_path / "half.ridgecraft").write_bytes(saved.read_bytes()[:900])
    with pytest.raises(ridgecraft.UnreadableInput, match="half.ridgecraft is cut off or damaged"):
        ridgecraft.open_project(tmp_path / "half.ridgecraft")
