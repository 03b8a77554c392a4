# SPDX-License-Identifier: GPL-3.0-or-later
"""Nearly convex parts of triangle meshes, their convex hulls, and paper models: nets, pages, PDF.

Vertices are arrays of n x 3 numbers, faces arrays of m x k integers (or sequences of sequences of any
lengths) that name rows of the vertices from 0, counterclockwise seen from outside. Meshes needn't be clean:
doubled points, faces turned around and edges with three faces are repaired first.

Long work runs without the interpreter's lock, on as many threads as the machine has (`threads` says fewer);
neither their number nor the machine changes a result. Ctrl-C ends it. `progress(stage, share)` is called now
and then with what is being done and how much of it is done, from 0 to 1; what it raises ends the work.
What can't be done is raised as `Error` or one of the classes below it, each with one sentence.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any, Iterable, List, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._core import (
    Error,
    Nets,
    NoNets,
    OutOfTime,
    Paper,
    Unbuildable,
    UnreadableInput,
    UnusableMesh,
    UsageError,
    __version__,
)
from . import _core
from ._run import Progress, run, unfold

__all__ = [
    "Error",
    "Hulls",
    "Mesh",
    "Nets",
    "NoNets",
    "OutOfTime",
    "Paper",
    "Unbuildable",
    "UnreadableInput",
    "UnusableMesh",
    "UsageError",
    "__version__",
    "hulls",
    "open_project",
    "read",
    "run",
    "run_coacd",
    "segment",
    "set_log_level",
    "unfold",
]

# Its name before 0.1.
paper = run

Hull = Tuple["npt.NDArray[np.float64]", "npt.NDArray[np.int32]"]


class Hulls(List[Hull]):
    """Convex bodies as (vertices, triangles), and how well they fit together.

    volume_ratio: volume of their union over that of the mesh; None where the mesh encloses nothing.
    uncovered: share of the mesh's volume that is in none of them; None as above.
    """

    def __init__(
        self,
        hulls: Iterable[Hull] = (),
        volume_ratio: Optional[float] = None,
        uncovered: Optional[float] = None,
    ) -> None:
        super().__init__(hulls)
        self.volume_ratio = volume_ratio
        self.uncovered = uncovered


class Mesh(NamedTuple):
    """Vertices and faces under the names that CoACD gives them."""

    vertices: npt.ArrayLike
    indices: Any


def read(file: Union[str, "os.PathLike[str]"]) -> Tuple[npt.NDArray[np.float64], Any]:
    """The vertices and faces of a model file (OBJ, STL, PLY, OFF, glTF, GLB, 3MF or PDO), as they stand there.

    Vertices are in the file's unit. Faces are an array of m x k integers where all have k corners, else a list of
    lists. Raises UnreadableInput or UnusableMesh.
    """
    return _core.read(os.fspath(file))


def segment(
    vertices: npt.ArrayLike,
    faces: Any,
    concavity: float = 0.1,
    *,
    effort: int = 1,
    parts: Optional[int] = None,
    volume_weight: Optional[float] = None,
    planes: bool = False,
    pockets: bool = False,
    holes: str = "automatic",
    components: str = "apart",
    threads: int = 0,
    seed: int = 1,
    time_limit: Optional[float] = None,
    progress: Optional[Progress] = None,
) -> npt.NDArray[np.int32]:
    """Cuts a surface into nearly convex parts; gives the part of each face, from 0, or -1 for faces that repair
    dropped (copies, faces with fewer than three different corners).

    concavity: the largest that a part may have, as a length in the scale where the model's smallest enclosing
        ball has radius 1.
    effort: 1, 2 or 3; higher ones try more and take about 4 and 25 times as long.
    parts: exactly that many, whatever their concavity; the other ways to say how to cut don't count then.
    volume_weight: how many parts more may be spent to lower the ratio of the hulls' volume to the solid's by 1.
    planes: cut by planes, too, where that saves volume.
    pockets: no part's hull may have a pocket deeper than `concavity`; takes a surface without holes.
    holes: 'keep' takes holes as borders, 'close' closes small ones while cutting, 'automatic' looks.
    components: 'apart' cuts each connected component for itself, 'tied' all as one object.
    seed: of the trials of effort 2 and 3; from 0.
    time_limit: seconds after which OutOfTime is raised.
    """
    return _core.segment(
        vertices, faces, concavity=concavity, effort=effort, parts=parts, volume_weight=volume_weight,
        planes=planes, pockets=pockets, holes=holes, components=components,
        run=(threads, seed, time_limit, progress),
    )


def hulls(
    vertices: npt.ArrayLike,
    faces: Any,
    concavity: float = 0.1,
    *,
    max_hulls: int = 0,
    max_vertices: int = 0,
    effort: int = 1,
    parts: Optional[int] = None,
    volume_weight: Optional[float] = None,
    planes: bool = False,
    pockets: bool = False,
    holes: str = "automatic",
    components: str = "apart",
    threads: int = 0,
    seed: int = 1,
    time_limit: Optional[float] = None,
    progress: Optional[Progress] = None,
) -> Hulls:
    """As many convex bodies as there are nearly convex parts, as (vertices, triangles): for physics engines. They are
    the parts' hulls, or those of pieces that planes cut off where these lie closer. All that a closed mesh encloses is
    in them, but for at most a thousandth: where parts leave more, further bodies fill it.

    max_hulls: there are no more bodies, those whose joint hull adds least air are joined; 0 for any number.
    max_vertices: no body has more (at least 8); 0 for any number. The other arguments are those of segment().
    """
    made, volume_ratio, uncovered = _core.hulls(
        vertices, faces, concavity=concavity, effort=effort, parts=parts, max_hulls=max_hulls,
        max_vertices=max_vertices, volume_weight=volume_weight, planes=planes, pockets=pockets, holes=holes,
        components=components, run=(threads, seed, time_limit, progress),
    )
    return Hulls(made, volume_ratio, uncovered)


def run_coacd(
    mesh: Any,
    threshold: float = 0.05,
    max_convex_hull: int = -1,
    preprocess_mode: str = "auto",
    preprocess_resolution: int = 50,
    resolution: int = 2000,
    mcts_nodes: int = 20,
    mcts_iterations: int = 150,
    mcts_max_depth: int = 3,
    pca: bool = False,
    merge: bool = True,
    decimate: bool = False,
    max_ch_vertex: int = 256,
    extrude: bool = False,
    extrude_margin: float = 0.01,
    apx_mode: str = "ch",
    seed: int = 0,
    *,
    threads: int = 0,
    time_limit: Optional[float] = None,
    progress: Optional[Progress] = None,
) -> List[List[Any]]:
    """hulls() in the shape of coacd.run_coacd, so that `import ridgecraft as coacd` tries one in the other's place:
    takes anything with `vertices` and `indices` (or `faces`), and gives a list of [vertices, faces].

    threshold is the concavity of segment(), which measures something else than CoACD does: the same number
    gives other parts. max_convex_hull counts where merge is set: there are no more hulls than that, whether they
    touch or not. max_ch_vertex counts where decimate is set.
    preprocess_mode, preprocess_resolution, resolution, pca and those that begin with mcts_ belong to CoACD's own
    search: they are taken, and change nothing. What can't be had raises UsageError: extrude, and an apx_mode other
    than 'ch'.
    """
    if extrude or apx_mode != "ch":
        raise UsageError("hulls are convex hulls: there are neither extrude nor an apx_mode but 'ch'")
    faces = mesh.indices if hasattr(mesh, "indices") else mesh.faces
    made, _, _ = _core.hulls(
        mesh.vertices, faces, concavity=threshold, effort=1, parts=None,
        max_hulls=max_convex_hull if merge and max_convex_hull > 0 else 0,
        max_vertices=max_ch_vertex if decimate else 0, volume_weight=None, planes=False, pockets=False,
        holes="automatic", components="apart", run=(threads, seed, time_limit, progress),
    )
    return [[points, triangles] for points, triangles in made]


def set_log_level(level: str) -> None:
    """Does nothing, for this module prints nothing: there for scripts that call coacd.set_log_level."""


def open_project(
    file: Union[str, "os.PathLike[str]"], *, threads: int = 0, progress: Optional[Progress] = None
) -> Paper:
    """The paper of a project (NAME.ridgecraft) or of a page that holds one (NAME.html), with the edits in it."""
    with tempfile.TemporaryDirectory(prefix="ridgecraft-") as folder:
        return _core.open_project(os.fspath(file), Path(file).read_bytes(), folder, threads, progress)
