# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts and hulls: what the program finds, in arrays."""

import pickle
import subprocess
import sys

import numpy as np
import pytest
from conftest import SAMPLES, read_obj, told, volume

import ridgecraft


@pytest.mark.parametrize("name", ["whale.obj", "mug.obj", "dinosaur.obj", "chess_rook.obj"])
def test_labels_are_those_of_the_program(name, tmp_path):
    vertices, faces = read_obj(name)
    for concavity in (0.1, 0.03):
        labels = ridgecraft.segment(vertices, faces, concavity)
        told("segment", SAMPLES / name, "--concavity", concavity, "--labels", tmp_path / f"{concavity}.seg")
        assert labels.dtype == np.int32
        assert labels.tolist() == [int(w) for w in (tmp_path / f"{concavity}.seg").read_text().split()]


def test_faces_are_taken_in_every_form(cross):
    vertices, faces = cross
    labels = ridgecraft.segment(vertices, faces)
    assert labels.shape == (len(faces),)
    assert labels.max() > 0
    for same in (faces.tolist(), faces.astype(np.uint16), np.asfortranarray(faces), [tuple(f) for f in faces],
                 [np.array(f) for f in faces]):
        assert np.array_equal(ridgecraft.segment(vertices.tolist(), same), labels)
    triangles = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
    both = ridgecraft.segment(vertices.astype(np.float32), triangles)
    assert len(set(both)) == len(set(labels))


def test_dropped_faces_have_no_part(cube):
    vertices, faces = cube
    labels = ridgecraft.segment(vertices, faces.tolist() + [faces[0].tolist(), [0, 1]])
    assert labels.tolist() == [0] * 6 + [-1, -1]


def test_neither_threads_nor_their_number_change_a_result():
    vertices, faces = read_obj("whale.obj")
    one = ridgecraft.segment(vertices, faces, 0.03, threads=1)
    assert np.array_equal(one, ridgecraft.segment(vertices, faces, 0.03, threads=4))


def test_as_many_parts_as_asked_for(cross):
    for count in (1, 3, 5):
        assert len(set(ridgecraft.segment(*cross, parts=count))) == count
    with pytest.raises(ridgecraft.UsageError, match="can be divided into 1 to"):
        ridgecraft.segment(*cross, parts=1000)


def test_hulls_are_convex_and_hold_their_parts(cross):
    vertices, faces = cross
    labels = ridgecraft.segment(vertices, faces)
    hulls = ridgecraft.hulls(vertices, faces)
    # Of the arms' hulls none holds the middle of the cross. Three bars do, two arms and the middle each.
    assert len(hulls) == 3
    held = np.zeros(labels.max() + 1, bool)
    middle = False
    for points, triangles in hulls:
        assert triangles.dtype == np.int32
        assert points.dtype == np.float64
        assert volume(points, triangles) > 0.9
        normals = np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                           points[triangles[:, 2]] - points[triangles[:, 0]])

        def holds(inside):
            heights = np.einsum("tpi,ti->tp", inside[None] - points[triangles[:, 0]][:, None], normals)
            return heights.max() < 1e-9

        assert holds(points)
        held |= [holds(vertices[np.unique(faces[labels == part])]) for part in range(len(held))]
        middle |= holds(np.array([[0.5, 0.5, 0.5]]))
    assert held.all() and middle


def test_hulls_are_those_of_the_program(tmp_path):
    told("hulls", SAMPLES / "dinosaur.obj", "--max-vertices", 32, "-o", tmp_path / "hulls.obj")
    hulls = ridgecraft.hulls(*ridgecraft.read(SAMPLES / "dinosaur.obj"), max_vertices=32)
    vertices, faces = [], []
    for points, triangles in hulls:
        faces.extend((triangles + len(vertices) + 1).tolist())
        vertices.extend(points.tolist())
    lines = [line.split() for line in (tmp_path / "hulls.obj").read_text().splitlines()]
    assert [[float(x) for x in words[1:]] for words in lines if words and words[0] == "v"] == vertices
    assert [[int(x) for x in words[1:]] for words in lines if words and words[0] == "f"] == faces


def test_hulls_have_no_more_vertices_than_asked_for():
    vertices, faces = read_obj("whale.obj")
    limited = ridgecraft.hulls(vertices, faces, max_vertices=12)
    assert max(len(points) for points, _ in limited) <= 12
    assert len(limited) == len(ridgecraft.hulls(vertices, faces))


def test_there_are_no_more_hulls_than_asked_for_and_they_hold_everything(cross):
    vertices, faces = cross
    apart = np.vstack([vertices, np.asarray(vertices) + [9.0, 0.0, 0.0]])
    both = np.vstack([faces, np.asarray(faces) + len(vertices)])
    for limit in (1, 2, 3):
        hulls = ridgecraft.hulls(apart, both, max_hulls=limit, max_vertices=16)
        assert len(hulls) <= limit
        outside = np.full(len(apart), np.inf)
        for points, triangles in hulls:
            assert len(points) <= 16
            normals = np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                               points[triangles[:, 2]] - points[triangles[:, 0]])
            normals /= np.linalg.norm(normals, axis=1)[:, None]
            heights = apart @ normals.T - np.einsum("ti,ti->t", normals, points[triangles[:, 0]])
            outside = np.minimum(outside, heights.max(axis=1))
        assert outside.max() < 1e-9


def test_hulls_say_how_well_they_fit_and_pickle(cross):
    hulls = ridgecraft.hulls(*cross)
    assert hulls.uncovered <= 1e-3
    assert hulls.volume_ratio == pytest.approx(1.0, abs=0.02)
    again = pickle.loads(pickle.dumps(hulls))
    assert again.uncovered == hulls.uncovered and again.volume_ratio == hulls.volume_ratio
    assert all(np.array_equal(a, b) for x, y in zip(hulls, again) for a, b in zip(x, y))
    sheet = ridgecraft.hulls([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    assert sheet.uncovered is None and sheet.volume_ratio is None


@pytest.mark.parametrize("function", [ridgecraft.segment, ridgecraft.hulls, ridgecraft.unfold, ridgecraft.run])
def test_numbers_that_cannot_be_are_told_of_without_the_mesh(cross, function):
    for wrong in ({"seed": -1}, {"seed": "x"}, {"threads": -1}, {"time_limit": -1.0}, {"time_limit": "x"}):
        with pytest.raises(ridgecraft.UsageError) as raised:
            function(*cross, **wrong)
        assert len(str(raised.value)) < 100


def test_parts_and_hulls_are_given_up_when_the_time_has_passed():
    vertices, faces = ridgecraft.read(SAMPLES / "dinosaur.obj")
    for function in (ridgecraft.segment, ridgecraft.hulls):
        with pytest.raises(ridgecraft.OutOfTime):
            function(vertices, faces, effort=3, time_limit=1e-3)


def test_coacd_s_form(cross):
    mesh = ridgecraft.Mesh(*cross)
    parts = ridgecraft.run_coacd(mesh, threshold=0.1)
    assert [len(part) for part in parts] == [2] * len(parts)
    for (points, triangles), (same, as_well) in zip(parts, ridgecraft.hulls(*cross)):
        assert np.array_equal(points, same) and np.array_equal(triangles, as_well)
    assert len(ridgecraft.run_coacd(mesh, 0.1, max_convex_hull=2)) == 2
    assert len(ridgecraft.run_coacd(mesh, 0.1, max_convex_hull=100)) == len(parts)

    class Trimesh:
        vertices, faces = cross

    assert len(ridgecraft.run_coacd(Trimesh(), 0.1)) == len(parts)


def test_scripts_for_coacd_run_with_one_line_changed(tmp_path):
    # The call of CoACD's own example script, with all its arguments as its command line has them.
    script = tmp_path / "decompose.py"
    script.write_text(
        "import sys\n"
        "import numpy as np\n"
        "import ridgecraft as coacd\n"
        "coacd.set_log_level('error')\n"
        "vertices, faces = np.load(sys.argv[1]), np.load(sys.argv[2])\n"
        "mesh = coacd.Mesh(vertices, faces)\n"
        "parts = coacd.run_coacd(mesh, threshold=0.05, max_convex_hull=-1, preprocess_mode='auto',\n"
        "    preprocess_resolution=50, resolution=2000, mcts_nodes=20, mcts_iterations=150, mcts_max_depth=3,\n"
        "    pca=False, merge=True, decimate=False, max_ch_vertex=256, apx_mode='ch', seed=0)\n"
        "print(len(parts), sum(len(f) for v, f in parts))\n"
    )
    vertices, faces = ridgecraft.read(SAMPLES / "whale.obj")
    triangles = np.array([(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)])
    np.save(tmp_path / "vertices.npy", vertices)
    np.save(tmp_path / "faces.npy", triangles)
    printed = subprocess.run(
        [sys.executable, script, tmp_path / "vertices.npy", tmp_path / "faces.npy"],
        check=True, capture_output=True, text=True,
    )
    hulls = ridgecraft.hulls(vertices, triangles, 0.05)
    assert printed.stdout == f"{len(hulls)} {sum(len(f) for _, f in hulls)}\n"
    assert printed.stderr == ""


def test_coacd_s_order_of_arguments(cross):
    mesh = ridgecraft.Mesh(*cross)
    assert len(ridgecraft.run_coacd(mesh, 0.1, 2, "off", 50, 2000, 20, 150, 3, True, True, True, 8)) == 2
    few = ridgecraft.run_coacd(mesh, 0.1, 2, merge=False)
    assert len(few) == len(ridgecraft.run_coacd(mesh, 0.1))
    assert max(len(points) for points, _ in ridgecraft.run_coacd(mesh, 10, decimate=True, max_ch_vertex=8)) <= 8
    for not_there in ({"extrude": True}, {"apx_mode": "box"}):
        with pytest.raises(ridgecraft.UsageError):
            ridgecraft.run_coacd(mesh, 0.1, **not_there)


def test_numbers_of_any_size(cross):
    vertices, faces = cross
    labels = ridgecraft.segment(vertices, faces)
    for factor in (1e-250, 1e250):
        assert np.array_equal(ridgecraft.segment(factor * vertices, faces), labels)
        points, _ = ridgecraft.hulls(factor * vertices, faces, parts=1)[0]
        assert points.max() == pytest.approx(2 * factor, rel=1e-6)


@pytest.mark.parametrize("name", ["gem.stl", "torus.off", "vase.ply", "whale.obj", "fish.obj"])
def test_files_are_read_as_the_program_reads_them(name, tmp_path):
    vertices, faces = ridgecraft.read(SAMPLES / name)
    told("segment", SAMPLES / name, "--labels", tmp_path / "parts.seg")
    labels = [int(word) for word in (tmp_path / "parts.seg").read_text().split()]
    assert len(faces) == len(labels)
    assert ridgecraft.segment(vertices, faces).tolist() == labels


def test_faces_of_several_kinds_are_lists(tmp_path):
    (tmp_path / "tent.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\n"
        "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"
    )
    vertices, faces = ridgecraft.read(tmp_path / "tent.obj")
    assert vertices.shape == (5, 3)
    assert faces == [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    assert ridgecraft.segment(vertices, faces).tolist() == [0] * 5


def test_files_that_can_t_be_read_are_refused():
    with pytest.raises(ridgecraft.UnreadableInput, match="nowhere.obj"):
        ridgecraft.read("nowhere.obj")
    with pytest.raises(OSError):
        ridgecraft.read("nowhere.obj")


@pytest.mark.parametrize(
    "vertices, faces, kind, sentence",
    [
        ([[0, 0]], [[0, 0, 0]], ridgecraft.UsageError, r"n x 3 numbers, not of \(1, 2\)"),
        ("points", [[0, 1, 2]], ridgecraft.UsageError, "vertices must be an array"),
        ([[0, 0, 0]], 7, ridgecraft.UsageError, "faces must be an array"),
        ([[0, 0, 0]], ["012"], ridgecraft.UsageError, "faces must be an array"),
        ([[0, 0, 0]], np.array([[0.0, 1.0, 2.0]]), ridgecraft.UsageError, "faces must be an array"),
        ([[0, 0, 0]], [[0.5, 1, 2]], ridgecraft.UsageError, "faces must be an array"),
        ([[0, 0, 0]], [[0, 0, 1]], ridgecraft.UnusableMesh, "face 0 names vertex 1, and there are 1"),
        ([[0, 0, 0]], np.array([[0, 0, -1]]), ridgecraft.UnusableMesh, "face 0 names vertex -1"),
        ([[0, 0, 0]], [[0, 0, 2**70]], ridgecraft.UnusableMesh, "face 0 names vertex"),
        ([[0, 0, np.inf]], [[0, 0, 0]], ridgecraft.UnusableMesh, "point 0 has a coordinate"),
        ([[0, 0, 0], [1, 0, 0]], [[0, 1, 0]], ridgecraft.UnusableMesh, "no face has an area"),
        (np.zeros((0, 3)), np.zeros((0, 3), int), ridgecraft.UnusableMesh, "there are no faces"),
    ],
)
def test_what_is_no_mesh_is_refused(vertices, faces, kind, sentence):
    with pytest.raises(kind, match=sentence) as raised:
        ridgecraft.segment(vertices, faces)
    assert isinstance(raised.value, ridgecraft.Error)
    assert isinstance(raised.value, ValueError)


@pytest.mark.parametrize(
    "arguments",
    [
        {"concavity": -1.0}, {"concavity": float("nan")}, {"effort": 4}, {"holes": "maybe"},
        {"components": "all"}, {"volume_weight": -1.0}, {"max_vertices": 5},
    ],
)
def test_wrong_arguments_are_refused(cube, arguments):
    with pytest.raises(ridgecraft.UsageError):
        ridgecraft.hulls(*cube, **arguments)
